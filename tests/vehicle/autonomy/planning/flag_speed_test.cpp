// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/flag_speed.hpp"

#include <gtest/gtest.h>

#include "tests/vehicle/autonomy/planning/stadium.hpp"

namespace pitwall::planning {
namespace {

using testing::green;
using world::TrackFlag;
using world::VehicleFlag;

TEST(FlagSpeed, EveryFlagHasItsSpeed) {
  constexpr FlagSpeeds p{.green_mps = 40.0, .caution_mps = 22.0};
  const auto demand = [&](TrackFlag track, VehicleFlag vehicle) {
    world::RaceControl rc = green(57.0);
    rc.track = track, rc.vehicle = vehicle;
    return demanded_speed(p, rc, kUnset);
  };
  for (const auto flag : {TrackFlag::kNone, TrackFlag::kRed, TrackFlag::kOrange,
                          TrackFlag::kChequered, TrackFlag::kUnknown}) {
    EXPECT_EQ(demand(flag, VehicleFlag::kNone).speed_mps, 0.0) << static_cast<int>(flag);
  }
  EXPECT_EQ(demand(TrackFlag::kYellow, VehicleFlag::kNone).speed_mps, p.caution_mps);
  EXPECT_EQ(demand(TrackFlag::kGreen, VehicleFlag::kNone).speed_mps, 57.0);
  EXPECT_EQ(demand(TrackFlag::kWavingGreen, VehicleFlag::kAttacker).speed_mps, 57.0);
  for (const auto flag : {VehicleFlag::kBlackPitIn, VehicleFlag::kStop, VehicleFlag::kUnknown,
                          VehicleFlag::kPurpleEmergency, VehicleFlag::kEngineKill,
                          VehicleFlag::kChequered, VehicleFlag::kOrangeStartEngine}) {
    EXPECT_EQ(demand(TrackFlag::kGreen, flag).speed_mps, 0.0) << static_cast<int>(flag);
  }
  EXPECT_EQ(demand(TrackFlag::kGreen, VehicleFlag::kBlackPitIn).reason, Reason::kBlack);
  EXPECT_EQ(demand(TrackFlag::kGreen, VehicleFlag::kYellow).speed_mps, p.caution_mps);
}

TEST(FlagSpeed, MostRestrictiveWins) {
  constexpr FlagSpeeds p{.green_mps = 40.0, .caution_mps = 22.0};
  EXPECT_EQ(demanded_speed(p, green(), kUnset).speed_mps, p.green_mps);
  EXPECT_EQ(demanded_speed(p, green(0.0), kUnset).reason, Reason::kGreen);  // zero is "not given"
  EXPECT_EQ(demanded_speed(p, green(57.0), 31.0).speed_mps, 31.0);
  EXPECT_EQ(demanded_speed(p, green(57.0), 31.0).reason, Reason::kOperatorLimit);
  EXPECT_EQ(demanded_speed(p, green(57.0), 90.0).reason, Reason::kRoundSpeed);
  EXPECT_EQ(demanded_speed(p, green(57.0), -5.0).speed_mps, 0.0);
  world::RaceControl silent = green(57.0);
  silent.ever_received = false;
  EXPECT_EQ(demanded_speed(p, silent, kUnset).speed_mps, 0.0);
  EXPECT_EQ(demanded_speed(p, silent, kUnset).reason, Reason::kNoRaceControl);
}

// With a pit lane a car that shall come in rolls there; every stop stays a stop.
TEST(FlagSpeed, WhoShallComeInDrivesSlowlyWhereThereIsAPitLane) {
  constexpr FlagSpeeds p{.green_mps = 40.0, .caution_mps = 22.0, .has_pit = true};
  for (const auto& track : world::kTrackFlagTable)
    for (const auto& vehicle : world::kVehicleFlagTable) {
      world::RaceControl rc = green(57.0);
      rc.track = track.flag, rc.vehicle = vehicle.flag;
      const SpeedDemand demand = demanded_speed(p, rc, kUnset);
      switch (demand_of(track.flag, vehicle.flag)) {
        case world::FlagDemand::kRace:
          EXPECT_EQ(demand.speed_mps, 57.0);
          break;
        case world::FlagDemand::kCaution:
        case world::FlagDemand::kComeIn:
          EXPECT_EQ(demand.speed_mps, 22.0);
          break;
        default:
          EXPECT_EQ(demand.speed_mps, 0.0);
      }
      EXPECT_EQ(demand.races, demand.speed_mps == 57.0);
    }
  world::RaceControl both = green(57.0);
  both.track = TrackFlag::kChequered, both.vehicle = VehicleFlag::kBlackPitIn;
  EXPECT_EQ(demanded_speed(p, both, kUnset).reason, Reason::kBlack);
}

}  // namespace
}  // namespace pitwall::planning
