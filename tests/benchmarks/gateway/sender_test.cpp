// Sending itself is tested on real vcan by tests/system/gateway.
// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/gateway/sender.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::load {
namespace {

TEST(Lateness, IsThatOfTheSortedList) {
  for (const std::size_t count : {1U, 2U, 100U, 1'001U}) {
    std::vector<double> late_us;
    for (std::size_t i = 0; i < count; ++i)
      late_us.push_back(static_cast<double>(i * 7'919 % count));  // 0 .. count-1, disordered
    const auto last = static_cast<double>(count - 1);
    const Lateness late = lateness_of(late_us);
    EXPECT_EQ(late.p50_us, std::ceil(0.5 * static_cast<double>(count)) - 1.0);
    EXPECT_EQ(late.p99_us, std::ceil(0.99 * static_cast<double>(count)) - 1.0);
    EXPECT_EQ(late.max_us, last);
  }
}

TEST(Lateness, OfNothingIsUnset) {
  std::vector<double> none;
  EXPECT_TRUE(std::isnan(lateness_of(none).max_us));
}

}  // namespace
}  // namespace pitwall::load
