// SPDX-License-Identifier: Apache-2.0
#include "vehicle/world/race_control.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace pitwall::world {
namespace {

TEST(RaceControl, EveryFlagHasExactlyOneRank) {
  std::set<TrackFlag> tracks;
  std::set<VehicleFlag> vehicles;
  for (const auto& row : kTrackFlagTable) tracks.insert(row.flag);
  for (const auto& row : kVehicleFlagTable) vehicles.insert(row.flag);
  EXPECT_EQ(tracks.size(), kTrackFlagTable.size());
  EXPECT_EQ(tracks.size(), static_cast<std::size_t>(TrackFlag::kUnknown) + 1);
  EXPECT_EQ(vehicles.size(), kVehicleFlagTable.size());
  EXPECT_EQ(vehicles.size(), static_cast<std::size_t>(VehicleFlag::kUnknown) + 1);
}

template <class Flag>
void expect_binding_in_order(const std::vector<Flag>& from_the_strictest) {
  for (std::size_t i = 0; i < from_the_strictest.size(); ++i)
    for (std::size_t k = i; k < from_the_strictest.size(); ++k)
      EXPECT_EQ(more_restrictive(from_the_strictest[k], from_the_strictest[i]),
                from_the_strictest[i])
          << i << ' ' << k;
}

// By what the car may do: nothing, stand with the engine running, end its race, drive slowly, drive
// fast. What nobody understands or has said allows nothing.
TEST(RaceControl, ATrackFlagBindsMoreThanThoseThatAllowMore) {
  using enum TrackFlag;
  expect_binding_in_order<TrackFlag>(
      {kUnknown, kRed, kNone, kOrange, kChequered, kYellow, kGreen, kWavingGreen});
}

TEST(RaceControl, AVehicleFlagBindsMoreThanThoseThatAllowMore) {
  using enum VehicleFlag;
  expect_binding_in_order<VehicleFlag>({kPurpleEmergency, kEngineKill, kUnknown, kStop,
                                        kOrangeStartEngine, kBlackPitIn, kChequered, kYellow, kBlue,
                                        kNone, kDefender, kAttacker});
}

TEST(RaceControl, WhatIsNoFlagAtAllCountsAsTheStrictest) {
  const auto track = static_cast<TrackFlag>(200);
  const auto vehicle = static_cast<VehicleFlag>(200);
  EXPECT_EQ(more_restrictive(track, track), TrackFlag::kUnknown);
  EXPECT_EQ(more_restrictive(vehicle, vehicle), VehicleFlag::kPurpleEmergency);
}

TEST(RaceControl, MoreRestrictiveIsCommutativeIdempotentAndOneOfBoth) {
  for (const auto& [a, demand] : kTrackFlagTable) {
    EXPECT_EQ(more_restrictive(a, a), a);
    for (const auto& [b, other] : kTrackFlagTable) {
      const TrackFlag m = more_restrictive(a, b);
      EXPECT_EQ(m, more_restrictive(b, a));
      EXPECT_TRUE(m == a || m == b);
    }
  }
  EXPECT_EQ(more_restrictive(TrackFlag::kGreen, TrackFlag::kYellow), TrackFlag::kYellow);
  EXPECT_EQ(more_restrictive(TrackFlag::kGreen, TrackFlag::kUnknown), TrackFlag::kUnknown);
  EXPECT_EQ(more_restrictive(VehicleFlag::kAttacker, VehicleFlag::kDefender),
            VehicleFlag::kDefender);
  EXPECT_EQ(more_restrictive(VehicleFlag::kStop, VehicleFlag::kPurpleEmergency),
            VehicleFlag::kPurpleEmergency);
}

// A flag that binds more never asks for less.
TEST(RaceControl, WhatAFlagAsksForFollowsItsRank) {
  for (std::size_t i = 1; i < kTrackFlagTable.size(); ++i)
    EXPECT_LE(kTrackFlagTable[i].demand, kTrackFlagTable[i - 1].demand) << i;
  for (std::size_t i = 1; i < kVehicleFlagTable.size(); ++i)
    EXPECT_LE(kVehicleFlagTable[i].demand, kVehicleFlagTable[i - 1].demand) << i;
}

TEST(RaceControl, OnlyGreenOfSomeKindLetsACarRace) {
  for (const auto& track : kTrackFlagTable)
    for (const auto& vehicle : kVehicleFlagTable) {
      const bool green = track.flag == TrackFlag::kGreen || track.flag == TrackFlag::kWavingGreen;
      const bool free = vehicle.flag == VehicleFlag::kNone || vehicle.flag == VehicleFlag::kBlue ||
                        vehicle.flag == VehicleFlag::kDefender ||
                        vehicle.flag == VehicleFlag::kAttacker;
      EXPECT_EQ(demand_of(track.flag, vehicle.flag) == FlagDemand::kRace, green && free);
    }
}

}  // namespace
}  // namespace pitwall::world
