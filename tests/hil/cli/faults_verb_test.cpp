// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/faults_verb.hpp"

#include <gtest/gtest.h>

#include "tests/hil/cli/program_run.hpp"

namespace pitwall::cli {
namespace {

using FaultsVerb = ProgramRun;

TEST_F(FaultsVerb, RefusesWhatItCannotUse) {
  expect_refusal({"faults", "--prvoe"}, "prvoe");
  expect_refusal({"faults", "--only", "no_such_scenario"}, "no such scenario");
  expect_refusal({"faults", "--without", "no_such_monitor"}, "no_such_monitor");
  expect_refusal({"faults", "--speed", "reversing"}, "reversing");
}

// One scenario: the row, its delay; red once its monitor is off, and only then.
TEST_F(FaultsVerb, AMonitorThatIsOffTurnsItsScenarioRed) {
  const ProgramOutput seen = run({"faults", "--only", "f06", "--json", path("matrix.json")});
  EXPECT_EQ(seen.code, 0) << seen.out << seen.err;
  EXPECT_NE(seen.out.find("f06_frames_twice"), std::string::npos) << seen.out;
  EXPECT_NE(text_of("matrix.json").find("\"delay_s\": 0.0"), std::string::npos);
  const ProgramOutput blind = run({"faults", "--only", "f06", "--without", "counter"});
  EXPECT_EQ(blind.code, 1) << blind.out << blind.err;
  EXPECT_NE(blind.out.find("MISSED"), std::string::npos) << blind.out;
}

TEST_F(FaultsVerb, AFaultIsJudgedAtAnotherSpeed) {
  const ProgramOutput walking = run({"faults", "--only", "f06", "--speed", "walking"});
  EXPECT_EQ(walking.code, 0) << walking.out << walking.err;
  EXPECT_NE(walking.out.find("f06_frames_twice@walking"), std::string::npos) << walking.out;
  EXPECT_NE(walking.out.find("drives 4.0 m/s"), std::string::npos) << walking.out;
  expect_refusal({"faults", "--only", "x_oversteer", "--speed", "walking"},
                 "not possible at this speed");
}

// A monitor that is only reported fails the verb, with the table of what failed without it.
TEST_F(FaultsVerb, AProofNeedsMoreThanAReport) {
  const ProgramOutput proven = run({"faults", "--prove", "--only", "f08"});
  EXPECT_EQ(proven.code, 0) << proven.out << proven.err;
  EXPECT_NE(proven.out.find("counter           f08_counter_stuck"), std::string::npos)
      << proven.out;
  const ProgramOutput reported = run({"faults", "--prove", "--only", "f06"});
  EXPECT_EQ(reported.code, 1) << reported.out << reported.err;
  EXPECT_NE(reported.out.find("UNPROVEN: counter"), std::string::npos) << reported.out;
}

}  // namespace
}  // namespace pitwall::cli
