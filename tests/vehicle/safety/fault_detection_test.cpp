// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/fault_detection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "tests/vehicle/safety/situation.hpp"

namespace pitwall::safety {
namespace {

using testing::Random;
using testing::Situation;
using world::SysState;
using world::Validity;
using world::VehicleFlag;

struct Doctor {
  FaultParams params;
  FaultState state;
  Situation car;
  Instant now = Instant{} + seconds(10);

  Doctor() { car.requests.arm = true; }
  FaultOutput examine(bool driving = true) {
    car.bus.last_frame = std::max(car.bus.last_frame, now - bus_quiet);
    return detect(params, state,
                  {.signals = car.signals,
                   .bus = car.bus,
                   .race_control = car.race_control,
                   .ego = car.ego,
                   .watchdog = car.watchdog,
                   .operator_requests = car.requests,
                   .own_id_seen = car.own_id_seen,
                   .bus_failed = car.bus_failed,
                   .control_ok = car.control_ok,
                   .gate_refused = car.gate_refused,
                   .driving = driving},
                  now);
  }
  Duration bus_quiet{};
};

void down(Doctor& d, Stream a) { d.car.stream(a).health = Health::kBad; }

struct Case {
  Cause cause;
  std::function<void(Doctor&)> spoil;
  int ticks = 1;
};

const std::vector<Case> kCases{
    {Cause::kOperatorEmergency, [](Doctor& d) { d.car.requests.emergency_stop = true; }},
    {Cause::kPurpleFlag,
     [](Doctor& d) { d.car.race_control.vehicle = VehicleFlag::kPurpleEmergency; }},
    {Cause::kSystemFailure,
     [](Doctor& d) { d.car.signals.diagnostics.value.system_failure = true; }},
    {Cause::kEmergencyBrake,
     [](Doctor& d) { d.car.signals.diagnostics.value.emergency_brake = true; }},
    {Cause::kSteeringCommsLost,
     [](Doctor& d) { d.car.signals.diagnostics.value.steer_comms_lost = true; }},
    {Cause::kSysEmergencyShutdown,
     [](Doctor& d) { d.car.signals.misc.value.sys_state = SysState::kEmergencyShutdown; }},
    {Cause::kOperatorStop, [](Doctor& d) { d.car.requests.stop = true; }},
    {Cause::kDisarmRequest, [](Doctor& d) { d.car.requests.arm = false; }},
    {Cause::kEngineKillFlag,
     [](Doctor& d) { d.car.race_control.vehicle = VehicleFlag::kEngineKill; }},
    {Cause::kMotecCommsLost,
     [](Doctor& d) { d.car.signals.diagnostics.value.motec_comms_lost = true; }},
    {Cause::kBrakeOutOfSpec,
     [](Doctor& d) { d.car.signals.diagnostics.value.rear_brake_out_of_spec = true; }},
    {Cause::kBrakeOutOfSpec,
     [](Doctor& d) { d.car.signals.diagnostics.value.front_brake_out_of_spec = true; }},
    {Cause::kCriticalLimits,
     [](Doctor& d) { d.car.signals.misc.value.sys_state = SysState::kCriticalLimitsExceeded; }},
    {Cause::kComputerHeartbeatLost,
     [](Doctor& d) { d.car.signals.diagnostics.value.computer_heartbeat_lost = true; }},
    {Cause::kWrongBus,
     [](Doctor& d) { d.car.bus.identity.verdict = world::IdentityVerdict::kWrong; }},
    {Cause::kWrongBus,
     [](Doctor& d) { d.car.bus.identity.verdict = world::IdentityVerdict::kListening; }},
    {Cause::kBusOff, [](Doctor& d) { d.car.bus_failed = true; }},
    {Cause::kOwnIdOnBus, [](Doctor& d) { d.car.own_id_seen = true; }},
    {Cause::kBusMessageLost, [](Doctor& d) { down(d, Stream::kWheelSpeed); }},
    {Cause::kBusMessageLost, [](Doctor& d) { down(d, Stream::kDiagnostics); }},
    {Cause::kBusMessageLost,
     [](Doctor& d) { d.car.stream(Stream::kSteering).health = Health::kNever; }},
    {Cause::kBusMessageLost, [](Doctor& d) { d.bus_quiet = milliseconds(101); }},
    {Cause::kCommandRefused, [](Doctor& d) { d.car.gate_refused = true; }, 3},
    {Cause::kControlFailed, [](Doctor& d) { d.car.control_ok = false; }, 3},
    {Cause::kPlanLost, [](Doctor& d) { down(d, Stream::kPlanner); }},
    {Cause::kLocalizationLost, [](Doctor& d) { d.car.ego.validity = Validity::kLost; }},
    {Cause::kLocalizationLost, [](Doctor& d) { d.car.ego.validity = Validity::kNever; }},
    {Cause::kLocalizationUncertain, [](Doctor& d) { d.car.ego.position_sigma_m = 1.01; }},
    {Cause::kLocalizationUncertain, [](Doctor& d) { d.car.ego.position_sigma_m = kUnset; }},
    {Cause::kGnssUnitDisconnected, [](Doctor& d) { down(d, Stream::kGnss1Link); }},
    {Cause::kGnssRateLost,
     [](Doctor& d) { down(d, Stream::kGnss0Position), down(d, Stream::kGnss1Position); }},
    {Cause::kGnssSolutionLost,
     [](Doctor& d) { down(d, Stream::kGnss0Solution), down(d, Stream::kGnss1Solution); }},
    {Cause::kImuLost, [](Doctor& d) { down(d, Stream::kImu0), down(d, Stream::kImu1); }},
    {Cause::kRaceControlLost, [](Doctor& d) { down(d, Stream::kRaceControl); }},
    {Cause::kRaceControlReportedLost,
     [](Doctor& d) { d.car.signals.diagnostics.value.race_control_lost = true; }},
    {Cause::kRadioLost, [](Doctor& d) { down(d, Stream::kRadio); }},
};

TEST(FaultDetection, AHealthyCarHasNoCause) {
  Doctor d;
  EXPECT_EQ(d.examine().causes.bits(), 0u);
}

TEST(FaultDetection, EachFaultIsItsOwnCauseAndNoOtherAndGoesWithIt) {
  std::vector<bool> covered(kCauses, false);
  for (const Case& c : kCases) {
    Doctor d;
    const Situation healthy = d.car;
    c.spoil(d);
    for (int tick = 1; tick <= c.ticks; ++tick) {
      const FaultOutput found = d.examine();
      CauseSet expected;
      if (tick == c.ticks) expected.add(c.cause);
      EXPECT_EQ(found.causes.bits(), expected.bits()) << text_of(c.cause) << " tick " << tick;
    }
    d.car = healthy;
    d.bus_quiet = {};
    EXPECT_TRUE(d.examine().causes.empty()) << text_of(c.cause);
    covered[static_cast<std::size_t>(c.cause)] = true;
  }
  for (std::size_t i = 1; i < kCauses; ++i) {
    if (static_cast<Cause>(i) == Cause::kDeadReckoningTooLong) continue;  // has its own test
    EXPECT_TRUE(covered[i]) << text_of(static_cast<Cause>(i));
  }
}

TEST(FaultDetection, OneHealthyUnitDrivesOn) {
  for (const Stream one : {Stream::kGnss0Position, Stream::kGnss1Position, Stream::kGnss0Solution,
                           Stream::kGnss1Solution, Stream::kImu0, Stream::kImu1,
                           Stream::kGnss0Velocity, Stream::kGnss1Heading}) {
    Doctor d;
    down(d, one);
    EXPECT_TRUE(d.examine().causes.empty()) << static_cast<int>(one);
  }
}

TEST(FaultDetection, AnUnwatchedUnitHasNoSay) {
  Doctor d;
  for (const Stream s : {Stream::kGnss1Link, Stream::kGnss1Position, Stream::kGnss1Solution})
    d.car.stream(s).health = Health::kUnwatched;
  EXPECT_TRUE(d.examine().causes.empty());
  down(d, Stream::kGnss0Position);
  EXPECT_TRUE(d.examine().causes.has(Cause::kGnssRateLost)) << "the only unit there is";
  std::swap(d.car.stream(Stream::kGnss0Position).health,
            d.car.stream(Stream::kGnss1Position).health);
  EXPECT_TRUE(d.examine().causes.has(Cause::kGnssRateLost)) << "whichever it is";
  d.car.stream(Stream::kGnss1Position).health = Health::kGood;
  EXPECT_TRUE(d.examine().causes.empty());
  d.car.stream(Stream::kGnss1Position).health = Health::kUnwatched;
  d.car.stream(Stream::kGnss0Position).health = Health::kUnwatched;
  EXPECT_TRUE(d.examine().causes.empty()) << "a car without satellites";
}

TEST(FaultDetection, AWarningIsNoFault) {
  Doctor d;
  for (StreamRow& row : d.car.watchdog.rows) row.health = Health::kWarning;
  EXPECT_TRUE(d.examine().causes.empty());
}

TEST(FaultDetection, DeadReckoningIsAllowedForItsTimeOnly) {
  Doctor d;
  d.examine();
  d.car.ego.validity = Validity::kDeadReckoning;
  const Instant good = d.now;
  for (std::int64_t ms = 10; ms <= 3000; ms += 10) {
    d.now = good + milliseconds(ms);
    EXPECT_EQ(d.examine().causes.has(Cause::kDeadReckoningTooLong), ms > 1500) << ms;
  }
  d.car.ego.validity = Validity::kGood;
  EXPECT_TRUE(d.examine().causes.empty());
  Doctor never;
  never.car.ego.validity = Validity::kDeadReckoning;
  EXPECT_TRUE(never.examine().causes.has(Cause::kDeadReckoningTooLong)) << "from nowhere";
}

TEST(FaultDetection, FailuresMustFollowEachOtherToCount) {
  Random random{8};
  Doctor d;
  int failed = 0, refused = 0;
  for (int i = 0; i < 5000; ++i) {
    d.car.control_ok = !random.one_in(2);
    d.car.gate_refused = random.one_in(2);
    const bool driving = !random.one_in(10);
    failed = driving && !d.car.control_ok ? failed + 1 : 0;
    refused = d.car.gate_refused ? refused + 1 : 0;
    const CauseSet causes = d.examine(driving).causes;
    ASSERT_EQ(causes.has(Cause::kControlFailed), failed >= 3);
    ASSERT_EQ(causes.has(Cause::kCommandRefused), refused >= 3);
  }
}

TEST(FaultDetection, LossesThatAreAllowedByTheParametersAreNoCause) {
  Doctor d;
  d.params.radio_loss_stops = false;
  d.params.race_control_required = false;
  down(d, Stream::kRadio);
  down(d, Stream::kRaceControl);
  EXPECT_TRUE(d.examine().causes.empty());
}

TEST(FaultDetection, DriveByWireThatWasNeverHeardSaysNothing) {
  Doctor d;
  d.car.signals.diagnostics.value.system_failure = true;
  d.car.signals.diagnostics.heard = false;
  d.car.signals.misc.value.sys_state = SysState::kEmergencyShutdown;
  d.car.signals.misc.heard = false;
  EXPECT_TRUE(d.examine().causes.empty()) << "its stream is down: that is the cause";
}

TEST(WheelSpeed, OneWheelHasNoSay) {
  Random random{21};
  world::VehicleSignals s;
  EXPECT_TRUE(std::isnan(wheel_speed_mps(s, Instant{}, seconds(1))));
  for (int i = 0; i < 1000; ++i) {
    const double v = random.between(1.0, 80.0);
    std::array<double, 4> wheels{v, v, v, v};
    wheels[random.below(4)] = random.between(0.0, 120.0);
    s.wheel_speed_mps = {{wheels}, Instant{}, true};
    EXPECT_DOUBLE_EQ(wheel_speed_mps(s, Instant{}, seconds(1)), v);
  }
  EXPECT_TRUE(std::isnan(wheel_speed_mps(s, Instant{} + milliseconds(1001), seconds(1))));
  s.wheel_speed_mps.value.at[2] = kUnset;
  EXPECT_TRUE(std::isnan(wheel_speed_mps(s, Instant{}, seconds(1))));
}

}  // namespace
}  // namespace pitwall::safety
