// SPDX-License-Identifier: Apache-2.0
#include "vehicle/gateway/flag_tables.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace pitwall::gateway {
namespace {

using world::FlagEncoding;
using world::TrackFlag;
using world::VehicleFlag;

// The published tables, written a second time.
const std::map<int, TrackFlag> kMyLapsTracks{{0, TrackFlag::kNone},   {1, TrackFlag::kRed},
                                             {2, TrackFlag::kOrange}, {3, TrackFlag::kYellow},
                                             {4, TrackFlag::kGreen},  {8, TrackFlag::kWavingGreen}};
const std::map<int, VehicleFlag> kMyLapsVehicles{
    {0, VehicleFlag::kNone},     {2, VehicleFlag::kBlackPitIn}, {4, VehicleFlag::kChequered},
    {5, VehicleFlag::kDefender}, {7, VehicleFlag::kAttacker},   {8, VehicleFlag::kPurpleEmergency}};
const std::map<int, TrackFlag> kMarelliTracks{
    {0, TrackFlag::kNone},      {1, TrackFlag::kGreen},  {3, TrackFlag::kRed},
    {4, TrackFlag::kChequered}, {9, TrackFlag::kYellow}, {37, TrackFlag::kWavingGreen}};
const std::map<int, VehicleFlag> kMarelliVehicles{{0, VehicleFlag::kNone},
                                                  {2, VehicleFlag::kBlue},
                                                  {4, VehicleFlag::kBlackPitIn},
                                                  {7, VehicleFlag::kYellow},
                                                  {25, VehicleFlag::kOrangeStartEngine},
                                                  {32, VehicleFlag::kPurpleEmergency},
                                                  {33, VehicleFlag::kEngineKill},
                                                  {34, VehicleFlag::kStop},
                                                  {35, VehicleFlag::kDefender},
                                                  {36, VehicleFlag::kAttacker}};

template <class Flag>
Flag expected(const std::map<int, Flag>& table, int raw) {
  const auto found = table.find(raw);
  return found == table.end() ? Flag::kUnknown : found->second;
}

TEST(FlagTables, EveryMyLapsValueHasItsMeaningAndTheRestIsUnknown) {
  for (int raw = 0; raw < 256; ++raw) {
    const auto value = static_cast<std::uint8_t>(raw);
    const TrackMeaning track = track_meaning(FlagEncoding::kMyLaps, value);
    EXPECT_EQ(track.flag, expected(kMyLapsTracks, raw)) << raw;
    EXPECT_TRUE(std::isnan(track.round_target_speed_mps)) << raw;
    EXPECT_EQ(vehicle_meaning(FlagEncoding::kMyLaps, value), expected(kMyLapsVehicles, raw)) << raw;
  }
}

TEST(FlagTables, EveryMarelliValueHasItsMeaningAndTheRestIsUnknown) {
  std::set<int> speeds{40, 60, 80, 100};
  for (int mph = 120; mph <= 190; mph += 5) speeds.insert(mph);
  for (int raw = 0; raw < 256; ++raw) {
    const auto value = static_cast<std::uint8_t>(raw);
    const TrackMeaning track = track_meaning(FlagEncoding::kMarelli, value);
    if (speeds.contains(raw)) {
      EXPECT_EQ(track.flag, TrackFlag::kGreen) << raw;
      EXPECT_NEAR(track.round_target_speed_mps * 3600.0 / 1609.344, raw, 1e-9);
    } else {
      EXPECT_EQ(track.flag, expected(kMarelliTracks, raw)) << raw;
      EXPECT_TRUE(std::isnan(track.round_target_speed_mps)) << raw;
    }
    EXPECT_EQ(vehicle_meaning(FlagEncoding::kMarelli, value), expected(kMarelliVehicles, raw))
        << raw;
  }
}

}  // namespace
}  // namespace pitwall::gateway
