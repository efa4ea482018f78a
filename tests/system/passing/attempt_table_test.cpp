// SPDX-License-Identifier: Apache-2.0
#include "tests/system/passing/attempt_table.hpp"

#include <gtest/gtest.h>

#include <set>

namespace pitwall::testing {
namespace {

// `failed` attempts of twenty in each bracket end like this, the others with a pass.
std::vector<AttemptRun> runs_with(double round_mph, std::size_t failed, Verdict verdict) {
  std::vector<AttemptRun> runs;
  for (const BracketGate& bracket : kBrackets)
    for (std::size_t i = 0; i < kGateAttempts; ++i) {
      AttemptRun run{.of = {.seed = i, .round_mph = bracket.round_mph}};
      run.verdict = bracket.round_mph == round_mph && i < failed ? verdict : Verdict::kPassed;
      runs.push_back(run);
    }
  return runs;
}

TEST(AttemptTable, TheGatesAreThoseOfTheirBracketAndSeeds) {
  for (const BracketGate& gate : kBrackets)
    for (const Seeds seeds : {Seeds::kCommitted, Seeds::kOfCommit}) {
      const std::size_t most = gate.may_fail[static_cast<std::size_t>(seeds)];
      EXPECT_TRUE(missed_gates(runs_with(gate.round_mph, most, Verdict::kLost), seeds).empty());
      EXPECT_EQ(
          missed_gates(runs_with(gate.round_mph, most + 1, Verdict::kDeclined), seeds).empty(),
          !gate.is_gated);
      EXPECT_FALSE(missed_gates(runs_with(gate.round_mph, 1, Verdict::kContact), seeds).empty());
    }
}

TEST(AttemptTable, AFlapARefusedFrameAndARunThatWasNotMadeFail) {
  for (const auto spoil :
       {+[](AttemptRun& run) { run.flaps = 1; }, +[](AttemptRun& run) { run.refusals = 1; },
        +[](AttemptRun& run) { run.problem = "no file"; }}) {
    std::vector<AttemptRun> runs = runs_with(80.0, 0, Verdict::kPassed);
    spoil(runs.front());
    EXPECT_EQ(missed_gates(runs, Seeds::kCommitted).size(), 1U);
  }
  EXPECT_FALSE(missed_gates({}, Seeds::kCommitted).empty());
}

TEST(AttemptTable, ThePublishedPlannerIsShownAndNotGated) {
  std::vector<AttemptRun> runs = runs_with(80.0, 0, Verdict::kPassed);
  AttemptRun paper{.of = {.seed = 1, .round_mph = 80.0, .driver = Driver::kPaper}};
  paper.flaps = 3;
  runs.push_back(paper);
  EXPECT_TRUE(missed_gates(runs, Seeds::kCommitted).empty());
  EXPECT_NE(table_of(runs, Seeds::kCommitted).find("paper"), std::string::npos);
}

TEST(AttemptTable, SeedsDifferByAttemptBracketAndCommitAndNotByDriver) {
  std::set<std::uint64_t> seen;
  for (const char* commit : {"a1", "a2"})
    for (const BracketGate& bracket : kBrackets)
      for (std::size_t i = 0; i < kGateAttempts; ++i) {
        const auto seed = [&](Driver driver) {
          return case_of(Seeds::kOfCommit, commit, i, bracket.round_mph, driver).seed;
        };
        EXPECT_EQ(seed(Driver::kOurs), seed(Driver::kPaper));
        EXPECT_TRUE(seen.insert(seed(Driver::kOurs)).second);
      }
  EXPECT_EQ(case_of(Seeds::kCommitted, "a1", 3, 80.0, Driver::kOurs).seed,
            case_of(Seeds::kCommitted, "a2", 3, 80.0, Driver::kOurs).seed);
}

TEST(AttemptTable, ADrawHasItsRangesAndTheFrictionIsNotBelowNineteenTwentieths) {
  std::set<double> gaps;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const AttemptDraw draw = drawn(seed);
    EXPECT_GE(draw.friction, 0.95);
    EXPECT_LE(draw.friction, 1.05);
    EXPECT_LE(draw.speed_sigma_mps, 0.6);
    gaps.insert(draw.start_gap_m);
  }
  EXPECT_EQ(gaps.size(), 200U);
}

TEST(AttemptTable, OnlyListedTransitionsAreNoFlaps) {
  EXPECT_TRUE(is_allowed(PassPhase::kTrail, PassPhase::kPass));
  EXPECT_FALSE(is_allowed(PassPhase::kPass, PassPhase::kTrail));
  EXPECT_FALSE(is_allowed(PassPhase::kFree, PassPhase::kPass));
  EXPECT_FALSE(is_allowed(PassPhase::kYield, PassPhase::kPass));
}

}  // namespace
}  // namespace pitwall::testing
