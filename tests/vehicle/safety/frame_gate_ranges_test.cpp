// Ranges within which a car file may set the frame gate. They are written here a second time, so
// that a range of the gate never changes by accident.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "vehicle/safety/frame_gate.hpp"

namespace pitwall::safety {
namespace {

struct Bounds {
  const char* name;
  double least, most;
};

constexpr auto kBounds = std::to_array<Bounds>({
    {"stop_steer_share", 0.5, 1.0},
    {"hold_steer_slew_deg_per_s", 1.0, 1500.0},
    {"hold_least_kpa", 0.0, 3000.0},
    {"steer_slew_deg_per_s", 60.0, 1500.0},
    {"brake_max_kpa", 1000.0, 8191.0},
    {"brake_rise_kpa_per_s", 1000.0, 100000.0},
    {"brake_fall_kpa_per_s", 1000.0, 200000.0},
    {"throttle_max_percent", 1.0, 100.0},
    {"throttle_rise_percent_per_s", 10.0, 2000.0},
    {"both_throttle_percent", 0.0, 10.0},
    {"both_brake_kpa", 0.0, 500.0},
    {"standing_mps", 0.1, 5.0},
});

constexpr auto kTimeBounds = std::to_array<Bounds>({
    {"shift_least_s", 0.0, 1.0},
    {"command_age_max_s", 0.01, 0.2},
});

TEST(FrameGateRanges, AreThoseThatWereAgreed) {
  ASSERT_EQ(kGateRanges.size(), kBounds.size());
  for (std::size_t i = 0; i < kBounds.size(); ++i) {
    EXPECT_EQ(std::string{kGateRanges[i].name}, kBounds[i].name);
    EXPECT_EQ(kGateRanges[i].least, kBounds[i].least) << kBounds[i].name;
    EXPECT_EQ(kGateRanges[i].most, kBounds[i].most) << kBounds[i].name;
  }
}

TEST(FrameGateRanges, OfTimesAreThoseThatWereAgreed) {
  ASSERT_EQ(kGateTimes.size(), kTimeBounds.size());
  for (std::size_t i = 0; i < kTimeBounds.size(); ++i) {
    EXPECT_EQ(std::string{kGateTimes[i].name}, kTimeBounds[i].name);
    EXPECT_EQ(kGateTimes[i].least_s, kTimeBounds[i].least) << kTimeBounds[i].name;
    EXPECT_EQ(kGateTimes[i].most_s, kTimeBounds[i].most) << kTimeBounds[i].name;
  }
}

TEST(FrameGateRanges, HoldTheDefaults) {
  const GateParams defaults;
  EXPECT_FALSE(world::first_illegal(kGateRanges, defaults));
  for (const auto& time : kGateTimes) {
    EXPECT_GE((defaults.*time.value).seconds(), time.least_s) << time.name;
    EXPECT_LE((defaults.*time.value).seconds(), time.most_s) << time.name;
  }
}

}  // namespace
}  // namespace pitwall::safety
