// Check of a cost benchmark's results: file, output and exit code agree, and each verdict follows
// from its figures.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "protocol/json/json_value.hpp"
#include "tests/benchmarks/cost/cost_gates.hpp"
#include "tests/hil/cli/program_run.hpp"

namespace pitwall::benchmarks {

using cli::ProgramOutput;
using cli::ProgramRun;

// `limits_us`: limit of each gate on the reference machine; 0 for a gate that is not of time.
inline void expect_one_verdict(const ProgramOutput& output, const json::JsonValue& file,
                               const std::map<std::string, double>& limits_us) {
  bool held = true;
  std::map<std::string, double> found;
  for (const json::JsonValue& gate : file.items("gates")) {
    const std::string what = gate.text("gate");
    const bool is_cost = gate.find("limit_units") != nullptr;
    found[what] = is_cost ? gate.number("limit_units") * cost::kReferenceUnit_us : 0.0;
    if (is_cost) {
      EXPECT_NEAR(gate.number("units"), gate.number("cost_us") / gate.number("unit_us"), 1e-9);
      EXPECT_EQ(gate.flag("held"), gate.number("units") <= gate.number("limit_units")) << what;
      // At least a tenth of the unit of the reference machine; otherwise the measurement is wrong.
      EXPECT_GT(gate.number("unit_us"), 0.1 * cost::kReferenceUnit_us) << what;
    }
    held = held && gate.flag("held");
    EXPECT_NE(output.out.find("gate: " + what + ": "), std::string::npos) << output.out;
  }
  ASSERT_EQ(found.size(), limits_us.size()) << output.out;
  for (const auto& [what, limit_us] : limits_us) {
    ASSERT_TRUE(found.contains(what)) << what;
    EXPECT_NEAR(found[what], limit_us, 1e-6) << what;
  }
  EXPECT_EQ(file.flag("held"), held);
  EXPECT_EQ(output.code, held ? 0 : 1);
  EXPECT_EQ(output.out.find("MISSED") == std::string::npos, held) << output.out;
  EXPECT_NE(file.text("machine"), "");
  EXPECT_NE(output.out.find(file.text("machine")), std::string::npos) << output.out;
}

}  // namespace pitwall::benchmarks
