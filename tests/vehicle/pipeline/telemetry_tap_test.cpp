// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/telemetry_tap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "hil/scenario/scenario.hpp"
#include "protocol/telemetry/registry/labels.hpp"
#include "tests/vehicle/pipeline/standing_car.hpp"
#include "vehicle/safety/fault_log.hpp"

namespace pitwall::pipeline {
namespace {

using telemetry::field;
using telemetry::Group;
using testing::setup;

constexpr Instant kNow{100'000'000'000};

Instant ago_ms(std::int64_t ms) { return kNow - milliseconds(ms); }

template <class T>
void hear(world::Heard<T>& heard, const T& value, std::int64_t age_ms) {
  heard = {.value = value, .at = ago_ms(age_ms), .heard = true};
}

void hear_car(world::VehicleSignals& s) {
  hear(s.wheel_speed_mps, world::PerWheel{{61, 62, 63, 64}}, 11);
  hear(s.brake, world::BrakePressure{.front_kpa = 2100, .rear_kpa = 2000}, 12);
  hear(s.throttle_fraction, 0.25, 13);
  hear(s.steering_motor_rad, 0.39, 14);
  hear(s.misc,
       world::Misc{.battery_v = 13.6,
                   .sys_state = world::SysState::kDriving,
                   .mode_switch = 0,
                   .safety_switch = 0},
       15);
  world::Powertrain p;
  p.gear = 4;
  p.engine_speed_rpm = 6100;
  p.engine_running = true;
  hear(s.powertrain, p, 16);
  hear(s.engine,
       world::EngineHealth{.fuel_pressure_kpa = 350, .oil_pressure_kpa = 480, .coolant_c = 91}, 17);
  world::DriveByWireDiagnostics d;
  d.system_warning = true;
  d.race_control_lost = true;
  hear(s.diagnostics, d, 18);
  hear(s.tyre_temperature_c, world::PerWheel{{71, 72, 73, 74}}, 19);
  hear(s.tyre_pressure_kpa, world::PerWheel{{151, 152, 153, 154}}, 20);
}

// Every number is another one, so that two fields that were exchanged show.
Outputs full() {
  Outputs out;
  hear_car(out.heard.signals);
  out.heard.race_control.ever_heard = true;
  out.heard.race_control.track = world::TrackFlag::kYellow;
  out.heard.race_control.vehicle = world::VehicleFlag::kBlue;
  out.heard.race_control.round_target_speed_mps = 53.6;
  out.heard.race_control.last_heartbeat_change = ago_ms(700);
  out.heard.race_control.lap_count = 9;
  out.heard.bus.frames_applied = 1001;
  out.heard.bus.refused.stuck_counter = 30;
  out.heard.bus.refused.unknown_id = 7;
  out.heard.bus.frames_lost = 12;
  out.heard.bus.identity = {.verdict = world::IdentityVerdict::kWrong,
                            .difference = world::IdentityDifference::kWrongLength,
                            .id = 1312,
                            .database = 0x12345678'9ABCDEF0};
  out.heard.bus.link.controller = world::ControllerState::kPassive;
  out.heard.bus.link.lost_in_socket = 4;
  out.heard.bus.link.lost_in_interface = 5;
  out.ego = {.at = ago_ms(21),
             .validity = world::Validity::kDeadReckoning,
             .x_m = -310.5,
             .y_m = 220.25,
             .yaw_rad = 1.5,
             .vx_mps = 60.5,
             .vy_mps = -0.75,
             .yaw_rate_rad_per_s = 0.375,
             .ax_mps2 = 1,
             .ay_mps2 = 2,
             .position_sigma_m = 0.125,
             .yaw_sigma_rad = 3};
  out.place = {.s_m = 1500.5, .n_m = -1.25};
  out.steered.target_speed_mps = 64.5;
  out.chosen.mode = world::Mode::kControlledStop;
  out.chosen.cause = safety::Cause::kImuLost;
  out.chosen.actuate = true;
  out.chosen.arming = safety::Arming::kSpent;
  out.chosen.command = {
      .at = kNow, .road_wheel_rad = 0.0625, .throttle_fraction = 0.5, .brake_kpa = 1800, .gear = 5};
  out.ct_state = world::CtState::kCoordinatedStop;
  out.passed.refused_total = 77;
  out.watchdog.rows[static_cast<std::size_t>(safety::Stream::kRadio)] = {
      safety::Stream::kRadio, safety::Health::kWarning, milliseconds(1'250)};
  return out;
}

constexpr RimCounters kRim{.frames_sent = 2002,
                           .tx_drops = 3,
                           .steps = 4004,
                           .missed_deadlines = 5,
                           .step_time_max_us = 66,
                           .heartbeats = 88,
                           .heartbeats_refused = 9,
                           .base_runs = 2,
                           .round_trip_ms = 12.5};

std::string name_of(std::size_t i) {
  const auto& row = telemetry::kFields[i];
  return std::string(telemetry::row_of(row.group).name) + "." +
         std::string(row.name);
}

struct Row {
  telemetry::FieldIndex field;
  double value;
};

const std::vector<Row> kExpected{
    {field("mode.mode"), 3},
    {field("mode.ct_state"), 10},
    {field("mode.sys_state"), 9},
    {field("mode.first_stop_cause"), 28},
    {field("flags.track"), 3},
    {field("flags.vehicle"), 2},
    {field("flags.round_target_speed"), 53.6},
    {field("flags.heartbeat_age"), 0.7},
    {field("ego.x"), -310.5},
    {field("ego.y"), 220.25},
    {field("ego.yaw"), 1.5},
    {field("ego.vx"), 60.5},
    {field("ego.vy"), -0.75},
    {field("ego.yaw_rate"), 0.375},
    {field("ego.position_sigma"), 0.125},
    {field("ego.validity"), 2},
    {field("track.station"), 1500.5},
    {field("track.offset"), -1.25},
    {field("track.lap"), 9},
    {field("track.target_speed"), 64.5},
    {field("command.steering"), 0.0625},
    {field("command.throttle"), 0.5},
    {field("command.brake"), 1800},
    {field("command.gear"), 5},
    {field("feedback.steering"), 0.39 / 19.5},  // at the road wheel, as the command is
    {field("feedback.throttle"), 0.25},
    {field("feedback.brake_front"), 2100},
    {field("feedback.brake_rear"), 2000},
    {field("feedback.gear"), 4},
    {field("wheels.front_left"), 61},
    {field("wheels.front_right"), 62},
    {field("wheels.rear_left"), 63},
    {field("wheels.rear_right"), 64},
    {field("tyres.temperature_front_left"), 71},
    {field("tyres.temperature_front_right"), 72},
    {field("tyres.temperature_rear_left"), 73},
    {field("tyres.temperature_rear_right"), 74},
    {field("tyres.pressure_front_left"), 151},
    {field("tyres.pressure_front_right"), 152},
    {field("tyres.pressure_rear_left"), 153},
    {field("tyres.pressure_rear_right"), 154},
    {field("engine.speed"), 6100},
    {field("engine.running"), 1},
    {field("engine.fuel_pressure"), 350},
    {field("engine.oil_pressure"), 480},
    {field("engine.coolant"), 91},
    {field("electric.battery"), 13.6},
    {field("electric.diagnostics"), 1 + 32768},  // first and last bit
    {field("bus.frames_applied"), 1001},
    {field("bus.frames_refused"), 37},
    {field("bus.frames_sent"), 2002},
    {field("bus.tx_drops"), 3},
    {field("bus.gate_refusals"), 77},
    {field("bus.frames_lost"), 12},
    {field("bus.queue_losses"), 9},  // of socket and interface
    {field("bus.controller"), 3},
    {field("bus.identity"), 2},
    {field("bus.differing_id"), 1312},
    {field("bus.database"), 0x12345678},
    {field("computer.step_time_max"), 66},
    {field("computer.steps"), 4004},
    {field("computer.missed_deadlines"), 5},
    {field("mode.arming"), 5},
    {field("radio.base"), 3},
    {field("radio.silence"), 1.25},
    {field("radio.round_trip"), 12.5},
    {field("radio.heartbeats"), 88},
    {field("radio.heartbeats_refused"), 9},
    {field("radio.base_runs"), 2},
};

TEST(TelemetryTap, EachFieldSaysWhatTheTickSays) {
  const auto packet = tap(setup(), full(), kRim, kNow);
  std::set<telemetry::FieldIndex> said;
  for (const Row& row : kExpected) {
    EXPECT_NEAR(packet.values[row.field], row.value, 1e-9) << name_of(row.field);
    said.insert(row.field);
  }
  // The rest nobody in the car knows yet.
  for (std::size_t i = 0; i < telemetry::kFieldCount; ++i) {
    if (said.contains(i)) continue;
    EXPECT_EQ(name_of(i), "track.last_lap_time");
    EXPECT_TRUE(std::isnan(packet.values[i])) << name_of(i);
  }
}

TEST(TelemetryTap, EveryValueFitsTheRangeOfItsField) {
  const auto packet = tap(setup(), full(), kRim, kNow);
  for (std::size_t i = 0; i < telemetry::kFieldCount; ++i) {
    const double value = packet.values[i];
    if (std::isnan(value)) continue;
    EXPECT_GE(value, telemetry::kFields[i].min) << name_of(i);
    EXPECT_LE(value, telemetry::kFields[i].max) << name_of(i);
  }
  telemetry::PacketBuffer buffer;
  telemetry::EncodeCounters counters;
  (void)telemetry::encode(packet, buffer, counters);
  EXPECT_EQ(counters.saturated, 0u);
  EXPECT_EQ(counters.not_finite, 0u);
}

TEST(TelemetryTap, AgesAreThoseOfTheSamples) {
  const auto packet = tap(setup(), full(), kRim, kNow);
  const auto age_ms = [&](Group g) { return packet.age_of(g).milliseconds(); };
  EXPECT_EQ(age_ms(Group::kMode), 0);
  EXPECT_EQ(age_ms(Group::kFlags), 0);
  EXPECT_EQ(age_ms(Group::kEgo), 21);
  EXPECT_EQ(age_ms(Group::kTrack), 21);
  EXPECT_EQ(age_ms(Group::kCommand), 0);
  EXPECT_EQ(age_ms(Group::kFeedback), 14);
  EXPECT_EQ(age_ms(Group::kWheels), 11);
  EXPECT_EQ(age_ms(Group::kTyres), 19);
  EXPECT_EQ(age_ms(Group::kEngine), 16);
  EXPECT_EQ(age_ms(Group::kElectric), 15);
  EXPECT_EQ(age_ms(Group::kBus), 0);
  EXPECT_EQ(age_ms(Group::kComputer), 0);
  EXPECT_EQ(age_ms(Group::kRadio), 0);
}

TEST(TelemetryTap, WhatWasNeverHeardIsNotANumberAndHasNoAge) {
  const auto packet = tap(setup(), Outputs{}, RimCounters{}, kNow);
  const std::set<std::string> known{
      "mode.mode",          "mode.ct_state",      "ego.validity",     "mode.first_stop_cause",
      "bus.frames_applied", "bus.frames_refused", "bus.frames_sent",  "bus.tx_drops",
      "bus.gate_refusals",  "bus.frames_lost",    "bus.queue_losses", "bus.controller",
      "bus.identity",       "bus.database",       "computer.steps",   "computer.missed_deadlines",
      "radio.base",         "radio.heartbeats",   "radio.base_runs",  "radio.heartbeats_refused",
      "mode.arming"};
  for (std::size_t i = 0; i < telemetry::kFieldCount; ++i)
    EXPECT_EQ(std::isnan(packet.values[i]), !known.contains(name_of(i))) << name_of(i);
  const std::set<Group> sampled{Group::kMode, Group::kCommand, Group::kBus, Group::kComputer,
                                Group::kRadio};
  for (std::size_t g = 0; g < telemetry::kGroups; ++g) {
    const auto group = static_cast<Group>(g);
    EXPECT_EQ(packet.age_of(group) >= Duration{}, sampled.contains(group))
        << telemetry::kGroupTable[g].name;
  }
}

TEST(TelemetryTap, ADisarmedCarCommandsNothing) {
  Outputs out = full();
  out.chosen.actuate = false;
  out.chosen.command = {};
  const auto packet = tap(setup(), out, kRim, kNow);
  for (const auto f : {field("command.steering"), field("command.throttle"), field("command.brake"),
                       field("command.gear")})
    EXPECT_TRUE(std::isnan(packet.values[f])) << name_of(f);
}

TEST(TelemetryTap, EveryDiagnosticHasItsOwnBit) {
  using D = world::DriveByWireDiagnostics;
  const std::array<void (*)(D&), 16> faults{
      [](D& d) { d.system_warning = true; },          [](D& d) { d.system_failure = true; },
      [](D& d) { d.brake_warning[0] = true; },        [](D& d) { d.brake_warning[1] = true; },
      [](D& d) { d.brake_warning[2] = true; },        [](D& d) { d.steer_warning[0] = true; },
      [](D& d) { d.steer_warning[1] = true; },        [](D& d) { d.steer_warning[2] = true; },
      [](D& d) { d.front_brake_out_of_spec = true; }, [](D& d) { d.rear_brake_out_of_spec = true; },
      [](D& d) { d.low_engine_speed = true; },        [](D& d) { d.steer_comms_lost = true; },
      [](D& d) { d.motec_comms_lost = true; },        [](D& d) { d.emergency_brake = true; },
      [](D& d) { d.computer_heartbeat_lost = true; }, [](D& d) { d.race_control_lost = true; }};
  for (std::size_t i = 0; i < faults.size(); ++i) {
    Outputs out;
    D d;
    faults[i](d);
    hear(out.heard.signals.diagnostics, d, 0);
    EXPECT_EQ(tap(setup(), out, kRim, kNow).values[field("electric.diagnostics")],
              std::ldexp(1.0, static_cast<int>(i)));
  }
}

// ---- Labels: protocol/telemetry must not include the enumerations that it names.

std::vector<std::string> names_in(std::string_view labels) {
  std::vector<std::string> names;
  for (std::size_t i = 0; !telemetry::label_at(labels, i).empty(); ++i)
    names.emplace_back(telemetry::label_at(labels, i));
  return names;
}

template <class E>
std::vector<std::string> in_order(std::vector<std::pair<E, std::string>> rows) {
  std::vector<std::string> names;
  for (const auto& [value, name] : rows) {
    EXPECT_EQ(static_cast<std::size_t>(value), names.size()) << name;
    names.push_back(name);
  }
  return names;
}

TEST(TelemetryLabels, NameTheModes) {
  using enum world::Mode;
  const auto names = in_order<world::Mode>({{kDisarmed, "disarmed"},
                                            {kStandby, "standby"},
                                            {kDriving, "driving"},
                                            {kControlledStop, "controlled stop"},
                                            {kEmergencyStop, "emergency stop"},
                                            {kHalted, "halted"}});
  EXPECT_EQ(names, names_in(telemetry::kModes));
  EXPECT_EQ(names.size(), world::kModes);
}

TEST(TelemetryLabels, NameTheStatesOfTheComputer) {
  using enum world::CtState;
  EXPECT_EQ(in_order<world::CtState>({{static_cast<world::CtState>(0), "-"},
                                      {kPowerOn, "power on"},
                                      {kInitialized, "initialized"},
                                      {kActuatorTest, "actuator test"},
                                      {kCrankReady, "crank ready"},
                                      {kCranking, "cranking"},
                                      {kRaceReady, "race ready"},
                                      {kInitDriving, "init driving"},
                                      {kCaution, "caution"},
                                      {kNominalRace, "nominal race"},
                                      {kCoordinatedStop, "coordinated stop"},
                                      {kControlledShutdown, "controlled shutdown"},
                                      {kEmergencyShutdown, "emergency shutdown"}}),
            names_in(telemetry::kCtStates));
}

TEST(TelemetryLabels, NameTheStatesOfTheDriveByWire) {
  using enum world::SysState;
  EXPECT_EQ(in_order<world::SysState>({{kUnknown, "unknown"},
                                       {kPowerOn, "power on"},
                                       {kSubsystemsConnected, "subsystems connected"},
                                       {kActuatorTesting, "actuator testing"},
                                       {kActuatorTestDone, "actuator test done"},
                                       {kCrankReady, "crank ready"},
                                       {kPreCrankCheck, "pre-crank check"},
                                       {kCranking, "cranking"},
                                       {kEngineRunning, "engine running"},
                                       {kDriving, "driving"},
                                       {kShutEngine, "shut engine"},
                                       {kPowerOff, "power off"},
                                       {kRaptorOff, "raptor off"},
                                       {kCrankCheckInit, "crank check init"},
                                       {kActuatorTestFailed, "actuator test failed"},
                                       {kCrankChecksFailed, "crank checks failed"},
                                       {kEmergencyShutdown, "emergency shutdown"},
                                       {kEngineFailedToStart, "engine failed to start"},
                                       {kCriticalLimitsExceeded, "critical limits exceeded"},
                                       {kStandby, "standby"}}),
            names_in(telemetry::kSysStates));
}

TEST(TelemetryLabels, NameTheValidities) {
  using enum world::Validity;
  EXPECT_EQ(in_order<world::Validity>({{kNever, "never"},
                                       {kGood, "good"},
                                       {kDeadReckoning, "dead reckoning"},
                                       {kLost, "lost"}}),
            names_in(telemetry::kValidities));
}

TEST(TelemetryLabels, NameWhatBecameOfTheArmRequest) {
  using enum safety::Arming;
  EXPECT_EQ(in_order<safety::Arming>({{kNotAsked, "not asked"},
                                      {kArmed, "armed"},
                                      {kBarred, "waits for a fault to pass"},
                                      {kMoves, "REFUSED: the car moves"},
                                      {kLastRunArmed, "REFUSED: the last run ended while armed"},
                                      {kSpent, "SPENT: release and arm anew"}}),
            names_in(telemetry::kArmings));
  const auto names = names_in(telemetry::kArmings);
  for (std::size_t i = 0; i < names.size(); ++i)
    EXPECT_EQ(names[i], safety::text_of(static_cast<safety::Arming>(i)));
}

TEST(TelemetryLabels, NameHowTheBaseIsHeard) {
  using enum safety::Health;
  EXPECT_EQ(in_order<safety::Health>({{kUnwatched, "not watched"},
                                      {kNever, "never heard"},
                                      {kGood, "heard"},
                                      {kWarning, "late"},
                                      {kBad, "LOST"}}),
            names_in(telemetry::kBaseStates));
}

TEST(TelemetryLabels, NameTheCausesOfAStop) {
  const auto names = names_in(telemetry::kStopCauses);
  ASSERT_EQ(names.size(), safety::kCauses);
  for (std::size_t i = 0; i < names.size(); ++i)
    EXPECT_EQ(names[i], safety::text_of(static_cast<safety::Cause>(i)));
}

// The bench names flags in lower case with underscores, and shorter.
template <class Flag>
void agrees_with_the_bench(std::string_view labels, Flag last) {
  const auto names = names_in(labels);
  ASSERT_EQ(names.size(), static_cast<std::size_t>(last) + 1);
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::string lower = names[i];
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    std::replace(lower.begin(), lower.end(), ' ', '_');
    EXPECT_TRUE(lower.starts_with(scenario::name_of(static_cast<Flag>(i))))
        << lower << " and " << scenario::name_of(static_cast<Flag>(i));
  }
}

TEST(TelemetryLabels, NameTheFlagsAsTheBenchDoes) {
  agrees_with_the_bench(telemetry::kTrackFlags, world::TrackFlag::kUnknown);
  agrees_with_the_bench(telemetry::kVehicleFlags, world::VehicleFlag::kUnknown);
}

}  // namespace
}  // namespace pitwall::pipeline
