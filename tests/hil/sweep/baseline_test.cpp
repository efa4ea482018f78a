// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/baseline.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace pitwall::sweep {
namespace {

CaseResult result_of(std::size_t number, double margin, const std::string& digest = "d") {
  return {.number = number,
          .verdict = margin < 0.0 ? CaseVerdict::kFailed : CaseVerdict::kPassed,
          .digest = digest,
          .margins = {{"always a", margin, margin >= 0.0}}};
}

TEST(SweepBaseline, NamesWhatPassedBeforeAndWhatPassesNow) {
  const std::vector before{result_of(0, 1.0), result_of(1, 1.0), result_of(2, -1.0),
                           result_of(5, 1.0)},
      now{result_of(0, 1.0), result_of(1, -0.5, "e"), result_of(2, 0.5, "e"), result_of(4, 9.0)};
  const Difference found = difference(before, now);
  EXPECT_EQ(found.compared, 3U);
  EXPECT_EQ(found.unchanged, 1U);
  EXPECT_EQ(found.worse, std::vector<std::size_t>{1});
  EXPECT_EQ(found.better, std::vector<std::size_t>{2});
  const std::string text = to_text(found);
  EXPECT_NE(text.find("1 passed before and do not now: 1\n"), std::string::npos) << text;
  EXPECT_NE(text.find("margin fell most, 1 to -0.5 in case 1: always a"), std::string::npos)
      << text;
}

TEST(SweepBaseline, OfEachExpectationTheLargestFallIsTold) {
  std::vector<CaseResult> before, now;
  for (std::size_t i = 0; i < 20; ++i) {
    before.push_back(result_of(i, 10.0));
    now.push_back(result_of(i, i == 13 ? 2.0 : 9.0));
  }
  const Difference found = difference(before, now);
  ASSERT_EQ(found.falls.size(), 1U);
  EXPECT_EQ(found.falls.at("always a").number, 13U);
  EXPECT_TRUE(difference(now, before).falls.empty()) << "what rose fell nowhere";
}

TEST(SweepBaseline, AMarginThatIsNotFiniteIsNotCompared) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(difference(std::vector{result_of(0, infinity)}, std::vector{result_of(0, 1.0)})
                  .falls.empty());
}

TEST(SweepBaseline, OfManyTheFirstAreNamed) {
  std::vector<CaseResult> before, now;
  for (std::size_t i = 0; i < 15; ++i) {
    before.push_back(result_of(i, 1.0));
    now.push_back(result_of(i, -1.0));
  }
  EXPECT_NE(to_text(difference(before, now)).find("15 passed before and do not now: 0, 1, 2"),
            std::string::npos);
  EXPECT_NE(to_text(difference(before, now)).find(", 9, ...\n"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::sweep
