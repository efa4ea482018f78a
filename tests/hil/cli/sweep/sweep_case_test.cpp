// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/sweep/sweep_case.hpp"

#include <gtest/gtest.h>

#include "protocol/transport/file.hpp"

namespace pitwall::cli {
namespace {

using sweep::CaseVerdict;

constexpr const char* kScenario = "hil/scenarios/launch.yaml";

std::string text() {
  return transport::read_file(std::string(PITWALL_SOURCE_DIR) + "/" + kScenario).value_or("");
}

std::string refusal(const sweep::Parameter& parameter) {
  const auto checked =
      check_values(text(), {.name = "x", .scenario_file = kScenario, .parameters = {parameter}});
  EXPECT_FALSE(checked);
  return checked ? "" : to_string(checked.error());
}

TEST(SweepCase, ValuesThatTheBenchDoesNotTakeAreToldBeforeAnyRun) {
  EXPECT_NE(refusal({.path = "perturb.friction", .from = 0.1, .to = 1.0})
                .find("perturb.friction = 0.1 in"),
            std::string::npos);
  EXPECT_NE(refusal({.path = "perturb.grip", .values = {"1"}}).find("grip"), std::string::npos);
  EXPECT_NE(refusal({.path = "expect[90].value", .values = {"1"}}).find("expect[90].value"),
            std::string::npos);
  EXPECT_TRUE(
      check_values(text(), {.name = "x",
                            .scenario_file = kScenario,
                            .parameters = {{.path = "perturb.friction", .from = 0.5, .to = 1.0}}}));
}

TEST(SweepCase, WhatTheBenchRefusesIsARefusedCase) {
  const SweepInputs inputs{
      sweep::Cases{sweep::Plan{.name = "x", .scenario_file = kScenario, .cases = 9}}, "", text()};
  const auto result = run_case(inputs, {.number = 5, .settings = {{"track", "no/such.yaml"}}});
  EXPECT_EQ(result.number, 5U);
  EXPECT_EQ(result.verdict, CaseVerdict::kRefused);
  EXPECT_NE(result.why.find("no/such.yaml"), std::string::npos) << result.why;
}

}  // namespace
}  // namespace pitwall::cli
