// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/cost/reference_kernel.hpp"

#include <gtest/gtest.h>

#include <set>

namespace pitwall::cost {
namespace {

// A unit that drifted, or that a compiler could leave out, would move every gate.
TEST(ReferenceKernel, EveryUnitIsTheSameWork) {
  ReferenceKernel kernel, twin;
  std::set<double> results;
  for (int i = 0; i < 100; ++i) {
    const double result = kernel.run();
    EXPECT_EQ(result, twin.run()) << i;
    results.insert(result);
  }
  // Where the walk stands after a unit counts in the last digit before the point, and no more.
  ASSERT_EQ(results.size(), 2u);
  EXPECT_DOUBLE_EQ(*results.rbegin() - *results.begin(), 1.0);
}

TEST(ReferenceKernel, ComputesWhatItSays) {
  ReferenceKernel kernel;
  // The libm of another machine may differ in its last digits.
  EXPECT_NEAR(kernel.run(), 24.331453193980, 1e-6);
}

}  // namespace
}  // namespace pitwall::cost
