// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/margins.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pitwall::sweep {
namespace {

std::vector<CaseResult> judged(const std::vector<ExpectationMargin>& margins) {
  std::vector<CaseResult> results;
  for (const ExpectationMargin& of : margins)
    results.push_back({.number = 10 + results.size(), .margins = {of}});
  return results;
}

TEST(SweepMargins, AreSortedByExpectation) {
  const auto spreads = margin_spreads(
      judged({{"b", 2.0, true}, {"a", 5.0, true}, {"b", -1.0, false}, {"b", 1.0, true}}));
  ASSERT_EQ(spreads.size(), 2U);
  EXPECT_EQ(spreads[0].text, "a");
  EXPECT_EQ(spreads[1].all, (std::vector<double>{-1.0, 1.0, 2.0}));
  EXPECT_EQ(spreads[1].failed, std::vector<double>{-1.0});
  EXPECT_EQ(spreads[1].failures, 1U);
  EXPECT_EQ(spreads[1].least_in, 12U);
}

TEST(SweepMargins, QuantilesAreThoseOfTheOrder) {
  std::vector<ExpectationMargin> margins;
  for (int i = 40; i-- > 0;) margins.push_back({"a", static_cast<double>(i), true});
  const MarginSpread spread = margin_spreads(judged(margins)).front();
  EXPECT_EQ(spread.least(), 0.0);
  EXPECT_EQ(spread.one_in_twenty(), 2.0);
  EXPECT_EQ(spread.median(), 20.0);
}

TEST(SweepMargins, WhatIsNotFiniteIsCountedApart) {
  const double infinity = std::numeric_limits<double>::infinity();
  const MarginSpread spread =
      margin_spreads(judged({{"a", -infinity, false}, {"a", kUnset, true}})).front();
  EXPECT_TRUE(spread.all.empty());
  EXPECT_EQ(spread.not_finite, 2U);
  EXPECT_EQ(spread.failures, 1U);
  EXPECT_TRUE(std::isnan(spread.least()) && std::isnan(spread.median()));
}

}  // namespace
}  // namespace pitwall::sweep
