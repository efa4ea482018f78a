// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/cost/paired_ratio.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace pitwall::cost {
namespace {

using Costs = std::vector<double>;

TEST(PairedRatio, WhatSlowsBothInATurnMovesNothing) {
  const Costs ours{3.0, 30.0, 3.0, 300.0, 6.0}, theirs{2.0, 20.0, 2.0, 200.0, 4.0};
  EXPECT_DOUBLE_EQ(paired_ratio(ours, theirs), 1.5);
}

TEST(PairedRatio, ATurnInWhichOneWasHeldUpCountsAsOne) {
  EXPECT_DOUBLE_EQ(paired_ratio(Costs{3.0, 3e9, 3.0}, Costs{2.0, 2.0, 2.0}), 1.5);
  EXPECT_DOUBLE_EQ(paired_ratio(Costs{3.0, 3.0, 3.0}, Costs{2.0, 2e9, 2.0}), 1.5);
}

TEST(PairedRatio, OfNoTurnIsNone) { EXPECT_TRUE(std::isnan(paired_ratio(Costs{}, Costs{}))); }

}  // namespace
}  // namespace pitwall::cost
