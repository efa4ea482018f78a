// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/fault_detection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "tests/vehicle/safety/situation.hpp"

namespace pitwall::safety {
namespace {

using testing::Situation;
using world::SysState;
using world::Validity;
using world::VehicleFlag;

struct Doctor {
  FaultParams params;
  FaultState state;
  Situation car;
  world::ComputerHealth computer;
  Instant now = Instant{} + seconds(10);

  Doctor() { car.requests.arm = true; }
  FaultOutput examine(bool driving = true) {
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
                   .driving = driving,
                   .computer = computer},
                  now);
  }
  // Every message of the drive-by-wire is so old, and by its own limits only late.
  void silence(Duration age) {
    for (std::size_t s = kWheels; s <= kDiagnostics; ++s)
      car.watchdog.rows[s] = {static_cast<Stream>(s), Health::kWarning, age};
  }
  static constexpr auto kWheels = static_cast<std::size_t>(Stream::kWheelSpeed);
  static constexpr auto kDiagnostics = static_cast<std::size_t>(Stream::kDiagnostics);
};

void down(Doctor& d, Stream a) { d.car.stream(a).health = Health::kBad; }

struct FaultCase {
  Cause cause;
  std::function<void(Doctor&)> spoil;
  int ticks = 1;
  Cause before = Cause::kNone;  // in the ticks before
};

const std::vector<FaultCase> kFaultCases{
    {Cause::kOperatorEmergency, [](Doctor& d) { d.car.requests.emergency_stop = true; }},
    {Cause::kPurpleFlag,
     [](Doctor& d) { d.car.race_control.vehicle = VehicleFlag::kPurpleEmergency; }},
    {Cause::kBusDead, [](Doctor& d) { d.silence(milliseconds(71)); }},
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
    {Cause::kCommandRefused, [](Doctor& d) { d.car.gate_refused = true; }, 3},
    {Cause::kControlFailed, [](Doctor& d) { d.car.control_ok = false; }, 3, Cause::kControlLate},
    {Cause::kControlLate, [](Doctor& d) { d.car.control_ok = false; }},
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
    {Cause::kGnssRtkLost,
     [](Doctor& d) {
       d.car.watchdog.sigma_m = {0.51, 0.51};
     }},
    {Cause::kGnssDegraded,
     [](Doctor& d) {
       d.car.watchdog.sigma_m = {0.01, 0.51};
     }},
    {Cause::kGnssDegraded, [](Doctor& d) { down(d, Stream::kGnss0Position); }},
    {Cause::kGnssDegraded, [](Doctor& d) { down(d, Stream::kGnss1Solution); }},
    {Cause::kPlanLate, [](Doctor& d) { d.car.stream(Stream::kPlanner).health = Health::kWarning; }},
    {Cause::kFlagsDisagree,
     [](Doctor& d) { d.car.race_control.track = world::TrackFlag::kUnknown; }},
    {Cause::kFlagsDisagree, [](Doctor& d) { d.car.race_control.vehicle = VehicleFlag::kUnknown; }},
    {Cause::kFlagsDisagree, [](Doctor& d) { d.car.race_control.conflict = true; }},
    {Cause::kRoundSpeedTooHigh, [](Doctor& d) { d.car.race_control.refused_speed_mps = 71.5; }},
    {Cause::kTicksMissed, [](Doctor& d) { d.now += milliseconds(26); }},
    {Cause::kProcessorBusy, [](Doctor& d) { d.computer.processor_share = 0.98; }},
    {Cause::kComputerMemory, [](Doctor& d) { d.computer.memory_mib = 30'001.0; }},
    {Cause::kComputerHot, [](Doctor& d) { d.computer.temperature_c = 95.1; }},
};

// What needs more than a tick: its own tests.
constexpr std::array kElsewhere{Cause::kDeadReckoningTooLong,
                                Cause::kPositionPassing,
                                Cause::kSteeringDeviates,
                                Cause::kBrakeDeviates,
                                Cause::kThrottleDeviates,
                                Cause::kComputerLate,
                                Cause::kSteeringBiased,
                                Cause::kRearSpin,
                                Cause::kRearLock,
                                Cause::kYawExcess,
                                Cause::kFrontLock,
                                Cause::kClockStepped,
                                Cause::kClockSkewed};

TEST(FaultDetection, AHealthyCarHasNoCause) {
  Doctor d;
  EXPECT_EQ(d.examine().causes.bits(), 0u);
}

TEST(FaultDetection, EachFaultIsItsOwnCauseAndNoOtherAndGoesWithIt) {
  std::vector<bool> covered(kCauses, false);
  for (const FaultCase& c : kFaultCases) {
    Doctor d;
    const Situation healthy = d.car;
    EXPECT_TRUE(d.examine().causes.empty());
    c.spoil(d);
    for (int tick = 1; tick <= c.ticks; ++tick) {
      const FaultOutput found = d.examine();
      CauseSet expected;
      expected.add(tick == c.ticks ? c.cause : c.before);
      EXPECT_EQ(found.causes.bits(), expected.bits()) << text_of(c.cause) << " tick " << tick;
    }
    d.car = healthy;
    d.computer = {};
    EXPECT_TRUE(d.examine().causes.empty()) << text_of(c.cause);
    covered[static_cast<std::size_t>(c.cause)] = true;
  }
  for (std::size_t i = 1; i < kCauses; ++i) {
    if (std::ranges::find(kElsewhere, static_cast<Cause>(i)) != kElsewhere.end()) continue;
    EXPECT_TRUE(covered[i]) << text_of(static_cast<Cause>(i));
  }
}

TEST(FaultDetection, OneHealthyUnitDrivesOn) {
  for (const Stream one : {Stream::kGnss0Position, Stream::kGnss1Position, Stream::kGnss0Solution,
                           Stream::kGnss1Solution, Stream::kImu0, Stream::kImu1,
                           Stream::kGnss0Velocity, Stream::kGnss1Heading}) {
    Doctor d;
    down(d, one);
    EXPECT_TRUE(d.examine().causes.at_least(Reaction::kCoast).empty()) << static_cast<int>(one);
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
  EXPECT_TRUE(d.examine().causes.at_least(Reaction::kCoast).empty());
  d.car.stream(Stream::kGnss1Position).health = Health::kUnwatched;
  d.car.stream(Stream::kGnss0Position).health = Health::kUnwatched;
  EXPECT_TRUE(d.examine().causes.empty()) << "a car without satellites";
}

TEST(FaultDetection, AWarningIsNoFaultButOfThePlanner) {
  Doctor d;
  for (StreamRow& row : d.car.watchdog.rows) row.health = Health::kWarning;
  CauseSet expected;
  expected.add(Cause::kPlanLate);
  EXPECT_EQ(d.examine().causes, expected);
}

// The monitor behind each, where a single tick shows it: it reports, and with its bit off neither
// it nor the cause is there.
TEST(FaultDetection, AMonitorReportsWhatItFindsAndFindsNothingWhenItIsOff) {
  using world::Monitor;
  const std::vector<std::pair<Cause, Monitor>> monitors{
      {Cause::kBusDead, Monitor::kMessageAge},
      {Cause::kBusMessageLost, Monitor::kMessageAge},
      {Cause::kControlFailed, Monitor::kModule},
      {Cause::kControlLate, Monitor::kModule},
      {Cause::kPlanLost, Monitor::kModule},
      {Cause::kPlanLate, Monitor::kModule},
      {Cause::kGnssUnitDisconnected, Monitor::kStreamAge},
      {Cause::kGnssRateLost, Monitor::kStreamAge},
      {Cause::kImuLost, Monitor::kStreamAge},
      {Cause::kGnssDegraded, Monitor::kStreamAge},
      {Cause::kGnssSolutionLost, Monitor::kSolution},
      {Cause::kGnssRtkLost, Monitor::kSolution},
      {Cause::kRaceControlLost, Monitor::kRaceControl},
      {Cause::kRaceControlReportedLost, Monitor::kRaceControl},
      {Cause::kRadioLost, Monitor::kRadioLink},
      {Cause::kFlagsDisagree, Monitor::kFlagAgreement},
      {Cause::kRoundSpeedTooHigh, Monitor::kFlagAgreement},
      {Cause::kTicksMissed, Monitor::kTiming},
      {Cause::kProcessorBusy, Monitor::kTiming},
      {Cause::kComputerMemory, Monitor::kTiming},
      {Cause::kComputerHot, Monitor::kTiming}};
  for (const auto& [cause, monitor] : monitors)
    for (const FaultCase& c : kFaultCases) {
      if (c.cause != cause) continue;
      for (const bool off : {false, true}) {
        Doctor d;
        if (off) d.params.off.add(monitor);
        d.examine();
        c.spoil(d);
        FaultOutput found;
        for (int tick = 0; tick < c.ticks; ++tick) found = d.examine();
        EXPECT_EQ(found.causes.has(cause), !off) << text_of(cause);
        EXPECT_EQ(found.seen.has(monitor), !off) << text_of(cause);
      }
    }
}

TEST(FaultDetection, AFadingRadioAndALateHeartbeatAreSeenBeforeTheyStop) {
  using world::Monitor;
  for (const auto& [stream, monitor] : {std::pair{Stream::kRadio, Monitor::kRadioLink},
                                        {Stream::kRaceControl, Monitor::kRaceControl}}) {
    Doctor d;
    EXPECT_TRUE(d.examine().seen.empty());
    d.car.stream(stream).health = Health::kWarning;
    EXPECT_TRUE(d.examine().seen.has(monitor));
    EXPECT_TRUE(d.examine().causes.empty());
    d.params.off.add(monitor);
    EXPECT_TRUE(d.examine().seen.empty());
  }
}

TEST(FaultDetection, DeadReckoningIsAllowedForItsTimeOnly) {
  Doctor d;
  d.examine();
  d.car.ego.validity = Validity::kDeadReckoning;
  const Instant good = d.now;
  for (std::int64_t ms = 10; ms <= 3000; ms += 10) {
    d.now = good + milliseconds(ms);
    const CauseSet causes = d.examine().causes;
    EXPECT_EQ(causes.has(Cause::kDeadReckoningTooLong), ms > 1500) << ms;
    EXPECT_EQ(causes.has(Cause::kPositionPassing), ms > 300) << ms;
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

TEST(FaultDetection, OneMessageOfTheDriveByWireKeepsTheBusAlive) {
  for (std::size_t one = Doctor::kWheels; one <= Doctor::kDiagnostics; ++one) {
    Doctor d;
    d.silence(seconds(5));
    EXPECT_TRUE(d.examine().causes.has(Cause::kBusDead));
    d.car.watchdog.rows[one].age = milliseconds(70);
    EXPECT_FALSE(d.examine().causes.has(Cause::kBusDead)) << one;
  }
}

TEST(FaultDetection, WhatIsNotWatchedOrWasNeverHeardKeepsNoBusAlive) {
  for (const Health silent : {Health::kUnwatched, Health::kNever}) {
    Doctor d;
    d.silence(milliseconds(71));
    d.car.stream(Stream::kMisc) = {Stream::kMisc, silent, {}};
    EXPECT_TRUE(d.examine().causes.has(Cause::kBusDead));
  }
}

TEST(FaultDetection, NobodyObeysAfterTheTimeOfAStopAndOnlyWhileTheBusIsDead) {
  Doctor d;
  const Instant died = d.now;
  for (std::int64_t ms = 10; ms <= 25'000; ms += 10) {
    d.now = died + milliseconds(ms);
    d.silence(milliseconds(ms));
    const FaultOutput found = d.examine();
    EXPECT_EQ(found.causes.has(Cause::kBusDead), ms > 70) << ms;
    EXPECT_EQ(found.drive_by_wire_gone, ms >= 80 + 20'000) << ms;
  }
  d.silence({});
  EXPECT_FALSE(d.examine().drive_by_wire_gone);
  d.silence(milliseconds(71));
  EXPECT_FALSE(d.examine().drive_by_wire_gone) << "it begins anew";
}

// Frames as the drive-by-wire sends them, each up to 5 ms late and up to 5 in a row lost: the
// watchdog and the limit together never call the bus dead, and always when it is.
TEST(FaultDetection, NominalJitterAndShortLossesAreNoDeadBus) {
  Random random{11};
  Doctor d;
  const WatchdogParams params;
  WatchdogState state;
  world::SensorInput sensors;
  std::array<int, 4> lost{};
  const auto look = [&] {
    d.car.watchdog =
        watch(params, state, {sensors, d.car.signals, d.car.race_control, {}, {}, {}}, d.now);
    return d.examine().causes.has(Cause::kBusDead);
  };
  for (int tick = 0; tick < 200'000; ++tick) {
    d.now += milliseconds(10);
    const Instant sent = d.now - microseconds(static_cast<std::int64_t>(random.below(5'000)));
    const auto came = [&](std::size_t i) {
      if (lost[i] == 0 && random.one_in(50)) lost[i] = 1 + static_cast<int>(random.below(5));
      return lost[i] == 0 || --lost[i] < 0;
    };
    if (came(0)) d.car.signals.wheel_speed_mps = {{}, sent, true};
    if (came(1)) d.car.signals.brake = {{}, sent, true};
    if (came(2)) d.car.signals.throttle_fraction = {{}, sent, true};
    if (came(3)) d.car.signals.steering_motor_rad = {{}, sent, true};
    ASSERT_FALSE(look()) << tick;
  }
  const Instant last = d.now;
  while (!look()) d.now += milliseconds(10);
  EXPECT_LE(d.now - last, milliseconds(80)) << "so that telemetry at 50 Hz says it within 100 ms";
}

TEST(FaultDetection, DriveByWireThatWasNeverHeardSaysNothing) {
  Doctor d;
  d.car.signals.diagnostics.value.system_failure = true;
  d.car.signals.diagnostics.received = false;
  d.car.signals.misc.value.sys_state = SysState::kEmergencyShutdown;
  d.car.signals.misc.received = false;
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
