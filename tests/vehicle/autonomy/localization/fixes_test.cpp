// SPDX-License-Identifier: Apache-2.0
// What becomes of the samples of the receivers, one by one.
#include <gtest/gtest.h>

#include <memory>

#include "tests/vehicle/autonomy/localization/drive.hpp"

namespace pitwall::localization {
namespace {

using testing::banked_turn;
using testing::Course;
using testing::Rig;
using world::Monitor;

// A filter that runs, and one sample more.
struct Running {
  std::unique_ptr<Rig> rig = std::make_unique<Rig>();

  explicit Running(const Course& course = Course{}) {
    rig->course = course;
    rig->run(5.0);
  }
  Verdict of(const world::SensorInput& in) const {
    auto copy = std::make_unique<Rig>(*rig);
    copy->signals = {};
    const Output& out = copy->take(in);
    EXPECT_EQ(out.verdicts.size(), 1u);
    return out.verdicts.empty() ? Verdict{} : out.verdicts[0];
  }
  template <class Spoil>
  Gate position(Spoil spoil) const {
    world::SensorInput in;
    world::GnssPosition p = rig->position(0, rig->ms - 20);
    spoil(p);
    EXPECT_TRUE(in.positions.push(p));
    return of(in).gate;
  }
  template <class Spoil>
  Gate velocity(Spoil spoil) const {
    world::SensorInput in;
    world::GnssVelocity v = rig->velocity(1, rig->ms - 20);
    spoil(v);
    EXPECT_TRUE(in.velocities.push(v));
    return of(in).gate;
  }
  template <class Spoil>
  Gate heading(Spoil spoil) const {
    world::SensorInput in;
    world::GnssHeading h = rig->heading(0, rig->ms - 20);
    spoil(h);
    EXPECT_TRUE(in.headings.push(h));
    return of(in).gate;
  }
};

TEST(Fixes, EveryRefusalOfAPositionHasItsReason) {
  const Running running;
  using P = world::GnssPosition;
  const Instant used = running.rig->state.streams[0][0].stamps.newest;
  EXPECT_EQ(running.position([](P&) {}), Gate::kAccepted);
  EXPECT_EQ(running.position([](P& p) { p.unit = 2; }), Gate::kUnknownUnit);
  EXPECT_EQ(running.position([](P& p) { p.at = p.at + seconds(1); }), Gate::kFromTheFuture);
  EXPECT_EQ(running.position([](P& p) { p.at = p.at - seconds(1); }), Gate::kTooOld);
  EXPECT_EQ(running.position([](P& p) { p.at = p.at - milliseconds(170); }), Gate::kRanBack);
  EXPECT_EQ(running.position([&](P& p) { p.at = used; }), Gate::kRepeated);
  EXPECT_EQ(running.position([](P& p) { p.solution_status = 1; }), Gate::kNotSolved);
  EXPECT_EQ(running.position([](P& p) { p.position_type = world::kPositionNone; }),
            Gate::kNotSolved);
  EXPECT_EQ(running.position([](P& p) { p.latitude_deg = kUnset; }), Gate::kNotFinite);
  EXPECT_EQ(running.position([](P& p) { p.latitude_deg = 200.0; }), Gate::kImplausible);
  EXPECT_EQ(running.position([](P& p) { p.longitude_sigma_m = kUnset; }), Gate::kNotFinite);
  EXPECT_EQ(running.position([](P& p) { p.height_sigma_m = -0.01; }), Gate::kNegativeVariance);
  EXPECT_EQ(running.position([](P& p) { p.latitude_sigma_m = 3.0; }), Gate::kTooUncertain);
  EXPECT_EQ(running.position([](P& p) { p.differential_age_s = 60.0; }), Gate::kOldCorrections);
  EXPECT_EQ(running.position([](P& p) { p.latitude_deg += 1e-4; }), Gate::kOutlier);
}

TEST(Fixes, EveryRefusalOfAVelocityHasItsReason) {
  const Running running;
  using V = world::GnssVelocity;
  EXPECT_EQ(running.velocity([](V&) {}), Gate::kAccepted);
  EXPECT_EQ(running.velocity([](V& v) { v.horizontal_mps = -1.0; }), Gate::kImplausible);
  EXPECT_EQ(running.velocity([](V& v) { v.horizontal_mps = 1e300; }), Gate::kImplausible);
  EXPECT_EQ(running.velocity([](V& v) { v.track_over_ground_rad = 1e300; }), Gate::kImplausible);
  EXPECT_EQ(running.velocity([](V& v) { v.vertical_mps = kUnset; }), Gate::kNotFinite);
  EXPECT_EQ(running.velocity([](V& v) { v.horizontal_mps += 2.0; }), Gate::kOutlier);
}

TEST(Fixes, AHeadingThatFlipsIsRefusedAndSeenByBothMonitors) {
  const Running running(banked_turn());
  using H = world::GnssHeading;
  EXPECT_EQ(running.heading([](H&) {}), Gate::kAccepted);
  EXPECT_EQ(running.heading([](H& h) { h.heading_rad += std::numbers::pi; }), Gate::kOutlier);
  EXPECT_EQ(running.heading([](H& h) { h.baseline_m += 0.3; }), Gate::kWrongBaseline);
  Rig& rig = *running.rig;
  rig.sensors.turned_rad[0] = std::numbers::pi;
  for (int i = 0; i < 120 && rig.state.streams[2][0].verdict == Gate::kAccepted; ++i) rig.tick();
  EXPECT_EQ(rig.state.streams[2][0].verdict, Gate::kOutlier);
  EXPECT_TRUE(rig.out.seen.has(Monitor::kInnovation));
  EXPECT_TRUE(rig.out.seen.has(Monitor::kUnitAgreement));
}

TEST(Fixes, AFrozenPositionWithLiveStampsIsRefusedWhileTheCarMoves) {
  Running running;
  Rig& rig = *running.rig;
  world::GnssPosition last = rig.position(0, rig.ms - 30);
  for (int i = 0; i < 20; ++i) {
    rig.ms += 10;
    world::SensorInput in = rig.arrivals();
    for (auto& p : in.positions) {
      if (p.unit != 0) continue;
      const Instant at = p.at;
      p = last;
      p.at = at;
    }
    rig.take(in);
  }
  EXPECT_GE(rig.count(Source::kPosition, 0, Gate::kFrozen), 3u);
  EXPECT_TRUE(rig.out.seen.has(Monitor::kStamp));
  EXPECT_LT(rig.position_error_m(), 0.05);
}

// F22: stamps stand still over live contents.
TEST(Fixes, AStampThatStandsStillIsSeenWithTheNextSample) {
  Running running;
  Rig& rig = *running.rig;
  const Instant stuck = rig.state.streams[0][1].stamps.newest;
  for (int i = 0; i < 10; ++i) {
    rig.ms += 10;
    rig.turn_wheels();
    world::SensorInput in = rig.arrivals();
    for (auto& p : in.positions)
      if (p.unit == 1) p.at = stuck;
    rig.take(in);
  }
  EXPECT_TRUE(rig.out.seen.has(Monitor::kStamp));
  EXPECT_LT(rig.position_error_m(), 0.05);
}

TEST(Fixes, AWorseKindOfPositionStandsByWhileTheOtherUnitIsFixed) {
  Running running;
  using P = world::GnssPosition;
  EXPECT_EQ(running.position([](P& p) { p.position_type = world::kPositionNarrowFloat; }),
            Gate::kStandby);
}

TEST(Fixes, APreferredUnitIsTheOnlyOneThatEnters) {
  auto rig = std::make_unique<Rig>();
  rig->params.priorities.position = Preference::kUnit1;
  rig->run(5.0);
  EXPECT_EQ(rig->state.streams[0][0].verdict, Gate::kStandby);
  EXPECT_EQ(rig->state.streams[0][1].verdict, Gate::kAccepted);
  rig->sensors.no_position[1] = true;
  rig->run(1.0);
  EXPECT_EQ(rig->state.streams[0][0].verdict, Gate::kAccepted);
  EXPECT_LT(rig->position_error_m(), 0.05);
}

TEST(Fixes, AReceiversOwnAttitudeStandsByUntilNoHeadingComes) {
  Running running(banked_turn());
  Rig& rig = *running.rig;
  const auto attitude = [&] {
    const world::EgoState truth = rig.truth();
    world::InsAttitude a;
    a.unit = 0;
    a.at = rig.now();
    a.status = world::InsStatus::kGood;
    a.roll_rad = truth.roll_rad, a.pitch_rad = truth.pitch_rad;
    a.heading_rad = 0.5 * std::numbers::pi - truth.yaw_rad;
    a.roll_sigma_rad = a.pitch_sigma_rad = a.heading_sigma_rad = 0.002;
    return a;
  };
  const auto go_on = [&](int ticks) {
    for (int i = 0; i < ticks; ++i) {
      rig.ms += 10;
      rig.turn_wheels();
      world::SensorInput in = rig.arrivals();
      ASSERT_TRUE(in.attitudes.push(attitude()));
      rig.take(in);
    }
  };
  go_on(20);
  EXPECT_EQ(rig.state.streams[5][0].verdict, Gate::kStandby);
  rig.sensors.no_heading = {true, true};
  go_on(600);
  EXPECT_EQ(rig.state.streams[5][0].verdict, Gate::kAccepted);
}

}  // namespace
}  // namespace pitwall::localization
