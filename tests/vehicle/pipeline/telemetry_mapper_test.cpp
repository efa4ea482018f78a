// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/telemetry_mapper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "protocol/telemetry/registry/labels.hpp"
#include "protocol/telemetry/state_packet.hpp"
#include "tests/vehicle/pipeline/mapped_car.hpp"
#include "vehicle/safety/fault_log.hpp"

namespace pitwall::pipeline {
namespace {

using namespace testing;  // NOLINT: the fixture of this test
using telemetry::Group;

// What no part of the car tells yet, as the header says, or only while it trails a rival.
bool is_nobodys(std::size_t i) {
  using enum Group;
  static const std::set<Group> kNobodys{kSuspension, kTread, kSteeringUnit, kBrakes};
  static const std::set<std::string> kUnknown{"dynamics.roll",
                                              "dynamics.pitch",
                                              "powertrain.torque",
                                              "powertrain.oil",
                                              "powertrain.traction_aim",
                                              "powertrain.traction_range",
                                              "planner.target_gap",
                                              "planner.cost",
                                              "fuel.level",
                                              "fuel.used",
                                              "fuel.flow"};
  const telemetry::FieldRow& row = telemetry::kFields[i];
  return kNobodys.contains(row.group) || kUnknown.contains(name_of(i)) ||
         telemetry::row_of(row.group).direction == telemetry::Direction::kUp;
}

const std::vector<Row> kTelemetryRows{
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
    {field("fuel.laps_left"), (40.0 - 2.0) / (2.2 * 1.13)},
    {field("engine.oil_pressure"), 480},
    {field("engine.coolant"), 91},
    {field("electric.battery"), 13.6},
    {field("electric.diagnostics"), 1 + 32768},  // first and last bit
    {field("mode.arming"), 5},
    {field("mode.stop_latch"), 1},
    {field("mode.stop_challenge"), 4711},
    {field("mode.quiet"), 1},
    {field("flags.conflict"), 1},
    {field("flags.track_acted_on"), 2},
    {field("flags.vehicle_acted_on"), 9},
    {field("uplink.stop_reason"), 3},
    {field("uplink.authority"), 5},
    {field("uplink.joystick"), 1},
    {field("uplink.throttle_cap"), 0.6},
    {field("uplink.link_age"), 1.25},
    {field("uplink.schema_agrees"), 1},
    {field("track.last_lap_time"), 0.6},  // 1200 m at 20 m a tick
    {field("command.actuate"), 1},
    {field("command.limited"), 1},
    {field("wheels.standstill"), 1},
    {field("dynamics.forward"), 1},
    {field("dynamics.left"), 2},
    {field("dynamics.up"), 9.75},
    {field("dynamics.roll_rate"), 0.125},
    {field("dynamics.pitch_rate"), -0.25},
    {field("dynamics.bank"), 0.25},
    {field("dynamics.lateral_error"), 0.375},
    {field("dynamics.heading_error"), 0.03125},
    {field("dynamics.speed_error"), 4},
    {field("powertrain.throttle_position"), 0.3},
    {field("powertrain.vehicle_speed"), 60.25},
    {field("powertrain.transmission"), 85},
    {field("powertrain.transmission_pressure"), 240},
    {field("powertrain.shift_status"), 3},
    {field("powertrain.switch_on"), 0},
    {field("electric.mode_switch"), 1},
    {field("electric.safety_switch"), 6},
    {field("planner.role"), 0},
    {field("planner.primitive"), 2},
    {field("planner.reason"), 10},
    {field("planner.line"), 0},
    {field("planner.line_offset"), -0.5},
    {field("planner.stop_distance"), 210},
    {field("planner.operator_limit"), 55.5},
    {field("planner.age"), 0.072},
    {field("planner.grip_limited"), 1},
    {field("planner.missed_shifts"), 3},
    {field("rival.number"), 17},
    {field("rival.rank"), 2},
    {field("rival.laps"), 8},
    {field("rival.lap_distance"), 1234},
    {field("rival.speed"), 61.5},
};

TEST(TelemetryTap, EachFieldSaysWhatTheTickSays) { expect(kTelemetryRows); }

// Here every signal was heard: what is unset is what the header of the tap lists.
TEST(TelemetryTap, NothingButTheListedFieldsIsUnset) {
  const auto snapshot = mapped(full());
  for (std::size_t i = 0; i < telemetry::kFieldCount; ++i) {
    const std::string name = name_of(i);
    const bool silent_unit = name.starts_with("gnss0.") || name.starts_with("sensors.gnss0") ||
                             name.starts_with("sensors.imu1");
    EXPECT_EQ(std::isnan(snapshot.values[i]), is_nobodys(i) || silent_unit) << name;
  }
}

TEST(TelemetryTap, EveryValueFitsTheRangeOfItsField) {
  const auto snapshot = mapped(full());
  telemetry::PacketBuffer buffer;
  telemetry::EncodeCounters counters;
  (void)telemetry::encode(telemetry::packet_of(snapshot, kNow), buffer, counters);
  EXPECT_EQ(counters.saturated, 0u);
  EXPECT_EQ(counters.not_finite, 0u);
  for (std::size_t i = 0; i < telemetry::kFieldCount; ++i) {
    const double value = snapshot.values[i];
    if (std::isnan(value)) continue;
    EXPECT_GE(value, telemetry::kFields[i].min) << name_of(i);
    EXPECT_LE(value, telemetry::kFields[i].max) << name_of(i);
  }
}

TEST(TelemetryTap, TimesAreThoseOfTheSamples) {
  using enum Group;
  const auto snapshot = mapped(full());
  const std::map<Group, int> ages_ms{
      {kMode, 0},      {kFlags, 0},       {kUplink, 0},    {kEgo, 21},      {kTrack, 21},
      {kCommand, 0},   {kFeedback, 14},   {kWheels, 11},   {kDynamics, 21}, {kTyres, 19},
      {kEngine, 16},   {kPowertrain, 16}, {kElectric, 15}, {kPlanner, 22},  {kLocalization, 0},
      {kStreams, 0},   {kSensors, 0},     {kGnss1, 0},     {kReceivers, 0}, {kComputer, 0},
      {kFaults, 0},    {kBus, 0},         {kRadio, 0},     {kRival, 21},    {kOpponent1, 0},
      {kOpponent2, 0}, {kOpponent3, 0},   {kOpponent4, 0}, {kFuel, 0}};
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
    const auto expected = ages_ms.find(row.group);
    ASSERT_EQ(snapshot.ever(row.group), expected != ages_ms.end()) << row.name;
    if (!snapshot.ever(row.group)) continue;
    EXPECT_EQ((kNow - snapshot.at(row.group)).milliseconds(), expected->second) << row.name;
  }
}

// A value without a time would never be sent, a time without any value would be sent in vain.
TEST(TelemetryTap, AGroupHasATimeOnlyIfItHasAValue) {
  for (const auto& snapshot : {mapped(full()), mapped_of_nothing()}) {
    for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
      const auto [first, count] = telemetry::fields_of(row.group);
      const auto* const begin = snapshot.values.at.begin() + first;
      const bool any = std::any_of(begin, begin + count, [](double v) { return !std::isnan(v); });
      EXPECT_TRUE(any || !snapshot.ever(row.group)) << row.name;
    }
  }
}

TEST(TelemetryTap, WhatWasNeverHeardIsNotANumberAndHasNoTime) {
  const auto snapshot = mapped_of_nothing();
  const std::set<std::string> known{"mode.mode",
                                    "mode.ct_state",
                                    "mode.first_stop_cause",
                                    "mode.arming",
                                    "mode.quiet",
                                    "ego.validity",
                                    "command.actuate",
                                    "command.limited",
                                    "dynamics.bank",
                                    "localization.position_units",
                                    "localization.heading_units",
                                    "localization.imu_units",
                                    "localization.accepted",
                                    "localization.outliers",
                                    "localization.unsolved",
                                    "localization.uncertain",
                                    "localization.late",
                                    "localization.implausible",
                                    "localization.restarts",
                                    "localization.bad_stamps",
                                    "localization.contradicted",
                                    "localization.excluded",
                                    "localization.imu0_verdict",
                                    "localization.imu1_verdict",
                                    "localization.velocity_units",
                                    "localization.wheel_verdict",
                                    "bus.frames_applied",
                                    "bus.frames_refused",
                                    "bus.frames_sent",
                                    "bus.tx_drops",
                                    "bus.gate_refusals",
                                    "bus.frames_lost",
                                    "bus.queue_losses",
                                    "bus.controller",
                                    "bus.identity",
                                    "bus.database",
                                    "computer.steps",
                                    "computer.missed_deadlines",
                                    "faults.now",
                                    "faults.now_more",
                                    "faults.recorded",
                                    "radio.base",
                                    "radio.rung",
                                    "radio.heartbeats",
                                    "radio.heartbeats_refused",
                                    "radio.base_runs",
                                    "radio.slots_skipped"};
  for (std::size_t i = 0; i < telemetry::kFieldCount; ++i) {
    const bool expected = known.contains(name_of(i)) || name_of(i).starts_with("streams.");
    EXPECT_EQ(!std::isnan(snapshot.values[i]), expected) << name_of(i);
  }
  using enum Group;
  const std::set<Group> sampled{kMode,     kCommand, kLocalization, kStreams,
                                kComputer, kFaults,  kBus,          kRadio};
  for (const telemetry::GroupRow& row : telemetry::kGroupTable)
    EXPECT_EQ(snapshot.ever(row.group), sampled.contains(row.group)) << row.name;
}

TEST(TelemetryTap, ADisarmedCarCommandsNothing) {
  Outputs out = full();
  out.chosen.actuate = false;
  out.chosen.command = {};
  const auto packet = mapped(out);
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
    receive(out.received.signals.diagnostics, d, 0);
    EXPECT_EQ(mapped(out).values[field("electric.diagnostics")],
              std::ldexp(1.0, static_cast<int>(i)));
  }
}

TEST(TelemetryTap, TheLineIsTheNumberInItsBank) {
  const auto car = std::make_unique<Car>();
  const auto line = [&] {
    const telemetry::Snapshot snapshot =
        map_telemetry({.setup = setup(), .car = *car, .out = {}, .log = {}, .io = {}, .now = kNow});
    return snapshot.values[field("planner.line")];
  };
  EXPECT_TRUE(std::isnan(line())) << "before the first plan";
  car->plan.ever = true;
  EXPECT_EQ(line(), 0.0) << "no bank";
  car->plan.output.line_number = 7;
  EXPECT_EQ(line(), 7.0);
}

}  // namespace
}  // namespace pitwall::pipeline
