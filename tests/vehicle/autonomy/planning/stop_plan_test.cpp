// Laws of the stop: for random speeds, roads and tyres it stays inside its share of the ellipse,
// slows only, keeps its jerk, keeps its distance to the walls, ends lower, never steps, and leads a
// car that does not slow down back to the line.
// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/stop_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "protocol/vocabulary/random.hpp"
#include "tests/vehicle/autonomy/planning/stadium.hpp"

namespace pitwall::planning {
namespace {

using testing::ego_on;
using testing::green;
using testing::kParams;

StopLimits limits_on(double tyre_c) {
  return {on_tyres(kParams.line.friction, tyre_c), kParams.stop_grip_share,
          kParams.stop_decel_max_mps2, kParams.stop_jerk_max_mps3};
}

// A road whose curvature and banking wander as those of an oval do: by ramps of 60 m and more.
RoadAhead random_road(Random& random) {
  const auto sample = [&] {
    return RoadSample{random.between(-0.003, 0.0045), random.between(-0.05, 0.35)};
  };
  RoadAhead road;
  RoadSample from = sample();
  std::size_t i = 0;
  while (i < kRoadPoints) {
    const RoadSample to = sample();
    const auto steps = static_cast<std::size_t>(random.between(60.0, 200.0) / kRoadStep_m);
    for (std::size_t k = 0; k < steps && i < kRoadPoints; ++k, ++i) {
      const double t = static_cast<double>(k) / static_cast<double>(steps);
      road.at[i] = {from.curvature_per_m + t * (to.curvature_per_m - from.curvature_per_m),
                    from.bank_rad + t * (to.bank_rad - from.bank_rad)};
    }
    from = to;
  }
  return road;
}

// What the tyres are asked for, as a share of their ellipse, written anew: the corner and the front
// axle, which brakes with brake_front of the force on load_front of the load and what shifts to it.
double used(const envelope::FrictionParams& car, const RoadSample& p, double v, double brake) {
  const double g = 9.80665, c = std::cos(p.bank_rad), s = std::sin(p.bank_rad);
  const double n = g * c + v * v * p.curvature_per_m * s + car.downforce_per_m * v * v;
  const double lateral = std::abs(v * v * p.curvature_per_m * c - g * s) / (car.friction * n);
  const double front =
      car.brake_front * brake /
      (car.long_friction * car.friction * (car.load_front * n + car.load_shift * brake));
  return std::hypot(lateral, front);
}

TEST(StopPlan, DemandStaysInsideItsShareOfTheEllipseOnEveryRoadAtEveryTemperature) {
  Random random{7};
  for (int run = 0; run < 200; ++run) {
    const RoadAhead road = random_road(random);
    const StopLimits limits = limits_on(random.between(10.0, 100.0));
    SpeedReference now{random.between(5.0, 68.0), 0.0};
    double d = 0.0, last_accel = 0.0;
    for (int i = 0; i < 3000 && now.speed_mps > 0.0 && d < 1100.0; ++i) {
      constexpr double kDt_s = 0.02;
      RoadAhead from = road;
      const auto skip = static_cast<std::size_t>(d / kRoadStep_m + 0.5);
      for (std::size_t k = 0; k < kRoadPoints; ++k)
        from.at[k] = road.at[std::min(k + skip, kRoadPoints - 1)];
      const SpeedReference next = advance_stop(from, now, limits, kDt_s);
      ASSERT_LE(next.speed_mps, now.speed_mps + 1e-9);
      if (next.speed_mps > 0.0) {
        ASSERT_LE(std::abs(next.accel_mps2 - last_accel), limits.jerk_max_mps3 * kDt_s + 1e-9);
      }
      const double free = coasting_mps2(limits.friction, next.speed_mps);
      const double brake = std::max(-next.accel_mps2 - free, 0.0);
      const double corner = used(limits.friction, road.sample(d), next.speed_mps, 0.0);
      ASSERT_LE(used(limits.friction, road.sample(d), next.speed_mps, brake),
                std::max(limits.grip_share, corner) + 0.02)
          << run << ' ' << d << ' ' << next.speed_mps;
      d += 0.5 * (now.speed_mps + next.speed_mps) * kDt_s;
      last_accel = next.accel_mps2;
      now = next;
    }
  }
}

TEST(StopPlan, ColdTyresNeverBrakeHarderAndNoTemperatureIsCold) {
  const steering::RoadLoad at{50.0, 0.004, 0.3};
  double last = 0.0;
  for (double tyre_c = -20.0; tyre_c < 120.0; tyre_c += 5.0) {
    const double brake = brake_available_mps2(limits_on(tyre_c).friction, at, 0.7);
    EXPECT_GE(brake, last);
    last = brake;
  }
  EXPECT_EQ(brake_available_mps2(limits_on(kUnset).friction, at, 0.7),
            brake_available_mps2(limits_on(-20.0).friction, at, 0.7));
}

struct StopRig {
  world::TrackMap track = testing::stadium(230.0);
  Line line = prepare(kParams, track).value();
};

TEST(StopPlan, PathEndsNoHigherKeepsItsClearanceAndNeverSteps) {
  const StopRig rig;
  int moved = 0;
  for (double s = 0.0; s < rig.line.length_m; s += 61.0) {
    for (const double v : {15.0, 40.0, 66.0}) {
      for (const double tyre_c : {85.0, 30.0}) {
        for (const double aside : {-1.5, 0.0, 1.0}) {
          const StopPath path =
              choose_stop(rig.line, {s, v, {}, aside}, limits_on(tyre_c), kParams.stop_path);
          const Offset first = offset_at(path, 0.0);
          EXPECT_NEAR(first.n_m, aside, 1e-9);
          EXPECT_NEAR(first.slope, 0.0, 1e-9);
          EXPECT_NEAR(first.bend_per_m, 0.0, 1e-9);
          StopLimits softer = limits_on(tyre_c);
          softer.decel_max_mps2 *= path.decel_share;
          const SpeedProfile slowing =
              stop_profile(road_ahead(rig.line, path, s), {v, 0.0}, softer, 40.0);
          double last_m = aside;
          for (double d = 0.0; d < 1.3 * slowing.stop_distance_m; d += 1.0) {
            const Offset o = offset_at(path, d);
            EXPECT_GE(o.n_m, last_m - 1e-9);  // banked to the left everywhere
            const auto k = static_cast<std::size_t>(d / slowing.spacing_m);
            const double then = slowing.at[std::min(k, slowing.at.size() - 1)].speed_mps;
            EXPECT_LE(std::abs(o.bend_per_m) * then * then, 1.6);
            const LinePoint p = rig.line.at(s + d);
            EXPECT_GE(p.room_left_m - o.n_m, kParams.stop_path.clearance_m - 1e-6);
            last_m = o.n_m;
          }
          if (last_m > aside + 0.1) ++moved;
        }
      }
    }
  }
  EXPECT_GT(moved, 100);
}

double lowest_m(const StopPath& path) { return path.low.to_m; }

TEST(StopPlan, NoChangeLeadsIntoACarBesideOrToWhereOneFromBehindWillCome) {
  const StopRig rig;
  const auto path_beside = [&](std::vector<Neighbour> others, OffsetChange merge = {}) {
    return choose_stop(
        rig.line,
        {.s_m = 61.0, .speed_mps = 45.0, .merge = merge, .beside_m = -2.5, .neighbours = others},
        limits_on(85.0), kParams.stop_path);
  };
  ASSERT_GT(lowest_m(path_beside({})), 1.0) << "alone it goes down";
  EXPECT_EQ(lowest_m(path_beside({{-60.0, 1.0, 60.0}})), 0.0) << "it passes";
  EXPECT_EQ(lowest_m(path_beside({{-60.0, 1.0, 20.0}})), 0.0) << "it comes once we stand";
  EXPECT_GT(lowest_m(path_beside({{190.0, 1.0, 45.0}})), 1.0) << "it stays ahead";
  EXPECT_GT(lowest_m(path_beside({{-15.0, -2.5, 45.0}})), 1.0)
      << "who follows in our lane is met anyway";
}

TEST(StopPlan, AMergeThatLeadsIntoACarIsTakenBack) {
  const StopRig rig;
  // From 5 m outside back to the line, a third of the way done.
  const OffsetChange merge{.from_s_m = 61.0 - 70.0, .length_m = 220.0, .from_m = -5.0, .to_m = 0.0};
  const Neighbour beside{0.0, 1.0, 45.0};
  const auto end_of = [&](std::span<const Neighbour> others) {
    const StopFrom from{.s_m = 61.0, .speed_mps = 45.0, .merge = merge, .neighbours = others};
    const StopPath path = choose_stop(rig.line, from, limits_on(85.0), kParams.stop_path);
    EXPECT_NEAR(offset_at(path, 0.0).n_m, offset_at(merge, 61.0).n_m, 1e-9);
    return offset_at(path, 150.0).n_m;
  };
  EXPECT_GE(end_of({}), -1e-9);
  EXPECT_NEAR(end_of(std::span{&beside, 1}), offset_at(merge, 61.0).n_m, 1e-6);
}

// A car that was to pass us, but stays beside the place where the change ends.
TEST(StopPlan, AChangeUnderWayEndsWhereItIsForACarThatHasComeIntoItsWay) {
  const StopRig rig;
  constexpr double kBegin_m = 61.0, kSpeed_mps = 38.0, kReach_m = 120.0;
  const StopPath planned =
      choose_stop(rig.line, {.s_m = kBegin_m, .speed_mps = 45.0, .merge = {}, .beside_m = -2.5},
                  limits_on(85.0), kParams.stop_path);
  ASSERT_GT(lowest_m(planned), 2.0);
  for (const double share : {0.0, 0.15, 0.3}) {
    StopPath path = planned;
    path.gone_m = planned.low.from_s_m + share * planned.low.length_m;
    const Offset before = offset_at(path, path.gone_m);
    const auto followed = [&](std::vector<Neighbour> others) {
      StopPath out = path;
      keep_clear(out, rig.line,
                 {.s_m = kBegin_m + path.gone_m,
                  .speed_mps = kSpeed_mps,
                  .merge = {},
                  .neighbours = others},
                 limits_on(85.0), kParams.stop_path);
      return out;
    };
    const StopPath alone = followed({}), passed = followed({{80.0, before.n_m, 60.0}});
    for (const StopPath& same : {alone, passed})
      for (double d = 0.0; d < kReach_m; d += 5.0)
        EXPECT_EQ(offset_at(same, same.gone_m + d).n_m, offset_at(path, path.gone_m + d).n_m);
    const double other_m = -2.5 + lowest_m(planned) + 2.5;
    const StopPath ended = followed({{0.0, other_m, 30.0}});
    const Offset now = offset_at(ended, ended.gone_m);
    EXPECT_NEAR(now.n_m, before.n_m, 1e-9) << share;
    EXPECT_NEAR(now.slope, before.slope, 1e-9) << share;
    EXPECT_NEAR(now.bend_per_m, before.bend_per_m, 1e-9) << share;
    for (double d = 0.0; d < kReach_m; d += 1.0) {
      const Offset o = offset_at(ended, ended.gone_m + d);
      EXPECT_LE(o.n_m, other_m - 3.0) << share << " after " << d;
      EXPECT_LE(std::abs(o.bend_per_m) * kSpeed_mps * kSpeed_mps, 4.0) << share << " after " << d;
    }
  }
}

// Whoever is around, and wherever: those whom the chosen path meets, it would meet anyway.
TEST(StopPlan, MeetsNobodyWhomItWouldNotMeetWhereItIs) {
  const StopRig rig;
  Random random{11};
  int kept = 0;
  for (int run = 0; run < 300; ++run) {
    std::array<Neighbour, 3> others{};
    for (Neighbour& other : others)
      other = {random.between(-120.0, 120.0), random.between(-6.0, 6.0), random.between(0.0, 70.0)};
    const double v = random.between(20.0, 65.0), aside = random.between(-3.0, 1.0);
    const double s = random.between(0.0, rig.line.length_m);
    const StopFrom from{
        .s_m = s, .speed_mps = v, .merge = {}, .beside_m = aside, .neighbours = others};
    const StopPath path = choose_stop(rig.line, from, limits_on(85.0), kParams.stop_path);
    StopLimits softer = limits_on(85.0);
    softer.decel_max_mps2 *= path.decel_share;
    const SpeedProfile slowing =
        stop_profile(road_ahead(rig.line, path, s), {v, 0.0}, softer, 40.0);
    for (const Neighbour& other : others) {
      // At two thirds of the distances that the planner keeps: its stop has no jerk.
      bool met = false, met_anyway = false;
      double other_m = other.ahead_m;
      for (double d = 0.0; d < slowing.stop_distance_m - 2.0; d += 1.0) {
        const auto k = static_cast<std::size_t>(d / slowing.spacing_m);
        const double then = std::max(slowing.at[std::min(k, slowing.at.size() - 1)].speed_mps, 1.0);
        if (std::abs(other_m - d) < 10.0) {
          met_anyway = met_anyway || std::abs(other.offset_m - aside) < 3.0;
          met = met || (std::abs(other_m - d) < 6.5 &&
                        std::abs(other.offset_m - offset_at(path, d).n_m) < 2.0);
        }
        other_m += other.speed_mps / then;
      }
      EXPECT_TRUE(!met || met_anyway) << run;
    }
    if (path.low.to_m == 0.0) ++kept;
  }
  EXPECT_GT(kept, 30);
}

TEST(StopPlan, PathOfACarThatDoesNotStopLeadsBackToTheLineForEver) {
  const StopRig rig;
  for (double s = 0.0; s < rig.line.length_m; s += 61.0) {
    for (const double v : {15.0, 40.0, 66.0}) {
      for (const double aside : {-1.5, 0.0, 1.0}) {
        const StopPath path =
            choose_stop(rig.line, {s, v, {}, aside}, limits_on(85.0), kParams.stop_path);
        for (double d = 0.0; d < 2.5 * rig.line.length_m; d += 2.0) {
          const Offset o = offset_at(path, d);
          const LinePoint p = rig.line.at(s + d);
          ASSERT_GE(std::min(p.room_left_m - o.n_m, p.room_right_m + o.n_m),
                    kParams.stop_path.clearance_m - 1e-6);
          if (d > path.back.from_s_m) {
            ASSERT_LE(std::abs(o.bend_per_m) * v * v, 1.6);
          }
          if (d > 0.9 * rig.line.length_m) {
            ASSERT_NEAR(o.n_m, 0.0, 1e-9);
          }
        }
      }
    }
  }
}

TEST(StopPlan, CarThatDoesNotSlowDownIsSteeredRoundTheTrackWithoutAStep) {
  const StopRig rig;
  State state;
  const double v = 50.0, dt_s = 0.05;
  double s = 300.0, lowest_m = 0.0;
  std::optional<double> last_m;
  for (Instant now{}; s < 300.0 + 2.0 * rig.line.length_m;
       now += from_seconds(dt_s), s += v * dt_s) {
    const double n = last_m ? offset_at(state.stop, state.stop.gone_m + v * dt_s).n_m : 0.0;
    const world::EgoState ego = ego_on(rig.line, s, n, v);
    const world::RaceControl rc = green(v);
    const Output out = step(kParams, rig.line, rig.track, state,
                            {.ego = ego,
                             .race_control = rc,
                             .followed = last_m ? Followed::kStop : Followed::kDrive,
                             .tyre_c = 85.0},
                            now);
    const world::TrajectoryPoint& p = out.stop.points[0];
    ASSERT_NEAR(std::hypot(p.x_m - ego.x_m, p.y_m - ego.y_m), 0.0, 1e-3) << s;
    if (last_m) {
      ASSERT_NEAR(n, *last_m, 0.2) << s;
    }
    lowest_m = std::max(lowest_m, n);
    last_m = n;
    state = out.next;
  }
  EXPECT_GT(lowest_m, 2.0);
  EXPECT_NEAR(*last_m, 0.0, 1e-9);
}

TEST(StopPlan, ConsecutivePlansAndTheChangeToTheStopAreContinuous) {
  const StopRig rig;
  for (const Followed followed : {Followed::kStop, Followed::kEmergency}) {
    State state;
    double s = 300.0, v = 65.0, gone_m = 0.0;
    std::optional<world::TrajectoryPoint> last;
    double last_accel = 0.0;
    Instant now{};
    for (int i = 0; i < 900 && (i < 60 || v > 0.0); ++i, now += milliseconds(50)) {
      const double n = state.started ? offset_at(state.stop, state.stop.gone_m + gone_m).n_m : 0.0;
      const bool stopping = i >= 40;
      const world::EgoState ego = ego_on(rig.line, s, stopping ? n : 0.0, v);
      const world::RaceControl rc = green(65.0);
      const Output out = step(kParams, rig.line, rig.track, state,
                              {.ego = ego,
                               .race_control = rc,
                               .followed = stopping ? followed : Followed::kDrive,
                               .tyre_c = 85.0},
                              now);
      const world::TrajectoryPoint& p = out.stop.points[0];
      EXPECT_NEAR(std::hypot(p.x_m - ego.x_m, p.y_m - ego.y_m), 0.0, 1e-3);
      EXPECT_NEAR(p.speed_mps, out.drive.points[0].speed_mps, 1e-9);
      if (i == 40) {
        EXPECT_NEAR(wrap_pi(p.yaw_rad - out.drive.points[0].yaw_rad), 0.0, 1e-3);
        EXPECT_NEAR(p.curvature_per_m, out.drive.points[0].curvature_per_m, 1e-4);
      }
      if (last) {
        EXPECT_NEAR(p.curvature_per_m, last->curvature_per_m, 4e-4) << i;
        EXPECT_LE(std::abs(p.speed_mps - last->speed_mps), 0.55) << i;
      }
      if (stopping && out.next.speed_mps > 0.0) {
        const double jerk = std::abs(out.next.accel_mps2 - last_accel) / 0.05;
        EXPECT_LE(jerk, kParams.emergency_jerk_max_mps3 + 1e-6) << i;
      }
      last = p;
      last_accel = out.next.accel_mps2;
      state = out.next;
      v = out.next.speed_mps;
      gone_m = v * 0.05;
      s += gone_m;
    }
    EXPECT_EQ(v, 0.0);
  }
}

}  // namespace
}  // namespace pitwall::planning
