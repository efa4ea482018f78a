// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/registry/rows_autonomy.hpp"

#include <gtest/gtest.h>

#include "protocol/telemetry/registry/registry.hpp"

namespace pitwall::telemetry {
namespace {

TEST(OpponentRows, AreTheSameForEveryOpponent) {
  const auto first = fields_of(Group::kOpponent1);
  for (const Group group : {Group::kOpponent2, Group::kOpponent3, Group::kOpponent4}) {
    EXPECT_EQ(group_bits(group), group_bits(Group::kOpponent1));
    const auto other = fields_of(group);
    ASSERT_EQ(other.count, first.count);
    for (std::size_t i = 0; i < first.count; ++i) {
      EXPECT_EQ(kFields[other.first + i].name, kFields[first.first + i].name);
      EXPECT_EQ(kFields[other.first + i].group, group);
    }
  }
}

// Where an opponent is, is told on the same line as where the car is.
TEST(OpponentRows, ReachAsFarAsTheTrackOfTheCar) {
  constexpr const FieldRow& kCar = kFields[field("track.station")];
  constexpr const FieldRow& kOpponent = kFields[field("opponent_1.station")];
  EXPECT_EQ(kCar.max, kOpponent.max);
  EXPECT_EQ(kFields[field("track.offset")].max, kFields[field("opponent_1.offset")].max);
}

}  // namespace
}  // namespace pitwall::telemetry
