// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/planning.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "tests/support/allocation_guard.hpp"
#include "tests/vehicle/autonomy/planning/stadium.hpp"

namespace pitwall::planning {
namespace {

using testing::ego_on;
using testing::green;
using testing::recommended;
using world::TrackFlag;

struct PlanningRig {
  Params params = recommended();
  world::TrackMap track = testing::stadium();
  Line line = prepare(params, track).value();
  State state;
  Instant now{};
  double s_m = 0.0, offset_m = 0.0, speed_mps = 0.0, tyre_c = 85.0;

  // One tick of 50 ms with a car that does exactly what it is told.
  Output tick(const world::RaceControl& rc, Followed followed = Followed::kDrive,
              double limit_mps = kUnset) {
    const world::EgoState ego = ego_on(line, s_m, offset_m, speed_mps);
    const Output out = step(params, line, track, state,
                            {.ego = ego,
                             .race_control = rc,
                             .operator_speed_limit_mps = limit_mps,
                             .followed = followed,
                             .tyre_c = tyre_c},
                            now);
    state = out.next;
    now += milliseconds(50);
    speed_mps = out.next.speed_mps;
    s_m += speed_mps * 0.05;
    return out;
  }
};

void expect_drivable(const world::Trajectory& t) {
  ASSERT_EQ(t.points.size(), world::kTrajectoryPoints);
  for (std::size_t i = 1; i < t.points.size(); ++i) {
    const auto &a = t.points[i - 1], &b = t.points[i];
    const double d = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    ASSERT_NEAR(b.s_m - a.s_m, d, 1e-9);
    ASSERT_GT(d, 0.5);
    const double chord_yaw = std::atan2(b.y_m - a.y_m, b.x_m - a.x_m);
    EXPECT_NEAR(wrap_pi(chord_yaw - a.yaw_rad), 0.5 * d * a.curvature_per_m, 0.01) << i;
    EXPECT_NEAR(wrap_pi(b.yaw_rad - a.yaw_rad), 0.5 * d * (a.curvature_per_m + b.curvature_per_m),
                0.01)
        << i;
    EXPECT_GE(b.speed_mps, 0.0);
  }
}

TEST(Planning, SpeedNeverStepsWhateverIsDemanded) {
  PlanningRig rig;
  double last = 0.0, last_accel = 0.0;
  for (int i = 0; i < 1200; ++i) {
    world::RaceControl rc = green((i / 150) % 2 == 0 ? 60.0 : 30.0);
    if ((i / 400) % 2 == 1) rc.track = TrackFlag::kRed;
    const Output out = rig.tick(rc);
    EXPECT_LE(std::abs(out.next.speed_mps - last), rig.params.comfort.decel_max_mps2 * 0.05 + 1e-9)
        << i;
    if (out.next.speed_mps > 0.0) {
      EXPECT_LE(std::abs(out.next.accel_mps2 - last_accel),
                rig.params.comfort.jerk_max_mps3 * 0.05 + 1e-9);
    }
    EXPECT_NEAR(out.drive.points[0].speed_mps, out.next.speed_mps, 1e-9);
    EXPECT_NEAR(out.stop.points[0].speed_mps, out.next.speed_mps, 1e-9);
    last = out.next.speed_mps, last_accel = out.next.accel_mps2;
  }
}

TEST(Planning, TrajectoriesAreDrivableAllRound) {
  PlanningRig rig;
  rig.speed_mps = 60.0;
  for (int i = 0; i < 800; ++i) {
    const Output out = rig.tick(green(60.0));
    if (i % 10 != 0) continue;
    expect_drivable(out.drive);
    expect_drivable(out.stop);
    EXPECT_GT(out.drive.points.back().s_m, 60.0 * 1.5 + 40.0);
    EXPECT_EQ(out.stop.points.back().speed_mps, 0.0);
    EXPECT_NEAR(out.line_offset_m, 0.0, 0.02);
  }
  EXPECT_GT(rig.s_m, rig.line.length_m);
}

// The time between two points is the integral of ds / v, with v squared linear in s: a constant
// acceleration. By the midpoint rule.
double integrated_s(double step_m, double from_mps, double to_mps) {
  constexpr int kSlices = 20'000;
  double time_s = 0.0;
  for (int i = 0; i < kSlices; ++i) {
    const double u = (i + 0.5) / kSlices;
    const double v2 = from_mps * from_mps + u * (to_mps * to_mps - from_mps * from_mps);
    time_s += step_m / kSlices / std::sqrt(v2);
  }
  return time_s;
}

TEST(Planning, TheTimeOfATrajectoryIsTheIntegralOfDistanceOverSpeed) {
  PlanningRig rig;
  rig.speed_mps = 20.0;
  for (int i = 0; i < 60; ++i) (void)rig.tick(green(60.0));
  const Output out = rig.tick(green(60.0));
  for (const world::Trajectory* t : {&out.drive, &out.stop}) {
    EXPECT_EQ(t->points[0].time_s, 0.0);
    for (std::size_t i = 1; i < t->points.size(); ++i) {
      const auto &a = t->points[i - 1], &b = t->points[i];
      if (b.speed_mps == 0.0) break;
      EXPECT_NEAR(b.time_s - a.time_s, integrated_s(b.s_m - a.s_m, a.speed_mps, b.speed_mps), 1e-5)
          << i;
    }
  }
  EXPECT_TRUE(std::isfinite(out.drive.points.back().time_s));
  EXPECT_EQ(out.stop.points.back().time_s, std::numeric_limits<double>::infinity());
  for (std::size_t i = 1; i < out.stop.points.size(); ++i)
    EXPECT_GE(out.stop.points[i].time_s, out.stop.points[i - 1].time_s);
}

// Beside the line, in a merge, and on the way of a stop to the low side of the road.
TEST(Planning, TheRoomOfATrajectoryIsThatOfTheTrackMap) {
  PlanningRig rig;
  rig.offset_m = -5.0, rig.speed_mps = 40.0, rig.s_m = 300.0;
  const Output out = rig.tick(green(40.0));
  double least_m = 100.0, most_m = 0.0;
  for (const world::Trajectory* t : {&out.drive, &out.stop})
    for (const world::TrajectoryPoint& p : t->points) {
      const world::Curvilinear place = rig.track.project(p.x_m, p.y_m);
      const world::TrackPoint road = rig.track.at(place.s_m);
      EXPECT_NEAR(p.room_left_m, road.width_left_m - place.n_m, 1e-3);
      EXPECT_NEAR(p.room_right_m, road.width_right_m + place.n_m, 1e-3);
      least_m = std::min(least_m, p.room_right_m), most_m = std::max(most_m, p.room_right_m);
    }
  EXPECT_LT(least_m, 3.1);
  EXPECT_GT(most_m, 8.0 - 0.1);
}

TEST(Planning, FollowingTheStopBringsTheCarToRest) {
  PlanningRig rig;
  rig.speed_mps = 65.0;
  for (int i = 0; i < 40; ++i) (void)rig.tick(green(65.0));
  const double promised_m = rig.s_m + rig.tick(green(65.0)).stop_distance_m;
  // Race control stays green: the car stops because the supervisor follows the stop.
  for (int i = 0; i < 600 && rig.speed_mps > 0.0; ++i) (void)rig.tick(green(65.0), Followed::kStop);
  EXPECT_EQ(rig.speed_mps, 0.0);
  EXPECT_NEAR(rig.s_m, promised_m, 10.0);
  for (int i = 0; i < 20; ++i) (void)rig.tick(green(65.0), Followed::kStop);
  EXPECT_EQ(rig.speed_mps, 0.0);
  for (int i = 0; i < 600; ++i) (void)rig.tick(green(65.0), Followed::kDrive);
  EXPECT_NEAR(rig.speed_mps, 65.0, 0.1);  // and starts again from standstill
}

// A stop reckons with less friction than the drive, never with more: the lower it is the longer the
// stop, and the drive does not know of it.
TEST(Planning, AStopReckonsWithItsOwnFrictionAtMostWithThatOfTheCar) {
  double last_m = 0.0, beyond_m = 0.0, drive_mps = kUnset;
  for (const double friction : {2.0, 1.3, 1.1, 0.9, 0.7}) {
    PlanningRig rig;
    rig.params.stop_friction = friction;
    rig.params.stop_decel_max_mps2 = 12.0, rig.params.line.friction.brake_max_mps2 = 20.0;
    rig.speed_mps = 55.0, rig.s_m = 900.0;  // in a turn
    const Output out = rig.tick(green(55.0));
    EXPECT_GE(out.stop_distance_m, last_m) << friction;
    if (friction == 2.0) beyond_m = out.stop_distance_m;
    if (friction == 1.3) {
      EXPECT_EQ(out.stop_distance_m, beyond_m) << "that of the car";
    }
    if (std::isnan(drive_mps)) drive_mps = out.drive.points.back().speed_mps;
    EXPECT_EQ(out.drive.points.back().speed_mps, drive_mps) << friction;
    last_m = out.stop_distance_m;
  }
  EXPECT_GT(last_m, 1.1 * beyond_m);
}

TEST(Planning, ReferenceStaysNearACarThatDoesNotFollow) {
  PlanningRig rig;
  for (int i = 0; i < 200; ++i) {
    const Output out = rig.tick(green(60.0));
    rig.speed_mps = 0.0, rig.s_m = 0.0;  // it does not start
    EXPECT_LE(out.next.speed_mps, rig.params.speed_band_mps);
  }
  const Output out = rig.tick(green(60.0));
  EXPECT_GT(out.drive.points[0].speed_mps, 1.0);  // but is told to
}

// For comparison only: what is demanded reaches every point, whatever cold tyres carry.
TEST(Planning, ThePublishedSpeedLawDemandsTheSameEverywhere) {
  PlanningRig rig;
  rig.speed_mps = 40.0, rig.tyre_c = 29.0;
  const auto limited = rig.tick(green(80.0));
  EXPECT_LT(limited.drive.points.back().speed_mps, 80.0);
  rig.params.speed_law = SpeedLaw::kPaper;
  const auto paper = rig.tick(green(80.0), Followed::kDrive, 75.0);
  EXPECT_EQ(paper.target_speed_mps, 75.0);
  EXPECT_EQ(paper.reason, Reason::kOperatorLimit);
  for (const world::TrajectoryPoint& point : paper.drive.points) {
    EXPECT_EQ(point.speed_mps, 75.0);
    EXPECT_EQ(point.accel_mps2, 0.0);
    EXPECT_NEAR(point.time_s, point.s_m / 75.0, 1e-9);
  }
  world::RaceControl red = green(80.0);
  red.track = TrackFlag::kRed;
  const auto stands = rig.tick(red);
  EXPECT_EQ(stands.drive.points.back().speed_mps, 0.0);
  EXPECT_EQ(stands.drive.points[0].time_s, 0.0);
}

TEST(Planning, MergesFromBesideTheLineWithoutAStep) {
  PlanningRig rig;
  rig.offset_m = -5.0, rig.speed_mps = 20.0;
  double last_m = rig.offset_m;
  for (int i = 0; i < 200; ++i) {
    const Output out = rig.tick(green(20.0));
    expect_drivable(out.drive);
    const auto& p = out.drive.points[0];
    const double offset_m = rig.line.project(p.x_m, p.y_m, out.line_s_m).offset_m;
    EXPECT_LE(std::abs(offset_m - last_m), 0.2) << i;
    EXPECT_GE(offset_m, last_m - 1e-6);
    rig.offset_m = last_m = offset_m;  // the car follows
  }
  EXPECT_NEAR(rig.offset_m, 0.0, 1e-3);
}

TEST(Planning, WithoutEgoThereIsNoTrajectory) {
  PlanningRig rig;
  rig.speed_mps = 30.0;
  (void)rig.tick(green(30.0));
  world::EgoState lost = ego_on(rig.line, rig.s_m, 0.0, 30.0), nan = lost;
  lost.validity = world::Validity::kLost;
  nan.vx_mps = kUnset;
  for (const world::EgoState& ego : {lost, nan, world::EgoState{}}) {
    const world::RaceControl rc = green(30.0);
    const Output out =
        step(rig.params, rig.line, rig.track, rig.state,
             {.ego = ego, .race_control = rc, .followed = Followed::kDrive}, rig.now);
    EXPECT_EQ(out.reason, Reason::kNoEgo);
    EXPECT_TRUE(out.drive.points.empty());
    EXPECT_TRUE(out.stop.points.empty());
    EXPECT_FALSE(out.next.started);
  }
}

TEST(Planning, TheLineLimitsTheSpeed) {
  PlanningRig rig;
  rig.params.line.speed_max_mps = 25.0;
  rig.line = prepare(rig.params, rig.track).value();
  Output out;
  for (int i = 0; i < 600; ++i) out = rig.tick(green(60.0));
  EXPECT_NEAR(rig.speed_mps, 25.0, 0.1);
  EXPECT_EQ(out.reason, Reason::kLineLimit);
  EXPECT_NEAR(out.target_speed_mps, 25.0, 1e-9);
}

// Full on a green track; gentle for the operator and behind a flag.
TEST(Planning, RacesOnAGreenTrackAndDrivesGentlyBehindFlags) {
  PlanningRig rig;
  rig.params.racing = {.accel_max_mps2 = 5.0, .decel_max_mps2 = 7.0, .jerk_max_mps3 = 12.0};
  const Pace gentle = rig.params.comfort;
  struct Range {
    double least_mps2 = 0.0, most_mps2 = 0.0;
  };
  const auto driven = [&](const world::RaceControl& rc, double limit_mps = kUnset) {
    (void)rig.tick(rc, Followed::kDrive, limit_mps);
    rig.state.accel_mps2 = 0.0;
    Range range;
    for (int i = 0; i < 100; ++i) {
      const double mps2 = rig.tick(rc, Followed::kDrive, limit_mps).next.accel_mps2;
      range = {std::min(range.least_mps2, mps2), std::max(range.most_mps2, mps2)};
    }
    return range;
  };
  rig.speed_mps = 20.0;
  EXPECT_GT(driven(green(60.0)).most_mps2, 4.5);
  EXPECT_GE(driven(green(60.0), 15.0).least_mps2, -gentle.decel_max_mps2 - 1e-9);
  EXPECT_LE(driven(green(60.0), 50.0).most_mps2, gentle.accel_max_mps2 + 1e-9);
  (void)driven(green(60.0));
  EXPECT_LT(driven(green(20.0)).least_mps2, -5.0);
  (void)driven(green(60.0));
  world::RaceControl yellow = green(60.0);
  yellow.track = TrackFlag::kYellow;
  EXPECT_GE(driven(yellow).least_mps2, -gentle.decel_max_mps2 - 1e-9);
}

// What longitudinal control feeds forward is what the speeds do: the reference changes its
// acceleration every twentieth of a second, by at most the jerk.
TEST(Planning, TheAccelerationOfATrajectoryIsThatOfItsSpeeds) {
  PlanningRig rig;
  rig.speed_mps = 30.0;
  const double off_mps2 = rig.params.comfort.jerk_max_mps3 * 0.05;
  for (const double target_mps : {60.0, 25.0, 40.0})
    for (int k = 0; k < 60; ++k) {
      const Output out = rig.tick(green(target_mps));
      for (std::size_t i = 1; i < out.drive.points.size(); ++i) {
        const auto &a = out.drive.points[i - 1], &b = out.drive.points[i];
        const double mps2 = (b.speed_mps * b.speed_mps - a.speed_mps * a.speed_mps) /
                            (2.0 * rig.params.point_spacing_m);
        ASSERT_NEAR(0.5 * (a.accel_mps2 + b.accel_mps2), mps2, off_mps2) << target_mps << ' ' << i;
      }
    }
}

TEST(Planning, SaysWhetherLineTyresOrACornerAheadHoldTheSpeed) {
  PlanningRig rig;
  rig.tyre_c = 30.0, rig.speed_mps = 40.0;
  std::set<Reason> cold, warm;
  while (rig.s_m < 1.5 * rig.line.length_m) cold.insert(rig.tick(green(80.0)).reason);
  // On the straights cold tyres carry the largest speed of the line, too.
  EXPECT_EQ(cold, (std::set{Reason::kLineLimit, Reason::kTyreLimit, Reason::kCornerAhead}));
  rig.tyre_c = 85.0;
  while (rig.s_m < 3.0 * rig.line.length_m) warm.insert(rig.tick(green(80.0)).reason);
  EXPECT_EQ(warm, std::set{Reason::kLineLimit});
}

TEST(Planning, TakesNothingFromTheHeap) {
  if (!pitwall::testing::kAllocationsCounted) GTEST_SKIP() << "the sanitizer has its own heap";
  PlanningRig rig;
  rig.offset_m = -4.0, rig.speed_mps = 50.0;
  EXPECT_EQ(pitwall::testing::allocations_of([&] {
              for (int i = 0; i < 20; ++i) (void)rig.tick(green(60.0));
            }),
            0u);
}

TEST(Planning, PrepareNamesTheIllegalParameter) {
  const world::TrackMap track = testing::stadium();
  const auto place = [&](auto change) {
    Params p = recommended();
    change(p);
    const auto line = prepare(p, track);
    return line ? std::string("legal") : line.error().place;
  };
  EXPECT_EQ(place([](Params&) {}), "legal");
  EXPECT_EQ(place([](Params& p) { p.comfort.jerk_max_mps3 = 0.0; }), "jerk_max_mps3");
  EXPECT_EQ(place([](Params& p) { p.racing.decel_max_mps2 = 2.9; }), "racing.decel_max_mps2");
  EXPECT_EQ(place([](Params& p) { p.line.friction.friction = kUnset; }), "line.friction.friction");
  EXPECT_EQ(place([](Params& p) { p.line.offset_m = 7.0; }), "line.offset_m");
  EXPECT_EQ(place([](Params& p) { p.line.friction.brake_front = 1.0; }),
            "line.friction.brake_front");
  EXPECT_EQ(place([](Params& p) { p.line.friction.tyres.share[1] = 0.5; }), "line.friction.tyres");
  EXPECT_EQ(place([](Params& p) { p.stop_path.clearance_m = kUnset; }), "stop_path.clearance_m");
  EXPECT_EQ(place([](Params& p) { p.emergency_grip_share = 0.6; }), "emergency_grip_share");
  EXPECT_EQ(place([](Params& p) { p.stop_friction = kUnset; }), "stop_friction");
}

}  // namespace
}  // namespace pitwall::planning
