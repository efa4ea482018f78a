// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/laps/bench_laps.hpp"

#include <gtest/gtest.h>

#include "tests/hil/cli/program_run.hpp"

namespace pitwall::benchmarks {

using cli::ProgramOutput;
using cli::ProgramRun;
namespace {

using BenchLaps = ProgramRun;

TEST_F(BenchLaps, RefusesWhatItCannotUse) {
  expect_refusal({"laps", "--tarck", "x"}, "tarck");
  expect_refusal({"laps", "--track", path("none.yaml")}, path("none.yaml"));
  expect_refusal({"laps", "--track", "vehicle/config/cars/av21.yaml"}, "av21.yaml:");
}

// One track, nominal alone: the table, the paper beside it, the file.
TEST_F(BenchLaps, DrivesATrackThatIsNamed) {
  const ProgramOutput output = run({"laps", "--track", "vehicle/config/tracks/tms.yaml", "--only",
                                    "nominal", "--json", path("laps.json")});
  EXPECT_EQ(output.code, 0) << output.out << output.err;
  EXPECT_NE(output.out.find("TMS    nominal"), std::string::npos) << output.out;
  EXPECT_NE(output.out.find("lapped"), std::string::npos) << output.out;
  EXPECT_NE(output.out.find("not a claim"), std::string::npos);
  EXPECT_NE(output.out.find("1 runs in"), std::string::npos);
  EXPECT_NE(text_of("laps.json").find("\"lapped\": true"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::benchmarks
