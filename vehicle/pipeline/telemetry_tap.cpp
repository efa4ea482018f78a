// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/telemetry_tap.hpp"

#include <array>

#include "protocol/telemetry/registry/labels.hpp"
#include "vehicle/safety/fault_log.hpp"

namespace pitwall::pipeline {
namespace {

using telemetry::field;
using telemetry::Group;
using telemetry::Values;

constexpr bool causes_are_labelled_as_in_safety() {
  for (std::size_t i = 0; i < safety::kCauses; ++i)
    if (telemetry::label_at(telemetry::kStopCauses, i) !=
        safety::text_of(static_cast<safety::Cause>(i)))
      return false;
  return telemetry::label_at(telemetry::kStopCauses, safety::kCauses).empty();
}
static_assert(causes_are_labelled_as_in_safety(), "telemetry labels of causes are out of date");
static_assert(telemetry::label_at(telemetry::kArmings,
                                  static_cast<std::size_t>(safety::Arming::kSpent))
                  .starts_with("SPENT"));
static_assert(telemetry::label_at(telemetry::kBaseStates,
                                  static_cast<std::size_t>(safety::Health::kBad)) == "LOST");

template <class E>
double number_of(E value) {
  return static_cast<double>(static_cast<std::uint8_t>(value));
}

void put_decisions(Values& v, const Outputs& out) {
  v[field("mode.mode")] = number_of(out.chosen.mode);
  v[field("mode.ct_state")] = number_of(out.ct_state);
  v[field("mode.arming")] = number_of(out.chosen.arming);
  v[field("mode.first_stop_cause")] = number_of(out.chosen.cause);
  v[field("command.steering")] = out.chosen.command.road_wheel_rad;
  v[field("command.throttle")] = out.chosen.command.throttle_fraction;
  v[field("command.brake")] = out.chosen.command.brake_kpa;
  if (out.chosen.actuate) v[field("command.gear")] = out.chosen.command.gear;
}

void put_race_control(Values& v, const world::RaceControl& race, Instant now) {
  if (!race.ever_heard) return;
  v[field("flags.track")] = number_of(race.track);
  v[field("flags.vehicle")] = number_of(race.vehicle);
  v[field("flags.round_target_speed")] = race.round_target_speed_mps;
  v[field("flags.heartbeat_age")] = (now - race.last_heartbeat_change).seconds();
  v[field("track.lap")] = race.lap_count;
}

void put_ego(Values& v, const Outputs& out) {
  v[field("ego.x")] = out.ego.x_m;
  v[field("ego.y")] = out.ego.y_m;
  v[field("ego.yaw")] = out.ego.yaw_rad;
  v[field("ego.vx")] = out.ego.vx_mps;
  v[field("ego.vy")] = out.ego.vy_mps;
  v[field("ego.yaw_rate")] = out.ego.yaw_rate_rad_per_s;
  v[field("ego.position_sigma")] = out.ego.position_sigma_m;
  v[field("ego.validity")] = number_of(out.ego.validity);
  v[field("track.station")] = out.place.s_m;
  v[field("track.offset")] = out.place.n_m;
  v[field("track.target_speed")] = out.steered.target_speed_mps;
}

void put_actuators(Values& v, const world::VehicleSignals& s, double steering_ratio) {
  if (s.steering_motor_rad.heard)
    v[field("feedback.steering")] = s.steering_motor_rad.value / steering_ratio;
  if (s.throttle_fraction.heard) v[field("feedback.throttle")] = s.throttle_fraction.value;
  if (s.brake.heard) {
    v[field("feedback.brake_front")] = s.brake.value.front_kpa;
    v[field("feedback.brake_rear")] = s.brake.value.rear_kpa;
  }
  if (s.powertrain.heard) {
    v[field("feedback.gear")] = s.powertrain.value.gear;
    v[field("engine.speed")] = s.powertrain.value.engine_speed_rpm;
    v[field("engine.running")] = s.powertrain.value.engine_running ? 1.0 : 0.0;
  }
}

void put_wheels(Values& v, const world::VehicleSignals& s) {
  constexpr std::array speed{field("wheels.front_left"), field("wheels.front_right"),
                             field("wheels.rear_left"), field("wheels.rear_right")};
  constexpr std::array temperature{
      field("tyres.temperature_front_left"), field("tyres.temperature_front_right"),
      field("tyres.temperature_rear_left"), field("tyres.temperature_rear_right")};
  constexpr std::array pressure{
      field("tyres.pressure_front_left"), field("tyres.pressure_front_right"),
      field("tyres.pressure_rear_left"), field("tyres.pressure_rear_right")};
  for (std::size_t i = 0; i < world::kCorners; ++i) {
    v[speed[i]] = s.wheel_speed_mps.value.at[i];
    v[temperature[i]] = s.tyre_temperature_c.value.at[i];
    v[pressure[i]] = s.tyre_pressure_kpa.value.at[i];
  }
}

// One bit per fault of CAN diagnostic_report, in the order of world::DriveByWireDiagnostics.
double diagnostic_bits(const world::DriveByWireDiagnostics& d) {
  const std::array<bool, 16> faults{
      d.system_warning,         d.system_failure,   d.brake_warning[0],
      d.brake_warning[1],       d.brake_warning[2], d.steer_warning[0],
      d.steer_warning[1],       d.steer_warning[2], d.front_brake_out_of_spec,
      d.rear_brake_out_of_spec, d.low_engine_speed, d.steer_comms_lost,
      d.motec_comms_lost,       d.emergency_brake,  d.computer_heartbeat_lost,
      d.race_control_lost};
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < faults.size(); ++i) bits |= (faults[i] ? 1U : 0U) << i;
  return bits;
}

void put_health(Values& v, const world::VehicleSignals& s) {
  if (s.misc.heard) {
    v[field("mode.sys_state")] = number_of(s.misc.value.sys_state);
    v[field("electric.battery")] = s.misc.value.battery_v;
  }
  if (s.diagnostics.heard) v[field("electric.diagnostics")] = diagnostic_bits(s.diagnostics.value);
  v[field("engine.fuel_pressure")] = s.engine.value.fuel_pressure_kpa;
  v[field("engine.oil_pressure")] = s.engine.value.oil_pressure_kpa;
  v[field("engine.coolant")] = s.engine.value.coolant_c;
}

void put_counters(Values& v, const Outputs& out, const RimCounters& rim) {
  v[field("bus.frames_applied")] = static_cast<double>(out.heard.bus.frames_applied);
  v[field("bus.frames_refused")] = static_cast<double>(out.heard.bus.refused.total());
  v[field("bus.frames_sent")] = static_cast<double>(rim.frames_sent);
  v[field("bus.tx_drops")] = static_cast<double>(rim.tx_drops);
  v[field("bus.gate_refusals")] = static_cast<double>(out.passed.refused_total);
  const world::BusHealth& bus = out.heard.bus;
  v[field("bus.frames_lost")] = static_cast<double>(bus.frames_lost);
  v[field("bus.queue_losses")] =
      static_cast<double>(bus.link.lost_in_socket + bus.link.lost_in_interface);
  v[field("bus.controller")] = number_of(bus.link.controller);
  v[field("bus.identity")] = number_of(bus.identity.verdict);
  if (bus.identity.id != 0) v[field("bus.differing_id")] = bus.identity.id;
  // The upper half: all that a number of the packet can hold; enough to tell revisions apart.
  v[field("bus.database")] = static_cast<double>(bus.identity.database >> 32U);
  v[field("computer.step_time_max")] = rim.step_time_max_us;
  v[field("computer.steps")] = static_cast<double>(rim.steps);
  v[field("computer.missed_deadlines")] = static_cast<double>(rim.missed_deadlines);
}

void put_radio(Values& v, const safety::StreamRow& base, const RimCounters& rim) {
  v[field("radio.base")] = number_of(base.health);
  if (base.health > safety::Health::kNever) v[field("radio.silence")] = base.age.seconds();
  v[field("radio.round_trip")] = rim.round_trip_ms;
  v[field("radio.heartbeats")] = static_cast<double>(rim.heartbeats);
  v[field("radio.heartbeats_refused")] = static_cast<double>(rim.heartbeats_refused);
  v[field("radio.base_runs")] = static_cast<double>(rim.base_runs);
}

template <class T>
void put_age(telemetry::StatePacket& packet, Group group, const world::Heard<T>& heard,
             Instant now) {
  if (heard.heard) packet.age_of(group) = now - heard.at;
}

}  // namespace

telemetry::StatePacket tap(const Setup& setup, const Outputs& out, const RimCounters& rim,
                           Instant now) {
  telemetry::StatePacket packet;
  Values& v = packet.values;
  const world::VehicleSignals& s = out.heard.signals;
  put_decisions(v, out);
  put_race_control(v, out.heard.race_control, now);
  put_ego(v, out);
  put_actuators(v, s, setup.params.outbound.steering_ratio);
  put_wheels(v, s);
  put_health(v, s);
  put_counters(v, out, rim);
  put_radio(v, out.watchdog[safety::Stream::kRadio], rim);

  for (const Group made_now :
       {Group::kMode, Group::kCommand, Group::kBus, Group::kComputer, Group::kRadio})
    packet.age_of(made_now) = Duration{};
  if (out.heard.race_control.ever_heard) packet.age_of(Group::kFlags) = Duration{};
  if (out.ego.validity != world::Validity::kNever) {
    packet.age_of(Group::kEgo) = now - out.ego.at;
    packet.age_of(Group::kTrack) = now - out.ego.at;
  }
  put_age(packet, Group::kFeedback, s.steering_motor_rad, now);
  put_age(packet, Group::kWheels, s.wheel_speed_mps, now);
  put_age(packet, Group::kTyres, s.tyre_temperature_c, now);
  put_age(packet, Group::kEngine, s.powertrain, now);
  put_age(packet, Group::kElectric, s.misc, now);
  return packet;
}

}  // namespace pitwall::pipeline
