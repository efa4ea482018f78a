// The oracle is the car's own table of flags, written apart from the one under test.
// SPDX-License-Identifier: Apache-2.0
#include "hil/nodes/flag_encoding.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "vehicle/gateway/flag_tables.hpp"

namespace pitwall::race {
namespace {

using world::FlagEncoding;
using world::TrackFlag;
using world::VehicleFlag;

constexpr int kTrackFlags = static_cast<int>(TrackFlag::kUnknown) + 1;
constexpr int kVehicleFlags = static_cast<int>(VehicleFlag::kUnknown) + 1;

template <class Check>
void for_all_flags(Check check) {
  for (int t = 0; t < kTrackFlags; ++t)
    for (int v = 0; v < kVehicleFlags; ++v)
      check(Flags{static_cast<TrackFlag>(t), static_cast<VehicleFlag>(v)});
}

Flags received(FlagEncoding encoding, const RawFlags& raw) {
  return {gateway::track_meaning(encoding, raw.track).flag,
          gateway::vehicle_meaning(encoding, raw.vehicle)};
}

// Both fields at once, most severe first: what the pair tells the car to do.
bool emergency(const Flags& f) { return f.vehicle == VehicleFlag::kPurpleEmergency; }
bool stops(const Flags& f) {
  return f.track == TrackFlag::kRed || f.track == TrackFlag::kUnknown ||
         f.vehicle == VehicleFlag::kStop || f.vehicle == VehicleFlag::kUnknown ||
         f.vehicle == VehicleFlag::kEngineKill || emergency(f);
}
bool slows(const Flags& f) {
  return stops(f) || f.track == TrackFlag::kYellow || f.track == TrackFlag::kChequered ||
         f.track == TrackFlag::kOrange || f.vehicle == VehicleFlag::kYellow ||
         f.vehicle == VehicleFlag::kChequered || f.vehicle == VehicleFlag::kOrangeStartEngine ||
         f.vehicle == VehicleFlag::kBlackPitIn;
}

TEST(FlagEncoding, NoEncodingLosesARestriction) {
  for (const FlagEncoding encoding : {FlagEncoding::kMyLaps, FlagEncoding::kMarelli})
    for_all_flags([&](const Flags& f) {
      const RawFlags raw = encoding == FlagEncoding::kMyLaps ? to_mylaps(f) : to_marelli(f, kUnset);
      const Flags reported = received(encoding, raw);
      EXPECT_TRUE(!emergency(f) || emergency(reported));
      EXPECT_TRUE(!stops(f) || stops(reported))
          << static_cast<int>(f.track) << " " << static_cast<int>(f.vehicle);
      EXPECT_TRUE(!slows(f) || slows(reported))
          << static_cast<int>(f.track) << " " << static_cast<int>(f.vehicle);
      EXPECT_TRUE(slows(f) || !slows(reported)) << "restricts without being asked";
    });
}

TEST(FlagEncoding, FlagsThatTheEncodingHasArriveAsTheyAre) {
  for (const TrackFlag t : {TrackFlag::kNone, TrackFlag::kRed, TrackFlag::kYellow,
                            TrackFlag::kGreen, TrackFlag::kWavingGreen}) {
    for (const VehicleFlag v :
         {VehicleFlag::kNone, VehicleFlag::kBlackPitIn, VehicleFlag::kDefender,
          VehicleFlag::kAttacker, VehicleFlag::kPurpleEmergency}) {
      EXPECT_EQ(received(FlagEncoding::kMyLaps, to_mylaps({t, v})), (Flags{t, v}));
      EXPECT_EQ(received(FlagEncoding::kMarelli, to_marelli({t, v}, kUnset)), (Flags{t, v}));
    }
  }
  EXPECT_EQ(to_mylaps({TrackFlag::kOrange, VehicleFlag::kNone}).track, 2);
  EXPECT_EQ(to_marelli({TrackFlag::kOrange, VehicleFlag::kNone}, kUnset).vehicle, 25);
}

TEST(FlagEncoding, MyLapsFitsItsFourBits) {
  for_all_flags([](const Flags& f) {
    EXPECT_LT(to_mylaps(f).track, 16);
    EXPECT_LT(to_mylaps(f).vehicle, 16);
  });
}

TEST(FlagEncoding, AKnownRoundSpeedIsTheGreenOfMarelli) {
  const Flags green{TrackFlag::kGreen, VehicleFlag::kAttacker};
  for (int mph = 0; mph <= 255; ++mph) {
    const RawFlags raw = to_marelli(green, mph);
    const auto meaning = gateway::track_meaning(FlagEncoding::kMarelli, raw.track);
    EXPECT_EQ(meaning.flag, TrackFlag::kGreen) << mph;
    EXPECT_EQ(raw.track != 1, gateway::is_green_speed(static_cast<std::uint8_t>(mph))) << mph;
    if (raw.track != 1) {
      EXPECT_NEAR(meaning.round_target_speed_mps, from_mph(mph), 1e-9);
    }
  }
  EXPECT_EQ(to_marelli({TrackFlag::kRed, VehicleFlag::kNone}, 120.0).track, 3);
}

}  // namespace
}  // namespace pitwall::race
