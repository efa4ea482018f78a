// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/registry/rows.hpp"

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

constexpr FieldRow row(double min, double max, double resolution) {
  return {Group::kEgo, "x", "", min, max, resolution};
}

TEST(FieldRow, IsWrittenInTheFewestBitsThatLeaveRoomForUnset) {
  EXPECT_EQ(row(0, 6, 1).quantized().bits(), 3U);  // 0..6 and unset is 7
  EXPECT_EQ(row(0, 7, 1).quantized().bits(), 4U);  // 0..7 leaves no code free in three bits
  EXPECT_EQ(row(-1, 1, 0.5).quantized().count(), 5U);
}

TEST(FieldRow, KindIsSaidByUnitResolutionAndLabels) {
  EXPECT_EQ(row(0, 1, 0.5).kind(), FieldKind::kReal);
  EXPECT_EQ(row(0, 9, 1).kind(), FieldKind::kInteger);
  EXPECT_EQ((FieldRow{Group::kEgo, "x", "m", 0, 9, 1}.kind()), FieldKind::kReal);
  EXPECT_EQ((FieldRow{Group::kEgo, "x", FieldRow::kBitSet, 0, 9, 1}.kind()), FieldKind::kInteger);
  EXPECT_EQ(rows::yes_no(Group::kEgo, "x").kind(), FieldKind::kYesNo);
  EXPECT_EQ(rows::choice(Group::kEgo, "x", kModes, 6).kind(), FieldKind::kInteger);
}

TEST(FieldRow, ClassAndTargetAgeAreThoseOfTheGroup) {
  EXPECT_EQ(row(0, 1, 1).priority(), row_of(Group::kEgo).priority);
  EXPECT_EQ(row(0, 1, 1).target_age(), row_of(Group::kEgo).target_age);
}

TEST(FieldRow, EveryGroupHasAName) {
  for (const GroupRow& row : kGroupTable) EXPECT_FALSE(row.name.empty());
  EXPECT_EQ(row_of(Group::kComputer).name, "computer");
}

}  // namespace
}  // namespace pitwall::telemetry
