// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/registry/group_row.hpp"

#include <gtest/gtest.h>

#include <set>

namespace pitwall::telemetry {
namespace {

TEST(GroupSet, HoldsWhatWasAddedAndNotRemoved) {
  GroupSet set;
  EXPECT_TRUE(set.empty());
  set.add(Group::kMode);
  set.add(Group::kAuthority);
  set.add(Group::kAuthority);
  EXPECT_EQ(set.count(), 2U);
  EXPECT_TRUE(set.has(Group::kAuthority));
  set.remove(Group::kAuthority);
  EXPECT_FALSE(set.has(Group::kAuthority));
  EXPECT_EQ(set.count(), 1U);
}

TEST(GroupTable, DirectionsAndClassesAreSetsWithoutOverlap) {
  const GroupSet down = groups_of(Direction::kDown), up = groups_of(Direction::kUp);
  EXPECT_EQ(down.bits & up.bits, 0U);
  EXPECT_EQ(down.count() + up.count(), kGroups);
  std::uint64_t together = 0;
  for (std::size_t c = 0; c < kClasses; ++c) {
    const GroupSet part = groups_of(Direction::kDown, static_cast<Class>(c));
    EXPECT_EQ(together & part.bits, 0U);
    together |= part.bits;
  }
  EXPECT_EQ(together, down.bits);
}

// A stop that may wait for its turn is none.
TEST(GroupTable, WhatTheOperatorSaysIsSafety) {
  EXPECT_EQ(groups_of(Direction::kUp), groups_of(Direction::kUp, Class::kSafety));
}

TEST(GroupTable, NamesAreUnique) {
  std::set<std::string_view> names;
  for (const GroupRow& row : kGroupTable) EXPECT_TRUE(names.insert(row.name).second) << row.name;
}

}  // namespace
}  // namespace pitwall::telemetry
