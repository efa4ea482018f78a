// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/flags.hpp"

#include <gtest/gtest.h>

#include "tests/basestation/state/derived/flag_values.hpp"

namespace pitwall::state {
namespace {

TEST(Flags, AllThatAgreeAreNoConflict) {
  for (double flag = 0; flag <= 7; ++flag) {
    EXPECT_FALSE(flag_conflict({.race_control_track = flag, .car_track = flag}));
    EXPECT_FALSE(
        flag_conflict({.race_control_track = flag, .car_track = flag, .pit_wall_track = flag}));
  }
}

TEST(Flags, AnyTwoThatDifferAreOne) {
  for (double a = 0; a <= 7; ++a) {
    for (double b = 0; b <= 7; ++b) {
      if (a == b) continue;
      EXPECT_TRUE(flag_conflict({.race_control_track = a, .car_track = b}));
      EXPECT_TRUE(flag_conflict({.race_control_track = a, .car_track = a, .pit_wall_track = b}));
      EXPECT_TRUE(flag_conflict({.race_control_vehicle = a, .car_vehicle = b}));
    }
  }
}

TEST(Flags, WhoSaysNothingContradictsNobody) {
  EXPECT_FALSE(flag_conflict({}));
  EXPECT_FALSE(flag_conflict({.race_control_track = kRed}));
  EXPECT_FALSE(flag_conflict({.car_track = kGreen, .car_vehicle = 2}));
  EXPECT_FALSE(flag_conflict({.car_track = kYellow, .pit_wall_track = kYellow}));
  EXPECT_FALSE(flag_conflict({.encodings_differ = 0}));
  EXPECT_TRUE(flag_conflict({.encodings_differ = 1}));
}

TEST(Flags, RestrictionIsAnOrder) {
  EXPECT_GT(restriction_of_track_flag(kRed), restriction_of_track_flag(kYellow));
  EXPECT_GT(restriction_of_track_flag(kYellow), restriction_of_track_flag(kGreen));
  for (const double nonsense : {kUnknownFlag, -1.0, 99.0, kUnset}) {
    EXPECT_GT(restriction_of_track_flag(nonsense), restriction_of_track_flag(kRed));
  }
}

// The paper: race control set 125 mph where 115 was announced.
TEST(Flags, AnotherBracketThanAnnouncedIsSeen) {
  EXPECT_TRUE(
      round_speed_conflict({.race_control_mps = from_mph(125), .pit_wall_mps = from_mph(115)}));
  EXPECT_FALSE(
      round_speed_conflict({.race_control_mps = from_mph(115), .pit_wall_mps = from_mph(115)}));
  EXPECT_TRUE(
      round_speed_conflict({.race_control_mps = from_mph(115), .car_target_mps = from_mph(125)}));
  EXPECT_FALSE(round_speed_conflict({.race_control_mps = from_mph(115),
                                     .car_target_mps = from_mph(135),
                                     .car_vehicle = kAttacker}))
      << "it passes";
  EXPECT_TRUE(round_speed_conflict({.race_control_mps = from_mph(125),
                                    .pit_wall_mps = from_mph(115),
                                    .car_vehicle = kAttacker}));
  const auto after_a_pass = [](double forward_mps2) {
    return round_speed_conflict({.race_control_mps = from_mph(115),
                                 .car_target_mps = from_mph(125),
                                 .car_vehicle = kDefender,
                                 .car_forward_mps2 = forward_mps2});
  };
  EXPECT_FALSE(after_a_pass(-2.0)) << "it brakes down";
  EXPECT_TRUE(after_a_pass(0.0)) << "it stays too fast";
  EXPECT_FALSE(round_speed_conflict({.race_control_mps = from_mph(115), .car_target_mps = 30.0}));
  EXPECT_FALSE(round_speed_conflict({.race_control_mps = 0.0, .pit_wall_mps = 50.0}));
  EXPECT_FALSE(round_speed_conflict({.pit_wall_mps = 50.0, .car_target_mps = 60.0}));
}

}  // namespace
}  // namespace pitwall::state
