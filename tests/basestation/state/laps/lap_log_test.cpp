// A car on a ring of 1 km whose way over time is known in closed form, as its radio reports it.
// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/laps/lap_log.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace pitwall::state {
namespace {

using telemetry::Group;

constexpr double kLength_m = 1'000.0;
constexpr Instant kStart{seconds(50).ns};

// 50 m/s with a swing of 10 m/s in 5 s, from the station 700 on.
constexpr double kMean_mps = 50.0, kSwing_mps = 10.0, kTurn_per_s = 2.0 * std::numbers::pi / 5.0;
double speed_at(double t_s) { return kMean_mps + kSwing_mps * std::sin(kTurn_per_s * t_s); }
double way_at(double t_s) {
  return 700.0 + kMean_mps * t_s + kSwing_mps / kTurn_per_s * (1.0 - std::cos(kTurn_per_s * t_s));
}
// When it has gone so far, by bisection.
double time_of(double way_m) {
  double low = 0.0, high = 1'000.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2.0;
    (way_at(middle) < way_m ? low : high) = middle;
  }
  return low;
}

// Of one sample interval of 40 ms at 4 pi m/s^2 the way is no straight line by a * T^2 / 8.
constexpr double kTick_s = 0.04;
constexpr double kCurved_m = kSwing_mps * kTurn_per_s * kTick_s * kTick_s / 8.0;
constexpr double kTime_s = kCurved_m / (kMean_mps - kSwing_mps) + 1e-5;  // and a float's step
constexpr double kSpeed_mps = kSwing_mps * kTurn_per_s * kTurn_per_s * kTick_s * kTick_s / 8.0 +
                              kSwing_mps * kTurn_per_s * kTime_s + 1e-4;

class Laps : public ::testing::Test {
 protected:
  void tell(Group group, double t_s) {
    telemetry::GroupSet groups;
    groups.add(group);
    state_.at(group) = kStart + from_seconds(t_s);
    log_.note(state_, groups);
  }
  // Both groups 25 times a second, the speed half a tick beside the station.
  void drive(double from_s, double to_s, const std::function<bool(double)>& received = {}) {
    for (auto i = std::lround(from_s / kTick_s); i < std::lround(to_s / kTick_s); ++i) {
      const double t = static_cast<double>(i) * kTick_s;
      if (received && !received(t)) continue;
      state_.values[telemetry::field("track.station")] = std::fmod(way_at(t), kLength_m);
      state_.values[telemetry::field("track.lap")] = std::floor(way_at(t) / kLength_m) + 10.0;
      tell(Group::kTrack, t);
      state_.values[telemetry::field("ego.vx")] = speed_at(t + kTick_s / 2.0);
      tell(Group::kEgo, t + kTick_s / 2.0);
    }
  }
  const Lap& nth(std::size_t n) const { return log_.laps().at(n); }

  LapLog log_{kLength_m};
  telemetry::Snapshot state_;
};

TEST_F(Laps, ALapLastsFromLineToLine) {
  drive(0.0, 70.0);
  ASSERT_EQ(log_.laps().size(), 5U);
  EXPECT_FALSE(nth(0).complete()) << "its start was not seen";
  EXPECT_TRUE(std::isnan(nth(0).time_s()));
  for (std::size_t n = 1; n <= 3; ++n) {
    EXPECT_TRUE(nth(n).complete());
    const double begin_s = time_of(1'000.0 * static_cast<double>(n));
    const double end_s = time_of(1'000.0 * static_cast<double>(n + 1));
    EXPECT_NEAR(nth(n).time_s(), end_s - begin_s, 2.0 * kTime_s);
    EXPECT_NEAR((nth(n).begin - kStart).seconds(), begin_s, kTime_s);
    EXPECT_EQ(nth(n).end, nth(n + 1).begin);
    EXPECT_EQ(nth(n).number, 10.0 + static_cast<double>(n));
  }
  EXPECT_TRUE(nth(4).running);
  EXPECT_FALSE(nth(4).complete());
}

TEST_F(Laps, EveryPointHasItsTimeAndTheSpeedThere) {
  drive(0.0, 70.0);
  EXPECT_EQ(log_.points(), 200U);
  for (std::size_t n = 1; n <= 3; ++n) {
    const double begin_s = (nth(n).begin - kStart).seconds();
    for (std::size_t i = 0; i < log_.points(); ++i) {
      const double at_s = time_of(1'000.0 * static_cast<double>(n) + 5.0 * static_cast<double>(i));
      EXPECT_NEAR(static_cast<double>(nth(n).column(LapColumn::kTime)[i]), at_s - begin_s, kTime_s);
      EXPECT_NEAR(static_cast<double>(nth(n).column(LapColumn::kSpeed)[i]), speed_at(at_s),
                  kSpeed_mps)
          << n << " " << i;
    }
  }
  for (const float brake : nth(2).column(LapColumn::kBrake)) {
    EXPECT_TRUE(std::isnan(brake)) << "never received";
  }
}

TEST_F(Laps, AGapInsideALapIsAGapOfItsPointsAndNothingElse) {
  const double lost_s = time_of(1'300.0), back_s = time_of(1'500.0);
  drive(0.0, 70.0, [&](double t) { return t < lost_s || t > back_s; });
  ASSERT_EQ(log_.laps().size(), 5U);
  EXPECT_TRUE(nth(1).complete());
  EXPECT_NEAR(nth(1).time_s(), time_of(2'000.0) - time_of(1'000.0), 2.0 * kTime_s);
  EXPECT_NEAR(nth(1).gap.seconds(), back_s - lost_s, 2.0 * kTick_s);
  EXPECT_EQ(nth(2).gap.ns, 0);
  for (std::size_t i = 0; i < log_.points(); ++i) {
    const double at_m = 5.0 * static_cast<double>(i);
    const bool near_the_edge = std::abs(at_m - 300.0) < 5.0 || std::abs(at_m - 500.0) < 5.0;
    if (near_the_edge) continue;
    const bool inside = at_m > 300.0 && at_m < 500.0;
    EXPECT_EQ(std::isnan(nth(1).column(LapColumn::kTime)[i]), inside) << at_m;
    EXPECT_EQ(std::isnan(nth(1).column(LapColumn::kSpeed)[i]), inside) << at_m;
  }
}

TEST_F(Laps, AGapOverTheLineLeavesBothLapsWithoutATime) {
  const double lost_s = time_of(1'900.0), back_s = time_of(2'100.0);
  drive(0.0, 70.0, [&](double t) { return t < lost_s || t > back_s; });
  ASSERT_EQ(log_.laps().size(), 5U);
  EXPECT_TRUE(nth(1).start_seen);
  EXPECT_FALSE(nth(1).finish_seen);
  EXPECT_FALSE(nth(2).start_seen);
  EXPECT_TRUE(nth(2).finish_seen);
  EXPECT_TRUE(std::isnan(nth(1).time_s()) && std::isnan(nth(2).time_s()));
  EXPECT_TRUE(nth(3).complete());
  EXPECT_EQ(log_.best(), &nth(3));
  EXPECT_TRUE(std::isnan(nth(2).column(LapColumn::kSpeed)[10]));
  EXPECT_FALSE(std::isnan(nth(2).column(LapColumn::kSpeed)[30]));
}

TEST_F(Laps, OneGroupThatIsMissingIsAGapOfItsColumnOnly) {
  drive(0.0, time_of(1'300.0));
  // The station alone, for half a lap.
  for (double t = time_of(1'300.0); t < time_of(1'800.0); t += kTick_s) {
    state_.values[telemetry::field("track.station")] = std::fmod(way_at(t), kLength_m);
    tell(Group::kTrack, t);
  }
  drive(time_of(1'800.0), 70.0);
  EXPECT_TRUE(nth(1).complete());
  EXPECT_FALSE(std::isnan(nth(1).column(LapColumn::kTime)[100]));
  EXPECT_TRUE(std::isnan(nth(1).column(LapColumn::kSpeed)[100]));
  EXPECT_FALSE(std::isnan(nth(1).column(LapColumn::kSpeed)[50]));
  EXPECT_FALSE(std::isnan(nth(1).column(LapColumn::kSpeed)[170]));
}

TEST_F(Laps, ACarThatStandsOnTheLineDrivesNoLaps) {
  for (int i = 0; i < 1'000; ++i) {
    state_.values[telemetry::field("track.station")] = i % 2 == 0 ? 0.3 : kLength_m - 0.3;
    tell(Group::kTrack, i * kTick_s);
  }
  ASSERT_EQ(log_.laps().size(), 1U);
  EXPECT_TRUE(log_.laps().front().running);
}

TEST_F(Laps, ACountThatComesLaterIsAChange) {
  drive(0.0, 10.0);
  const std::uint64_t before = log_.revision();
  drive(10.0, 10.4);
  EXPECT_EQ(log_.revision(), before);
  state_.values[telemetry::field("track.lap")] = 77.0;
  tell(Group::kTrack, 10.41);
  EXPECT_EQ(nth(log_.laps().size() - 1).number, 77.0);
  EXPECT_GT(log_.revision(), before);
}

TEST_F(Laps, ASampleExactlyAtAPointIsThatPoint) {
  state_.values[telemetry::field("ego.vx")] = 50.0;
  for (int i = 0; i < 40; ++i) {
    // It stands at 950 m, and comes to the line at a sample.
    const double way_m = std::max(950.0, 950.0 + 2.0 * (i - 10));
    state_.values[telemetry::field("track.station")] = std::fmod(way_m, kLength_m);
    tell(Group::kEgo, i * kTick_s);
    tell(Group::kTrack, i * kTick_s);
  }
  ASSERT_EQ(log_.laps().size(), 1U) << "50 m are no lap";
  const Lap& lap = nth(0);
  EXPECT_TRUE(lap.start_seen);
  EXPECT_EQ(lap.column(LapColumn::kTime)[0], 0.0F);
  EXPECT_EQ(lap.column(LapColumn::kSpeed)[0], 50.0F);
}

TEST_F(Laps, ALapKeepsTheTimeOfItsFirstPassage) {
  const auto at = [&](double t, double station) {
    state_.values[telemetry::field("track.station")] = station;
    tell(Group::kTrack, t);
  };
  double t = 0.0;
  for (double s = 990.0; s <= 1'100.0; s += 2.0, t += kTick_s) at(t, std::fmod(s, kLength_m));
  const float there = nth(log_.laps().size() - 1).column(LapColumn::kTime)[15];
  for (double s = 98.0; s >= 50.0; s -= 2.0, t += kTick_s) at(t, s);
  for (double s = 52.0; s <= 150.0; s += 2.0, t += kTick_s) at(t, s);
  const Lap& lap = log_.laps().back();
  EXPECT_EQ(lap.column(LapColumn::kTime)[15], there);
  EXPECT_GT(lap.column(LapColumn::kTime)[21], lap.column(LapColumn::kTime)[20] + 1.9F);
}

TEST_F(Laps, TheMemoryIsBoundedAndTheFastestLapStays) {
  drive(0.0, 70.0);
  // Slower laps, in steps of 20 m at 40 m/s.
  double way_m = std::floor(way_at(70.0) / 20.0) * 20.0 + 20.0, t = 70.4;
  const Lap fastest = *log_.best();
  for (; log_.laps().back().id < LapLog::kMostLaps + 50; way_m += 20.0, t += 0.5) {
    state_.values[telemetry::field("track.station")] = std::fmod(way_m, kLength_m);
    tell(Group::kTrack, t);
  }
  EXPECT_EQ(log_.laps().size(), LapLog::kMostLaps);
  ASSERT_NE(log_.best(), nullptr);
  EXPECT_EQ(log_.best()->id, fastest.id);
  EXPECT_EQ(log_.find(1), nullptr);
  EXPECT_EQ(log_.find(fastest.id), log_.best());
  const LapLog long_track{20'000.0};
  EXPECT_EQ(long_track.points(), LapLog::kMostPoints);
  EXPECT_DOUBLE_EQ(long_track.step_m(), 20.0);
}

TEST_F(Laps, ShortPiecesOfALostWayAreNoLaps) {
  for (int i = 0; i < 500; ++i) {
    state_.values[telemetry::field("track.station")] = i % 2 == 0 ? 100.0 : 600.0;
    tell(Group::kTrack, i * kTick_s);
  }
  EXPECT_EQ(log_.laps().size(), 1U);
}

}  // namespace
}  // namespace pitwall::state
