// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/supervisor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <vector>

#include "protocol/can/av21.hpp"
#include "protocol/can/encode.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/vehicle/safety/drive.hpp"
#include "tests/vehicle/safety/situation.hpp"
#include "vehicle/safety/frame_gate.hpp"

namespace pitwall::safety {
namespace {

namespace av21 = can::av21;
using testing::Drive;
using testing::Situation;
using world::Mode;

TEST(Supervisor, AWholeDay) {
  Drive d;
  EXPECT_EQ(d.tick().mode, Mode::kDisarmed);
  EXPECT_FALSE(d.out.actuate);
  EXPECT_TRUE(std::isnan(d.out.command.brake_kpa));
  d.car.race_control.track = world::TrackFlag::kRed;
  d.car.requests.arm = true;
  d.run(seconds(1));
  EXPECT_EQ(d.out.mode, Mode::kStandby);
  EXPECT_EQ(d.out.source, CommandSource::kHold);
  EXPECT_NEAR(d.out.command.brake_kpa, d.params.safe_stop.hold_kpa, 1e-9);
  EXPECT_EQ(d.out.follow, Follow::kNone);
  d.car.race_control.track = world::TrackFlag::kGreen;
  d.run(seconds(6));
  EXPECT_EQ(d.out.mode, Mode::kDriving);
  EXPECT_EQ(d.out.follow, Follow::kDrive);
  EXPECT_EQ(d.out.source, CommandSource::kControl);
  EXPECT_GT(d.speed_mps, 8.0);
  d.car.requests.stop = true;
  d.tick();
  d.car.requests.stop = false;
  EXPECT_EQ(d.out.mode, Mode::kControlledStop);
  EXPECT_EQ(d.out.cause, Cause::kOperatorStop);
  EXPECT_EQ(d.out.follow, Follow::kStop);
  d.car.control.brake_kpa = 1000.0;
  d.car.control.throttle_fraction = 0.0;
  d.run(seconds(20));
  EXPECT_EQ(d.out.mode, Mode::kHalted);
  EXPECT_TRUE(d.out.standstill);
  EXPECT_EQ(d.out.cause, Cause::kOperatorStop) << "the first cause stays";
  d.car.requests.reset = true;
  EXPECT_EQ(d.tick().mode, Mode::kDisarmed);
  EXPECT_EQ(d.out.cause, Cause::kNone);
  d.run(seconds(2));
  EXPECT_EQ(d.out.mode, Mode::kDisarmed) << "the old arm request does not arm again";
  d.car.requests.arm = false;
  d.tick();
  d.car.requests.arm = true;
  d.run(milliseconds(100));
  EXPECT_EQ(d.out.mode, Mode::kDriving);
}

TEST(Supervisor, EveryCauseStopsWithItsReactionAndIsNamedFirst) {
  const auto down = [](Drive& d, Stream s) { d.car.stream(s).health = Health::kBad; };
  struct Case {
    Cause cause;
    std::function<void(Drive&)> spoil;
  };
  const std::vector<Case> cases{
      {Cause::kPurpleFlag,
       [](Drive& d) { d.car.race_control.vehicle = world::VehicleFlag::kPurpleEmergency; }},
      {Cause::kBusDead, [](Drive& d) { d.kill_bus(); }},
      {Cause::kSteeringCommsLost,
       [](Drive& d) { d.car.signals.diagnostics.value.steer_comms_lost = true; }},
      {Cause::kDisarmRequest, [](Drive& d) { d.car.requests.arm = false; }},
      {Cause::kRaceControlLost, [&](Drive& d) { down(d, Stream::kRaceControl); }},
      {Cause::kGnssUnitDisconnected, [&](Drive& d) { down(d, Stream::kGnss0Link); }},
      {Cause::kRadioLost, [&](Drive& d) { down(d, Stream::kRadio); }},
      {Cause::kPlanLost, [&](Drive& d) { down(d, Stream::kPlanner); }},
      {Cause::kLocalizationLost, [](Drive& d) { d.car.ego.validity = world::Validity::kLost; }},
      {Cause::kControlFailed, [](Drive& d) { d.car.control_ok = false; }},
      {Cause::kControlFailed, [](Drive& d) { d.car.control.road_wheel_rad = kUnset; }},
      {Cause::kControlFailed, [](Drive& d) { d.car.control.brake_kpa = -1.0; }},
      {Cause::kCommandRefused, [](Drive& d) { d.car.gate_refused = true; }},
      {Cause::kBusOff, [](Drive& d) { d.car.bus_failed = true; }},
      {Cause::kOwnIdOnBus, [](Drive& d) { d.car.own_id_seen = true; }}};
  for (const Case& c : cases) {
    Drive d;
    d.race();
    c.spoil(d);
    d.run(milliseconds(40));
    const bool emergency = row_of(c.cause).reaction == Reaction::kEmergencyStop;
    EXPECT_EQ(d.out.mode, emergency ? Mode::kEmergencyStop : Mode::kControlledStop)
        << text_of(c.cause);
    EXPECT_EQ(d.out.cause, c.cause) << text_of(c.cause);
    EXPECT_EQ(d.state.log.first.cause, c.cause);
    d.car.control.throttle_fraction = 0.0;
    d.car.control.brake_kpa = 800.0;
    d.run(seconds(19));
    EXPECT_EQ(d.out.mode, Mode::kHalted) << text_of(c.cause) << ": a fault that stays still halts";
    EXPECT_EQ(d.out.cause, c.cause) << text_of(c.cause);
  }
}

TEST(Supervisor, APurpleFlagThatStaysBarsTheReset) {
  Drive d;
  d.race();
  d.car.race_control.vehicle = world::VehicleFlag::kPurpleEmergency;
  d.run(seconds(30));
  ASSERT_EQ(d.out.mode, Mode::kHalted);
  d.car.requests.reset = true;
  d.run(milliseconds(50));
  EXPECT_EQ(d.out.mode, Mode::kHalted);
  d.car.race_control.vehicle = world::VehicleFlag::kNone;
  d.run(milliseconds(50));
  EXPECT_EQ(d.out.mode, Mode::kHalted) << "the edge has passed";
  d.car.requests.reset = false;
  d.tick();
  d.car.requests.reset = true;
  EXPECT_EQ(d.tick().mode, Mode::kDisarmed);
}

TEST(Supervisor, FaultsBarArmingOrDrivingAndLatchNothingBefore) {
  Drive d;
  d.car.stream(Stream::kGnss0Link).health = Health::kNever;
  d.car.requests.arm = true;
  d.run(seconds(1));
  EXPECT_EQ(d.out.mode, Mode::kStandby) << "in the garage without satellites";
  EXPECT_EQ(d.out.cause, Cause::kNone);
  EXPECT_TRUE(d.out.causes.has(Cause::kGnssUnitDisconnected));
  d.car.stream(Stream::kGnss0Link).health = Health::kGood;
  d.run(milliseconds(50));
  EXPECT_EQ(d.out.mode, Mode::kDriving);
  Drive without_bus;
  without_bus.car.stream(Stream::kSteering).health = Health::kNever;
  without_bus.car.requests.arm = true;
  without_bus.run(seconds(1));
  EXPECT_EQ(without_bus.out.mode, Mode::kDisarmed);
  without_bus.car.stream(Stream::kSteering).health = Health::kGood;
  without_bus.run(milliseconds(50));
  EXPECT_EQ(without_bus.out.mode, Mode::kDriving) << "the request waited";
}

TEST(Supervisor, GoNeedsFlagsThatLetRollAndTheDriveByWireReady) {
  using world::TrackFlag;
  using world::VehicleFlag;
  const std::set<TrackFlag> tracks{TrackFlag::kYellow, TrackFlag::kGreen, TrackFlag::kWavingGreen};
  const std::set<VehicleFlag> vehicles{VehicleFlag::kNone, VehicleFlag::kBlue, VehicleFlag::kYellow,
                                       VehicleFlag::kDefender, VehicleFlag::kAttacker};
  for (int t = 0; t <= static_cast<int>(TrackFlag::kUnknown); ++t) {
    for (int v = 0; v <= static_cast<int>(VehicleFlag::kUnknown); ++v) {
      for (const int sys : {8, 9}) {
        Drive d;
        d.car.race_control.track = static_cast<TrackFlag>(t);
        d.car.race_control.vehicle = static_cast<VehicleFlag>(v);
        d.car.signals.misc.value.sys_state = static_cast<world::SysState>(sys);
        d.car.requests.arm = true;
        d.run(milliseconds(100));
        const bool rolls = tracks.contains(static_cast<TrackFlag>(t)) &&
                           vehicles.contains(static_cast<VehicleFlag>(v)) && sys == 9;
        EXPECT_EQ(d.out.mode == Mode::kDriving, rolls) << t << ' ' << v << ' ' << sys;
      }
    }
  }
  Drive unplanned;
  unplanned.car.drive_available = false;
  unplanned.car.requests.arm = true;
  unplanned.run(seconds(1));
  EXPECT_EQ(unplanned.out.mode, Mode::kStandby);
  Drive unreceived;
  unreceived.car.signals.misc.received = false;
  unreceived.car.requests.arm = true;
  unreceived.run(seconds(1));
  EXPECT_EQ(unreceived.out.mode, Mode::kStandby);
  unreceived.params.go_needs_driving_state = false;
  unreceived.run(seconds(1));
  EXPECT_EQ(unreceived.out.mode, Mode::kDriving);
  Drive alone;  // a test day without race control
  alone.params.faults.race_control_required = false;
  alone.car.race_control = {};
  alone.car.requests.arm = true;
  alone.run(seconds(1));
  EXPECT_EQ(alone.out.mode, Mode::kDriving);
}

TEST(Supervisor, LockedWheelsAreNoStandstill) {
  Drive d;
  d.race();
  d.car.requests.stop = true;
  for (int i = 0; i < 200; ++i) {
    d.now += milliseconds(10);
    d.car.at(d.now, 0.0);
    d.car.ego.vx_mps = 30.0;
    const SupervisorOutput out =
        supervise(d.params, d.state,
                  {d.car.signals, d.car.bus, d.car.race_control, d.car.ego, d.car.watchdog,
                   d.car.stop, d.car.control, true, true, false, false, false, d.car.requests},
                  d.now);
    ASSERT_EQ(out.mode, Mode::kControlledStop);
  }
}

// Whatever control says, or whether it says anything, the same stop is driven.
TEST(Supervisor, EveryStopIsTheSafeStopsFromItsFirstTickAndControlIsNotAsked) {
  for (const bool emergency : {false, true}) {
    Random random{emergency ? 8U : 7U};
    Drive d;
    d.race();
    d.car.requests.stop = true;
    d.car.requests.emergency_stop = emergency;
    Drive other = d;
    d.tick(), other.tick();
    const Mode stops = emergency ? Mode::kEmergencyStop : Mode::kControlledStop;
    ASSERT_EQ(d.out.mode, stops);
    while (d.out.mode == stops) {
      ASSERT_EQ(d.out.source, CommandSource::kSafeStop);
      ASSERT_EQ(d.out.command.road_wheel_rad, other.out.command.road_wheel_rad);
      ASSERT_EQ(d.out.command.throttle_fraction, other.out.command.throttle_fraction);
      ASSERT_EQ(d.out.command.brake_kpa, other.out.command.brake_kpa);
      ASSERT_LT(d.now.ns, seconds(60).ns);
      other.car.control_ok = !random.one_in(3);
      other.car.control.road_wheel_rad = random.one_in(9) ? kUnset : random.between(-0.1, 0.1);
      other.car.control.throttle_fraction = random.between(0.0, 1.0);
      other.car.control.brake_kpa = random.between(0.0, 5500.0);
      d.tick(), other.tick();
    }
    EXPECT_EQ(d.out.mode, Mode::kHalted);
    EXPECT_EQ(other.out.mode, Mode::kHalted);
  }
}

TEST(Supervisor, StopsEvenWhenNothingMeasuresTheSpeed) {
  Drive d;
  d.race();
  d.wheels_known = false;
  d.car.ego.validity = world::Validity::kLost;
  d.car.control_ok = false;
  d.run(seconds(60));
  EXPECT_EQ(d.out.mode, Mode::kHalted);
  EXPECT_LT(d.speed_mps, 1e-9);
}

TEST(Supervisor, AnEmergencyBrakesHarderThanControlWishesAndItsSteeringDoesNotStep) {
  Drive d;
  d.params.safe_stop.friction = 1.3;
  d.race();
  d.car.race_control.vehicle = world::VehicleFlag::kPurpleEmergency;
  d.car.signals.tyre_temperature_c = {{{85.0, 85.0, 85.0, 85.0}}, Instant{} + seconds(3600), true};
  d.car.control.road_wheel_rad = 0.1;
  d.car.control.brake_kpa = 0.0;
  const double before_rad = d.out.command.road_wheel_rad;
  double most_kpa = 0.0;
  d.tick();
  EXPECT_EQ(d.out.command.road_wheel_rad, before_rad);
  while (d.speed_mps > 2.0) {
    d.tick();
    ASSERT_EQ(d.out.mode, Mode::kEmergencyStop);
    ASSERT_EQ(d.out.command.throttle_fraction, 0.0);
    ASSERT_EQ(d.out.source, CommandSource::kSafeStop);
    most_kpa = std::max(most_kpa, d.out.command.brake_kpa);
  }
  EXPECT_GT(most_kpa, 1800.0);
}

TEST(Supervisor, AnEmergencyWithoutControlWheelsOrAccelerationsStillStops) {
  for (const bool control : {true, false}) {
    Drive d;
    d.race();
    d.car.requests.emergency_stop = true;
    d.tick();
    d.car.requests.emergency_stop = false;
    d.wheels_known = false;
    d.car.control_ok = control;
    d.car.control.throttle_fraction = 0.0;
    d.car.ego.validity = world::Validity::kDeadReckoning;
    d.car.ego.ay_mps2 = kUnset;
    d.run(milliseconds(300));
    EXPECT_EQ(d.out.source, CommandSource::kSafeStop);
    d.run(seconds(20));
    EXPECT_EQ(d.out.mode, Mode::kHalted) << "standing by the ego state alone";
    EXPECT_EQ(d.speed_mps, 0.0);
    EXPECT_EQ(d.out.cause, Cause::kOperatorEmergency);
  }
}

TEST(Supervisor, AnEgoStateWithoutSpeedGivesNoNonsenseInAnEmergency) {
  Drive d;
  d.race();
  d.car.requests.emergency_stop = true;
  d.wheels_known = false;
  for (int i = 0; i < 100; ++i) {
    d.now += milliseconds(10);
    d.car.at(d.now, kUnset);
    d.car.signals.wheel_speed_mps.received = false;
    const SupervisorOutput out =
        supervise(d.params, d.state,
                  {d.car.signals, d.car.bus, d.car.race_control, d.car.ego, d.car.watchdog,
                   d.car.stop, d.car.control, true, true, false, false, false, d.car.requests},
                  d.now);
    ASSERT_EQ(out.mode, Mode::kEmergencyStop);
    ASSERT_TRUE(out.command.brake_kpa >= 0.0 && std::isfinite(out.command.road_wheel_rad));
  }
}

TEST(Supervisor, ALaterEmergencyHardensTheStopAndTheFirstCauseStays) {
  Drive d;
  d.race();
  d.car.requests.stop = true;
  d.run(milliseconds(50));
  ASSERT_EQ(d.out.mode, Mode::kControlledStop);
  d.car.signals.diagnostics.value.system_failure = true;
  d.tick();
  EXPECT_EQ(d.out.mode, Mode::kEmergencyStop);
  EXPECT_EQ(d.out.cause, Cause::kOperatorStop);
  EXPECT_EQ(d.state.log.entry(d.state.log.size() - 1).cause, Cause::kSystemFailure);
}

TEST(Supervisor, AnEmergencyInStandbyHaltsAndIsNamed) {
  Drive d;
  d.car.race_control.track = world::TrackFlag::kRed;
  d.car.signals.steering_motor_rad.received = d.car.signals.powertrain.received = false;
  d.car.requests.arm = true;
  d.run(milliseconds(50));
  ASSERT_EQ(d.out.mode, Mode::kStandby);
  EXPECT_EQ(d.out.command.road_wheel_rad, 0.0);
  EXPECT_EQ(d.out.command.gear, 0);
  d.car.requests.emergency_stop = true;
  d.run(seconds(1));
  EXPECT_EQ(d.out.mode, Mode::kHalted);
  EXPECT_EQ(d.out.cause, Cause::kOperatorEmergency);
}

TEST(Supervisor, ACommandThatIsNoNumberOrOutsideItsRangeIsAFailureOfControl) {
  const auto stopped_by = [](double steer, double pedal, double kpa) {
    Drive d;
    d.race();
    d.car.control.road_wheel_rad = steer;
    d.car.control.throttle_fraction = pedal;
    d.car.control.brake_kpa = kpa;
    d.run(milliseconds(40));
    return d.out.cause;
  };
  EXPECT_EQ(stopped_by(0.0, 0.0, 0.0), Cause::kNone);
  EXPECT_EQ(stopped_by(0.0, 1.0, 0.0), Cause::kNone);
  for (const double bad : {kUnset, HUGE_VAL, -HUGE_VAL}) {
    EXPECT_EQ(stopped_by(bad, 0.0, 0.0), Cause::kControlFailed);
    EXPECT_EQ(stopped_by(0.0, bad, 0.0), Cause::kControlFailed);
    EXPECT_EQ(stopped_by(0.0, 0.0, bad), Cause::kControlFailed);
  }
  EXPECT_EQ(stopped_by(0.0, 1.01, 0.0), Cause::kControlFailed);
  EXPECT_EQ(stopped_by(0.0, -0.01, 0.0), Cause::kControlFailed);
}

// The command as outbound encodes it.
std::vector<can::Frame> spoken(const world::ActuatorCommand& c, double ratio, int counter) {
  can::EncodeCounters counters;
  std::vector<can::Frame> frames(4);
  av21::BrakePressureCmd b;
  b.brake_pressure_cmd = c.brake_kpa;
  b.brk_pressure_cmd_counter = counter & 0xFF;
  av21::AcceleratorCmd t;
  t.acc_pedal_cmd = 100.0 * c.throttle_fraction;
  t.acc_pedal_cmd_counter = counter & 0xFF;
  av21::SteeringCmd s;
  s.steering_motor_ang_cmd = to_deg(c.road_wheel_rad) * ratio;
  s.steering_motor_cmd_counter = counter & 0xFF;
  av21::GearShiftCmd g;
  g.desired_gear = c.gear;
  EXPECT_TRUE(av21::encode(b, frames[0], counters));
  EXPECT_TRUE(av21::encode(t, frames[1], counters));
  EXPECT_TRUE(av21::encode(s, frames[2], counters));
  EXPECT_TRUE(av21::encode(g, frames[3], counters));
  EXPECT_EQ(counters.saturated, 0u);
  return frames;
}

void spoil(Random& random, Situation& car) {
  car.requests.emergency_stop = random.one_in(3000);
  car.requests.stop = random.one_in(1500);
  if (random.one_in(600)) car.requests.arm = !car.requests.arm;
  if (random.one_in(100)) car.requests.reset = !car.requests.reset;
  car.control_ok = !random.one_in(60);
  car.own_id_seen = random.one_in(4000);
  if (random.one_in(300)) car.race_control.track = static_cast<world::TrackFlag>(random.below(8));
  if (random.one_in(3)) car.race_control.track = world::TrackFlag::kGreen;
  const std::uint64_t sick = random.below(4000);
  for (std::size_t i = 0; i < kStreams; ++i)
    car.watchdog.rows[i].health = sick == i ? Health::kBad : Health::kGood;
  if (random.one_in(200)) car.watchdog.rows[20].health = Health::kWarning;  // the planner
  car.ego.validity = random.one_in(3000) ? world::Validity::kLost : world::Validity::kGood;
  car.control.road_wheel_rad = random.between(-0.012, 0.012);  // jumps, as no control would
  car.control.throttle_fraction = random.one_in(2) ? random.between(0.0, 1.0) : 0.0;
  car.control.brake_kpa = random.one_in(4) ? random.between(0.0, 4000.0) : 0.0;
  car.control.gear = static_cast<std::uint8_t>(1 + random.below(6));
  if (random.one_in(2000)) car.control.road_wheel_rad = kUnset;
}

TEST(Supervisor, RandomDaysNeverDriveAfterAFaultWithoutAResetAndAlwaysPassTheGate) {
  Random random{20260704};
  Drive d;
  GateParams gate_params;
  GateState gate_state;
  d.car.requests.arm = true;
  bool faulted = false;
  std::set<Mode> seen;
  world::ActuatorCommand last;
  Mode before = Mode::kDisarmed;
  int halts = 0, sent = 0;
  for (int i = 0; i < 300'000; ++i) {
    spoil(random, d.car);
    const bool reset_was = d.state.reset_was;
    const SupervisorOutput& out = d.tick();
    const world::ActuatorCommand& c = out.command;
    seen.insert(out.mode);
    if (follows_the_drive(before) && !out.causes.at_least(Reaction::kControlledStop).empty())
      faulted = true;
    if (before == Mode::kHalted && out.mode != Mode::kHalted) {
      ASSERT_TRUE(d.car.requests.reset && !reset_was);
      ASSERT_EQ(out.mode, Mode::kDisarmed);
      faulted = false;
    }
    halts += before != Mode::kHalted && out.mode == Mode::kHalted;
    ASSERT_FALSE(faulted && follows_the_drive(out.mode)) << i;
    ASSERT_EQ(out.actuate, out.mode != Mode::kDisarmed);
    ASSERT_EQ(out.follow == Follow::kDrive, follows_the_drive(out.mode));
    if (out.mode == Mode::kCoast) {
      ASSERT_EQ(c.throttle_fraction, 0.0);
    }
    if (stops(out.mode)) {
      ASSERT_NE(out.cause, Cause::kNone);
    }
    if (out.actuate) {
      ASSERT_TRUE(std::isfinite(c.road_wheel_rad));
      ASSERT_TRUE(c.brake_kpa >= 0.0 && c.throttle_fraction >= 0.0);
      ASSERT_FALSE(c.brake_kpa > 100.0 && c.throttle_fraction > 0.02);
      if (out.mode != Mode::kDriving && before != Mode::kDisarmed) {
        ASSERT_LE(c.throttle_fraction, last.throttle_fraction);
      }
      const GateContext context{out.mode, out.actuate, out.speed_mps, c.at, d.now};
      const GateOutput passed =
          gate(gate_params, gate_state, context, spoken(c, d.params.steering_ratio, sent++));
      ASSERT_FALSE(passed.refused_now) << i << ": " << text_of(passed.first_refusal) << " in mode "
                                       << static_cast<int>(out.mode);
    } else {
      gate(gate_params, gate_state, {.mode = out.mode, .now = d.now}, {});
    }
    last = c;
    before = out.mode;
  }
  EXPECT_EQ(seen.size(), world::kModes);
  EXPECT_GT(halts, 20);
}

TEST(Supervisor, TheStateIsAValueAndTakesNothingFromTheHeap) {
  Drive d;
  d.race();
  Drive copy = d;
  d.car.requests.stop = copy.car.requests.stop = true;
  const auto frames = spoken(d.out.command, d.params.steering_ratio, 1);
  const GateParams gate_params;
  GateState gate_state;
  const std::size_t taken = ::pitwall::testing::allocations_of([&] {
    d.run(seconds(1));
    gate(gate_params, gate_state, {Mode::kDriving, true, 20.0, d.now, d.now}, frames);
  });
  if (::pitwall::testing::kAllocationsCounted) {
    EXPECT_EQ(taken, 0u);
  }
  copy.run(seconds(1));
  EXPECT_EQ(d.out.mode, copy.out.mode);
  EXPECT_EQ(d.speed_mps, copy.speed_mps);
  EXPECT_EQ(d.out.command.brake_kpa, copy.out.command.brake_kpa);
}

}  // namespace
}  // namespace pitwall::safety
