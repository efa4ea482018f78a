#include "protocol/telemetry/field_row.hpp"

#include <gtest/gtest.h>

namespace pitwall::telemetry {
namespace {

constexpr FieldRow row(double min, double max, double resolution) {
  return {Group::kEgo, "x", "", min, max, resolution, Class::kMotion, {}};
}

TEST(FieldRow, TakesTheFewestBitsThatLeaveRoomForUnset) {
  EXPECT_EQ(row(0, 6, 1).bits(), 3U);  // 0..6 and unset is 7
  EXPECT_EQ(row(0, 7, 1).bits(), 4U);  // 0..7 leaves no code free in three bits
  EXPECT_EQ(row(0, 254, 1).bits(), 8U);
  EXPECT_EQ(row(0, 255, 1).bits(), 9U);
  EXPECT_EQ(row(-1, 1, 0.5).steps(), 4U);
}

TEST(FieldRow, UnsetIsNeverAValue) {
  for (double max = 1; max < 3'000; max += 1) {
    EXPECT_GT(row(0, max, 1).unset_code(), row(0, max, 1).steps());
  }
}

}  // namespace
}  // namespace pitwall::telemetry
