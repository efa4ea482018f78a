// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/governor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/random.hpp"
#include "tests/vehicle/autonomy/planning/stadium.hpp"
#include "vehicle/autonomy/planning/speed_profile.hpp"

namespace pitwall::planning {
namespace {

constexpr double kTick_s = 0.05;
constexpr Pace kRacing{.accel_max_mps2 = 6.0, .decel_max_mps2 = 8.0, .jerk_max_mps3 = 12.0};

LineParams engined() {
  LineParams p = testing::kParams.line;
  p.friction.engine = envelope::testing::av21_engine();
  return p;
}

// What is read of the envelope, it is read at places 0.2 s apart: by what the jerk does meanwhile
// the reference may be late.
constexpr double kBetweenReads_s = 0.2;
// The reference may pass the speeds of the road by this: it brakes when a corner begins to matter.
constexpr double kPassed_mps = 0.3;

struct Governed {
  LineParams params = engined();
  Line line;
  DriveLimits limits;
  SpeedReference now;
  double s_m = 0.0;
  OffsetChange merge{};
  bool knows_merge = true;

  Governed(double radius_m, double tyre_c, const Pace& pace)
      : line(build_line(testing::stadium(radius_m), params).value()),
        limits{.target_mps = 0.0,
               .pace = pace,
               .corners = pace,
               .friction = on_tyres(params.friction, tyre_c),
               .grip_share = params.grip_share,
               .tyres = world::place_of(params.friction.tyres, tyre_c),
               .steering = nullptr} {}

  // Its acceleration since the last one.
  void tick() {
    const SpeedReference last = now;
    now = advance_drive(look_ahead(line, s_m, limits, knows_merge ? merge : OffsetChange{}), last,
                        limits, kTick_s);
    s_m += 0.5 * (last.speed_mps + now.speed_mps) * kTick_s;
  }

  steering::RoadLoad road() const {
    const LinePoint p = line.at(s_m);
    const double turn = curvature_beside(p.curvature_per_m, offset_at(line, merge, s_m));
    return {now.speed_mps, turn, p.bank_rad};
  }
};

void expect_within_the_envelope(const Governed& car, double jerk_mps3) {
  const double late_mps2 = jerk_mps3 * kBetweenReads_s;
  const steering::RoadLoad at = car.road();
  const envelope::FrictionParams& f = car.limits.friction;
  const double share = car.limits.grip_share, v = car.now.speed_mps;
  EXPECT_LE(car.now.accel_mps2, drive_available_mps2(f, at, share) + late_mps2) << v;
  EXPECT_GE(car.now.accel_mps2,
            -brake_available_mps2(f, at, share) - f.drag_per_m * v * v - late_mps2)
      << v;
  // Of the corner, by so much as the speed may be passed, and as the speeds between two rows of
  // tyre temperatures are convex in them.
  constexpr double kConvex = 1.02;
  const double passed = 1.0 + 2.0 * kPassed_mps / std::max(v, 10.0);
  EXPECT_LE(std::abs(lateral_demand_mps2(at)), passed * kConvex * share * grip_mps2(f, at)) << v;
}

// Demands as they come from race control, operator and planner, at any time and place; tyres of any
// temperature; both paces, that change, too.
TEST(Governor, RandomDemandsNeverStepAndStayWithinTheEnvelope) {
  Random random{11};
  double fastest_mps = 0.0, hardest_mps2 = 0.0;
  for (int run = 0; run < 24; ++run) {
    const bool tight = run % 2 == 0;
    Governed car{tight ? 60.0 : 200.0, random.between(25.0, 90.0), testing::kParams.comfort};
    const bool paces_change = run % 3 == 0;
    if (run % 3 != 2) car.limits.corners = kRacing;
    if (run % 3 == 1) car.limits.pace = kRacing;
    car.s_m = random.between(0.0, car.line.length_m);
    for (int i = 0; i < 1200; ++i) {
      if (random.between(0.0, 1.0) < 0.02)
        car.limits.target_mps = std::max(random.between(-20.0, 80.0), 0.0);
      if (paces_change && random.between(0.0, 1.0) < 0.005)
        car.limits.pace = car.limits.pace.jerk_max_mps3 == kRacing.jerk_max_mps3
                              ? testing::kParams.comfort
                              : kRacing;
      const SpeedReference last = car.now;
      car.tick();
      const double jerk_mps3 = car.limits.corners.jerk_max_mps3;
      if (car.now.speed_mps > 0.0) {
        EXPECT_LE(std::abs(car.now.accel_mps2 - last.accel_mps2), jerk_mps3 * kTick_s + 1e-9);
        expect_within_the_envelope(car, jerk_mps3);
      }
      fastest_mps = std::max(fastest_mps, car.now.speed_mps);
      hardest_mps2 = std::max(hardest_mps2, -car.now.accel_mps2);
      if (HasFailure()) {
        ADD_FAILURE() << "run " << run << " tick " << i << " at " << car.s_m << " m, "
                      << last.speed_mps << " m/s";
        return;
      }
    }
  }
  EXPECT_GT(fastest_mps, 65.0);
  EXPECT_GT(hardest_mps2, 5.0);
}

// Back to its line from 5 m beside it in 2.5 s, begun anywhere on the lap, as it is known a little
// before: the merge turns the car more than the line does, which counts.
TEST(Governor, AMergeInACornerIsWithinTheEnvelopeToo) {
  constexpr double kNotice_m = 60.0;
  const auto most_used = [](bool knows) {
    double most = 0.0;
    for (int begin = 0; begin < 24; ++begin) {
      Governed car{120.0, 85.0, kRacing};
      car.limits.target_mps = 80.0;
      while (car.s_m < car.line.length_m * (1.0 + begin / 24.0)) car.tick();
      const double begin_m = car.s_m, length_m = 2.5 * car.now.speed_mps;
      car.merge = {.from_s_m = car.line.wrap(begin_m + kNotice_m),
                   .length_m = length_m,
                   .from_m = begin % 2 == 0 ? -5.0 : 5.0};
      car.knows_merge = knows;
      for (; car.s_m < begin_m + kNotice_m + length_m; car.tick()) {
        const steering::RoadLoad at = car.road();
        const double carried = car.limits.grip_share * grip_mps2(car.limits.friction, at);
        most = std::max(most, std::abs(lateral_demand_mps2(at)) / carried);
      }
    }
    return most;
  };
  EXPECT_LE(most_used(true), 1.03);
  EXPECT_GT(most_used(false), 1.08) << "it made no difference";
}

TEST(Governor, SlowsInTimeForATightTurn) {
  for (const Pace& pace : {testing::kParams.comfort, kRacing}) {
    Governed car{60.0, 85.0, pace};
    car.limits.target_mps = 68.0;
    double most_mps = 0.0, least_mps2 = 0.0;
    while (car.s_m < 3.0 * car.line.length_m) {
      car.tick();
      EXPECT_LE(car.now.speed_mps, car.line.at(car.s_m).speed_mps.back() + kPassed_mps) << car.s_m;
      most_mps = std::max(most_mps, car.now.speed_mps);
      least_mps2 = std::min(least_mps2, car.now.accel_mps2);
    }
    // What is planned, and what brings back a speed that is passed (speed_reference.hpp).
    const double back_mps2 = std::sqrt(2.0 * 0.8 * pace.jerk_max_mps3 * kPassed_mps);
    EXPECT_GE(least_mps2, -0.9 * pace.decel_max_mps2 - back_mps2);
    EXPECT_GT(most_mps, 45.0);
  }
}

// A lap at racing pace takes little longer than the line's own: the speeds rise and fall with
// limited jerk, and a tenth of the brakes is kept. At comfort it takes longer.
TEST(Governor, ARacingLapIsThatOfTheLine) {
  const auto lap_s = [](const Pace& pace) {
    Governed car{60.0, 85.0, pace};
    car.limits.target_mps = 100.0;
    while (car.s_m < car.line.length_m) car.tick();
    double time_s = 0.0;
    for (const double end_m = 2.0 * car.line.length_m; car.s_m < end_m; time_s += kTick_s)
      car.tick();
    return time_s;
  };
  const double best_s = Governed{60.0, 85.0, kRacing}.line.lap_s.back();
  const double racing_s = lap_s({.accel_max_mps2 = 10, .decel_max_mps2 = 10, .jerk_max_mps3 = 30});
  EXPECT_GT(racing_s, best_s - kTick_s);
  EXPECT_LT(racing_s, 1.05 * best_s);
  EXPECT_GT(lap_s(testing::kParams.comfort), racing_s);
}

// A demand is met gently, a corner that comes as a surprise with all that the brakes have.
TEST(Governor, OnlyACornerBrakesHarderThanThePace) {
  Governed car{60.0, 85.0, testing::kParams.comfort};
  const double turn_m = 480.0;  // the curvature has begun to rise
  car.s_m = 300.0, car.now = {35.0, 0.0}, car.limits.target_mps = 0.0;
  double least_mps2 = 0.0;
  while (car.now.speed_mps > 0.0) car.tick(), least_mps2 = std::min(least_mps2, car.now.accel_mps2);
  EXPECT_GE(least_mps2, -testing::kParams.comfort.decel_max_mps2 - 1e-9);
  car.s_m = turn_m - 110.0, car.now = {60.0, 0.0}, car.limits.target_mps = 60.0;
  least_mps2 = 0.0;
  while (car.s_m < turn_m) car.tick(), least_mps2 = std::min(least_mps2, car.now.accel_mps2);
  EXPECT_LT(least_mps2, -1.5 * testing::kParams.comfort.decel_max_mps2);
}

// Its brakes are not used, whatever lies ahead.
TEST(Governor, ACarThatCoastsSlowsAsDragDoes) {
  Governed car{60.0, 85.0, testing::kParams.comfort};
  constexpr double kCoast_mps2 = 1.5;
  car.limits.brake_most_mps2 = car.limits.pace.decel_max_mps2 = kCoast_mps2;
  car.limits.corners.decel_max_mps2 = kCoast_mps2;
  car.s_m = 350.0, car.now = {60.0, 0.0}, car.limits.target_mps = 0.0;
  const double drag_mps2 = car.limits.friction.drag_per_m * 60.0 * 60.0;
  for (int i = 0; i < 60; ++i) {
    car.tick();
    EXPECT_GE(car.now.accel_mps2, -std::max(kCoast_mps2, drag_mps2));
  }
  EXPECT_LT(car.now.speed_mps, 58.0);
}

// Tyres that are suddenly believed to be cold, in a turn at the limit of warm ones.
TEST(Governor, ColderTyresSlowTheCarWithoutAStep) {
  Governed car{60.0, 85.0, kRacing};
  car.limits.target_mps = 68.0;
  while (car.s_m < 1.3 * car.line.length_m) car.tick();
  while (std::abs(car.line.at(car.s_m).curvature_per_m) < 1.0 / 61.0) car.tick();
  const double begin_mps = car.now.speed_mps;
  car.limits.friction = on_tyres(car.params.friction, kUnset);
  car.limits.tyres = {};
  for (int i = 0; i < 100; ++i) {
    const SpeedReference last = car.now;
    car.tick();
    EXPECT_LE(std::abs(car.now.accel_mps2 - last.accel_mps2),
              kRacing.jerk_max_mps3 * kTick_s + 1e-9);
  }
  EXPECT_LT(car.now.speed_mps, begin_mps - 1.0);
}

}  // namespace
}  // namespace pitwall::planning
