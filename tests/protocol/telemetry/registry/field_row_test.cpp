// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/registry/field_row.hpp"

#include <gtest/gtest.h>

namespace pitwall::telemetry {
namespace {

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
