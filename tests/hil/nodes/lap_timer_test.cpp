// SPDX-License-Identifier: Apache-2.0
#include "hil/nodes/lap_timer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace pitwall::race {
namespace {

constexpr double kLength_m = 2500.0;
constexpr double kTick_s = 0.01;

// A car whose distance along the line is a function of time.
template <class Distance, class Green>
std::vector<Lap> drive(const LapTimerParams& p, Distance distance_m, Green green, double time_s) {
  std::vector<Lap> laps;
  LapTimerState state;
  for (int i = 0; i * kTick_s < time_s; ++i) {
    const double t_s = i * kTick_s;
    const double d_m = distance_m(t_s);
    const double speed_mps = (distance_m(t_s + 1e-4) - distance_m(t_s - 1e-4)) / 2e-4;
    double station_m = std::fmod(d_m, p.track_length_m);
    if (station_m < 0.0) station_m += p.track_length_m;
    const auto lap =
        step(p, state, {station_m, speed_mps, green(t_s)}, Instant{} + milliseconds(10) * i);
    if (lap) laps.push_back(*lap);
  }
  return laps;
}

bool always(double) { return true; }

TEST(LapTimer, TimesConstantSpeedExactly) {
  for (const double line_m : {0.0, 100.0, 2499.0})
    for (const double v_mps : {12.3, 45.6, 87.9}) {
      const auto laps = drive(
          {.track_length_m = kLength_m, .start_line_m = line_m},
          [&](double t_s) { return 700.0 + v_mps * t_s; }, always, 900.0);
      ASSERT_GE(laps.size(), 3U);
      for (std::size_t i = 0; i < laps.size(); ++i) {
        EXPECT_EQ(laps[i].number, i + 1);
        EXPECT_NEAR((laps[i].end - laps[i].begin).seconds(), kLength_m / v_mps, 1e-6);
        EXPECT_NEAR(laps[i].mean_speed_mps, v_mps, 1e-5);
        EXPECT_TRUE(laps[i].flying);
        const double at_line_m = 700.0 + v_mps * (laps[i].end - Instant{}).seconds() - line_m;
        EXPECT_NEAR(std::remainder(at_line_m, kLength_m), 0.0, 1e-4);
      }
    }
}

TEST(LapTimer, LapsAddUpAtVaryingSpeed) {
  const auto laps = drive(
      {.track_length_m = kLength_m},
      [](double t_s) { return 40.0 * t_s + 150.0 * std::sin(0.1 * t_s); }, always, 600.0);
  ASSERT_GE(laps.size(), 5U);
  for (std::size_t i = 1; i < laps.size(); ++i) EXPECT_EQ(laps[i].begin, laps[i - 1].end);
}

TEST(LapTimer, RollingBackOverTheLineIsNoLap) {
  // Oscillates over the line of a track, then leaves.
  const auto distance = [](double t_s) {
    return t_s < 60.0 ? kLength_m + 30.0 * std::sin(t_s) - 0.5 : kLength_m + 20.0 * (t_s - 60.0);
  };
  const auto laps = drive({.track_length_m = kLength_m}, distance, always, 60.0 + 124.0);
  EXPECT_EQ(laps.size(), 0U);
}

TEST(LapTimer, ALapFliesOnlyUnderGreenFromLineToLineAndAtSpeed) {
  const auto constant = [](double t_s) { return 50.0 * t_s; };
  const auto blink = [](double t_s) { return !(t_s > 120.0 && t_s < 120.5); };
  const auto laps = drive({.track_length_m = kLength_m}, constant, blink, 310.0);
  ASSERT_EQ(laps.size(), 5U);  // 50 s each, the first begins at 50 s
  for (const Lap& lap : laps) EXPECT_EQ(lap.flying, lap.number != 2) << lap.number;
  // Every lap begins and ends at 50 m/s; a line speed above that never flies.
  for (const Lap& lap :
       drive({.track_length_m = kLength_m, .flying_speed_mps = 51.0}, constant, always, 310.0))
    EXPECT_FALSE(lap.flying);
}

TEST(LapTimer, AGapInTheStationEndsFlyingButNotTiming) {
  LapTimerState state;
  const LapTimerParams p{.track_length_m = kLength_m};
  std::vector<Lap> laps;
  for (int i = 0; i < 16'000; ++i) {
    const double t_s = i * kTick_s;
    const bool gap = t_s > 70.0 && t_s < 70.2;
    const double s_m = gap ? kUnset : std::fmod(50.0 * t_s, kLength_m);
    if (const auto lap = step(p, state, {s_m, 50.0, true}, Instant{} + milliseconds(10) * i))
      laps.push_back(*lap);
  }
  ASSERT_EQ(laps.size(), 2U);
  EXPECT_FALSE(laps[0].flying);
  EXPECT_TRUE(laps[1].flying);
  EXPECT_NEAR((laps[0].end - laps[0].begin).seconds(), 50.0, 1e-6);
}

}  // namespace
}  // namespace pitwall::race
