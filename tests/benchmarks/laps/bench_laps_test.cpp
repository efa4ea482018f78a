// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/laps/bench_laps.hpp"

#include <gtest/gtest.h>

#include "tests/hil/cli/program_run.hpp"

namespace pitwall::benchmarks {

using cli::ProgramRun;
using cli::Said;
namespace {

using BenchLaps = ProgramRun;

TEST_F(BenchLaps, RefusesWhatItCannotUse) {
  expect_refusal({"laps", "--tarck", "x"}, "tarck");
  expect_refusal({"laps", "--track", path("none.yaml")}, path("none.yaml"));
  expect_refusal({"laps", "--track", "vehicle/config/cars/av21.yaml"}, "av21.yaml:");
}

// One track, nominal alone: the table, the paper beside it, the file.
TEST_F(BenchLaps, DrivesATrackThatIsNamed) {
  const Said said = run({"laps", "--track", "vehicle/config/tracks/tms.yaml", "--only", "nominal",
                         "--json", path("laps.json")});
  EXPECT_EQ(said.code, 0) << said.out << said.err;
  EXPECT_NE(said.out.find("TMS    nominal"), std::string::npos) << said.out;
  EXPECT_NE(said.out.find("lapped"), std::string::npos) << said.out;
  EXPECT_NE(said.out.find("not a claim"), std::string::npos);
  EXPECT_NE(said.out.find("1 runs in"), std::string::npos);
  EXPECT_NE(text_of("laps.json").find("\"lapped\": true"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::benchmarks
