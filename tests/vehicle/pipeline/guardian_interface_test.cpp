// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/guardian_interface.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "tests/vehicle/pipeline/standing_car.hpp"

namespace pitwall::pipeline::testing {
namespace {

using guardian::Mode;
using guardian::Status;

TEST(GuardianInterface, TheGuardianHasTheCarsOwnParameters) {
  const CarParams& car = av21_file().params;
  const guardian::Params p = guardian_params(car);
  EXPECT_EQ(p.reckoning.steering_ratio, car.outbound.steering_ratio);
  EXPECT_EQ(p.reckoning.bicycle.wheelbase_m, car.localization.bicycle.wheelbase_m);
  EXPECT_EQ(p.reckoning.units[1].y_m, car.localization.units[1].antenna.y_m);
  EXPECT_EQ(p.reckoning.units[1].baseline_yaw_rad, car.localization.units[1].baseline_yaw_rad);
  EXPECT_EQ(p.following.stop.brake_max_kpa, car.supervisor.safe_stop.brake_max_kpa);
  EXPECT_EQ(p.following.slew_rad_per_s, car.supervisor.steer_slew_rad_per_s);
  EXPECT_EQ(p.gate.brake_max_kpa, car.gate.brake_max_kpa);
}

struct Teller {
  std::unique_ptr<Car> car = std::make_unique<Car>();
  Outputs out;
  GuardianRecord reported;
  Instant now = kStart;

  // A car on the reference line, with the plan that planning makes there.
  void plan(double s_m) {
    const world::TrackPoint p = setup().track.at(s_m);
    out.ego = {.at = now,
               .validity = world::Validity::kGood,
               .x_m = p.x_m,
               .y_m = p.y_m,
               .yaw_rad = p.yaw_rad,
               .vx_mps = 50.0,
               .vy_mps = 0.0,
               .yaw_rate_rad_per_s = 0.0};
    const world::RaceControl silent;
    car->plan.output = planning::step(
        setup().params.planning, setup().line, setup().track, {},
        {.ego = out.ego, .race_control = silent, .followed = planning::Followed::kDrive}, now);
    car->plan.at = now;
    car->plan.ever = true;
  }
  void tick(bool reset = false) {
    now += kTick;
    publish(setup(), *car, out, {.id = 9, .reset = reset}, now, reported);
  }
};

TEST(GuardianInterface, PublishesTheStopThatPlanningKeepsReady) {
  Teller t;
  t.now += kTick;
  t.plan(300.0);
  t.out.chosen.mode = world::Mode::kDriving;
  t.out.chosen.actuate = true;
  t.tick();
  EXPECT_EQ(t.reported.verdict, guardian::StopVerdict::kGood);
  EXPECT_EQ(t.reported.record.stop.points.size(), world::kTrajectoryPoints);
  EXPECT_EQ(t.reported.record.stop.points.back().speed_mps, 0.0) << "it reaches standstill";
  EXPECT_TRUE(t.reported.record.armed);
  EXPECT_TRUE(t.reported.record.sends);
  EXPECT_EQ(t.reported.record.run, 9u);
  EXPECT_EQ(t.reported.record.sequence, 1u);
  EXPECT_EQ(t.reported.record.at, t.now);
  EXPECT_EQ(t.reported.record.datum.latitude_deg, setup().track.datum_latitude_deg());
}

TEST(GuardianInterface, AStopThatFailsItsCheckIsNotPublishedAndTheOneBeforeStays) {
  Teller t;
  t.now += kTick;
  t.plan(300.0);
  t.tick();
  const double first_x_m = t.reported.record.stop.points[0].x_m;
  t.plan(320.0);
  t.car->plan.output.stop.points[40].x_m = kUnset;
  t.tick();
  EXPECT_EQ(t.reported.verdict, guardian::StopVerdict::kNotFinite);
  EXPECT_EQ(t.reported.refused, 1u);
  EXPECT_EQ(t.reported.record.stop.points[0].x_m, first_x_m);
  t.tick();
  EXPECT_EQ(t.reported.refused, 1u) << "one plan is judged once";
}

TEST(GuardianInterface, AQuietCarReportsThatItDoesNotSend) {
  Teller t;
  t.out.quiet = true;
  t.tick(true);
  EXPECT_FALSE(t.reported.record.sends);
  EXPECT_TRUE(t.reported.record.reset);
}

TEST(GuardianInterface, ADeadGuardianDoesNotDriveButWhatItDidCounts) {
  Status status;
  status.run = 9;
  status.mode = Mode::kDriving;
  status.at = kStart;
  status.latched = true;
  for (const int age_ms : {0, 50, 51, 1000}) {
    const GuardianView view = view_of(status, 9, kStart + milliseconds(age_ms));
    EXPECT_EQ(view.drives, age_ms <= 50) << age_ms;
    EXPECT_TRUE(view.stopped) << "until a reset";
  }
  EXPECT_FALSE(view_of(status, 10, kStart).stopped) << "that was another run";
  EXPECT_TRUE(view_of(status, 10, kStart).drives) << "but it drives, whosever run it was";
  for (const Mode mode : {Mode::kIdle, Mode::kWatching, Mode::kHandedBack, Mode::kNothingToDrive}) {
    status.mode = mode;
    EXPECT_FALSE(view_of(status, 9, kStart).drives);
  }
}

TEST(GuardianInterface, ARunEndedArmedUnlessItSaysOtherwise) {
  guardian::CarRecord record;
  EXPECT_FALSE(ended_armed(record)) << "there was none";
  record.run = 1;
  EXPECT_FALSE(ended_armed(record));
  record.armed = true;
  EXPECT_TRUE(ended_armed(record));
  record.finished = true;
  EXPECT_FALSE(ended_armed(record));
  record.barred = true;
  EXPECT_TRUE(ended_armed(record)) << "nobody has looked since";
}

TEST(GuardianInterface, OnlyACarThatStandsIsLeftInOrder) {
  for (const auto mode :
       {world::Mode::kDisarmed, world::Mode::kStandby, world::Mode::kDriving,
        world::Mode::kControlledStop, world::Mode::kEmergencyStop, world::Mode::kHalted}) {
    GuardianRecord reported;
    reported.record.run = 1;
    reported.record.armed = true;
    reported.record.mode = mode;
    finish(reported);
    const bool moves = mode == world::Mode::kDriving || safety::stops(mode);
    EXPECT_EQ(ended_armed(reported.record), moves) << static_cast<int>(mode);
  }
}

// While the guardian drives the car sends nothing, and its command follows the guardian's.
TEST(GuardianInterface, AStepIsQuietWhileTheGuardianDrives) {
  const auto car = std::make_unique<Car>();
  car->supervisor.mode = world::Mode::kDriving;
  GuardianView view;
  view.drives = true;
  view.command = {.road_wheel_rad = 0.02, .throttle_fraction = 0.0, .brake_kpa = 700.0, .gear = 4};
  view.counters = {.brake = 255, .throttle = 3, .steering = 4, .report = 9};
  const world::SensorInput none;
  const Outputs out = step(
      setup(), *car,
      {.now = kStart, .dt = kTick, .can = {}, .sensors = none, .requests = {}, .guardian = view});
  EXPECT_TRUE(out.quiet);
  EXPECT_TRUE(out.passed.frames.empty());
  EXPECT_EQ(car->outbound.brake_counter, 0) << "the next one";
  EXPECT_EQ(car->outbound.report_counter, 0);
  view.drives = false;
  const Outputs after = step(setup(), *car,
                             {.now = kStart + kTick,
                              .dt = kTick,
                              .can = {},
                              .sensors = none,
                              .requests = {},
                              .guardian = view});
  EXPECT_FALSE(after.quiet);
  EXPECT_FALSE(after.passed.frames.empty());
}

// The guardian's frames bear the car's ids.
TEST(GuardianInterface, FramesOfTheGuardianAreNoForeignNode) {
  for (const bool drove : {true, false}) {
    const auto car = std::make_unique<Car>();
    can::ReceivedFrame frame;
    frame.frame.id = av21::BrakePressureCmd::kId;
    frame.frame.length = av21::BrakePressureCmd::kLength;
    frame.at = kStart - milliseconds(5);
    GuardianView view;
    view.drove_from = kStart - milliseconds(200);
    view.drove_until = drove ? kStart - milliseconds(10) : view.drove_from;
    const world::SensorInput none;
    const Outputs out = step(setup(), *car,
                             {.now = kStart,
                              .dt = kTick,
                              .can = std::span(&frame, 1),
                              .sensors = none,
                              .requests = {},
                              .guardian = view});
    EXPECT_EQ(out.received.own_frames, 1u);
    EXPECT_EQ(out.received.own_id_seen, !drove);
  }
}

}  // namespace
}  // namespace pitwall::pipeline::testing
