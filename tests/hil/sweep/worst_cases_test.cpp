// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/worst_cases.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace pitwall::sweep {
namespace {

CaseResult with_margins(std::size_t number, double metres, double degrees) {
  const bool passed = metres >= 0.0 && degrees >= 0.0;
  return {.number = number,
          .verdict = passed ? CaseVerdict::kPassed : CaseVerdict::kFailed,
          .margins = {{"m", metres, metres >= 0.0}, {"deg", degrees, degrees >= 0.0}}};
}

std::vector<std::size_t> numbers_of(const std::vector<const CaseResult*>& cases) {
  std::vector<std::size_t> numbers;
  for (const CaseResult* of : cases) numbers.push_back(of->number);
  return numbers;
}

using Numbers = std::vector<std::size_t>;

TEST(WorstCases, ThoseThatFailedAreInTheOrderOfTheirWorstMargin) {
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<CaseResult> results{
      with_margins(0, 1.0, 1.0),
      with_margins(1, -1.0, -30.0),
      with_margins(2, -2.0, 5.0),
      with_margins(3, -2.0, 5.0),
      with_margins(4, -infinity, 5.0),
      {.number = 5, .verdict = CaseVerdict::kRefused, .why = "no"}};
  EXPECT_EQ(numbers_of(failed_cases(results)), (Numbers{4, 5, 1, 2, 3}));
}

TEST(WorstCases, TheNearestAreTheLeastOfEachExpectationInTurn) {
  const std::vector<CaseResult> results{with_margins(0, 0.1, 900.0), with_margins(1, 0.2, 100.0),
                                        with_margins(2, 0.3, 200.0), with_margins(3, 0.0, -1.0),
                                        with_margins(4, 0.1, 900.0)};
  EXPECT_EQ(numbers_of(nearest_cases(results, 9)), (Numbers{1, 0, 2, 4}));
  EXPECT_EQ(numbers_of(nearest_cases(results, 2)), (Numbers{1, 0}));
  EXPECT_TRUE(nearest_cases(results, 0).empty());
}

TEST(WorstCases, AFailureSaysWhichMarginOrWhatElse) {
  EXPECT_EQ(failure_text(with_margins(0, -1.0, -30.0)), "margin -30: deg");
  EXPECT_EQ(failure_text(with_margins(0, -std::numeric_limits<double>::infinity(), -30.0)),
            "not judged: m");
  EXPECT_EQ(failure_text({.verdict = CaseVerdict::kCrashed, .why = "it ended"}), "it ended");
  EXPECT_NE(failure_text({.verdict = CaseVerdict::kContact, .margins = {{"m", 1.0, true}}})
                .find("contact"),
            std::string::npos);
}

}  // namespace
}  // namespace pitwall::sweep
