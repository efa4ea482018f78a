// SPDX-License-Identifier: Apache-2.0
#include "protocol/vocabulary/fixed_vector.hpp"

#include <gtest/gtest.h>

#include <type_traits>

namespace pitwall {
namespace {

static_assert(std::is_trivially_copyable_v<FixedVector<double, 4>>, "a state must be a value");

TEST(FixedVector, TakesExactlyItsCapacityInOrder) {
  FixedVector<int, 5> v;
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(v.push(i));
  EXPECT_TRUE(v.full());
  EXPECT_FALSE(v.push(99));
  ASSERT_EQ(v.size(), 5u);
  int expected = 0;
  for (int item : v) EXPECT_EQ(item, expected++);
  EXPECT_EQ(v.back(), 4);
  v.clear();
  EXPECT_TRUE(v.empty());
}

TEST(FixedVectorDeathTest, ReadingPastTheEndStopsTheProcess) {
  FixedVector<int, 2> v;
  ASSERT_TRUE(v.push(1));
  EXPECT_DEATH(static_cast<void>(v[1]), "CHECK failed");
}

}  // namespace
}  // namespace pitwall
