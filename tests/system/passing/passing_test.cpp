// Our car with its full stack, estimator and tracker in the loop, attacks a ghost that defends the
// inside lane: it passes in every bracket, as the judge has it, without a contact.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/system/passing/attempt_table.hpp"

namespace pitwall::testing {
namespace {

class Bracket : public ::testing::TestWithParam<double> {};

TEST_P(Bracket, OurCarPassesADefenderWhoHoldsTheInsideLane) {
  const AttemptRun run = run_attempt(case_of(Seeds::kCommitted, "", 0, GetParam(), Driver::kOurs));
  EXPECT_EQ(run.verdict, Verdict::kPassed) << row_of(run);
  EXPECT_LE(run.laps, 2.0);
  EXPECT_EQ(run.flaps, 0U);
  EXPECT_EQ(run.refusals, 0U);
}

INSTANTIATE_TEST_SUITE_P(All, Bracket, ::testing::Values(80, 100, 115, 125, 135, 150));

}  // namespace
}  // namespace pitwall::testing
