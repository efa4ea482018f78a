// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/telemetry_mapper.hpp"

#include <array>

#include "protocol/telemetry/registry/labels.hpp"
#include "vehicle/pipeline/health_mapper.hpp"
#include "vehicle/pipeline/opponent_mapper.hpp"
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
                                  static_cast<std::size_t>(safety::Arming::kUsed))
                  .starts_with("SPENT"));
static_assert(telemetry::label_at(telemetry::kBaseStates,
                                  static_cast<std::size_t>(safety::Health::kBad)) == "LOST");

static_assert(telemetry::label_at(telemetry::kLinkLossLevels,
                                  static_cast<std::size_t>(safety::LinkLossLevel::kStop)) ==
              "controlled stop");
static_assert(telemetry::label_at(telemetry::kSpeedReasons,
                                  static_cast<std::size_t>(planning::Reason::kBox)) == "box");
static_assert(telemetry::kFields[field("planner.line")].max == planning::kLinesMost);

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
  v[field("command.actuate")] = out.chosen.actuate ? 1.0 : 0.0;
  v[field("command.limited")] = out.chosen.limited ? 1.0 : 0.0;
  v[field("mode.quiet")] = out.quiet ? 1.0 : 0.0;
}

void put_race_control(Values& v, const world::RaceControl& race, Instant now) {
  if (!race.ever_received) return;
  v[field("flags.track")] = number_of(race.track);
  v[field("flags.vehicle")] = number_of(race.vehicle);
  v[field("flags.round_target_speed")] = race.round_target_speed_mps;
  v[field("flags.heartbeat_age")] = (now - race.last_heartbeat_change).seconds();
  v[field("flags.conflict")] = race.conflict ? 1.0 : 0.0;
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
  v[field("track.target_speed")] = out.tracking.target_speed_mps;
}

void put_actuators(Values& v, const world::VehicleSignals& s, double steering_ratio) {
  if (s.steering_motor_rad.received)
    v[field("feedback.steering")] = s.steering_motor_rad.value / steering_ratio;
  if (s.throttle_fraction.received) v[field("feedback.throttle")] = s.throttle_fraction.value;
  if (s.brake.received) {
    v[field("feedback.brake_front")] = s.brake.value.front_kpa;
    v[field("feedback.brake_rear")] = s.brake.value.rear_kpa;
  }
  if (s.powertrain.received) {
    v[field("feedback.gear")] = s.powertrain.value.gear;
    v[field("engine.speed")] = s.powertrain.value.engine_speed_rpm;
    v[field("engine.running")] = s.powertrain.value.engine_running ? 1.0 : 0.0;
  }
}

void put_powertrain(Values& v, const world::VehicleSignals& s) {
  if (s.powertrain.received) {
    const world::Powertrain& p = s.powertrain.value;
    v[field("powertrain.throttle_position")] = p.throttle_fraction;
    v[field("powertrain.vehicle_speed")] = p.vehicle_speed_mps;
    v[field("powertrain.shift_status")] = p.gear_shift_status;
    v[field("powertrain.switch_on")] = p.engine_switch_on ? 1.0 : 0.0;
  }
  v[field("powertrain.transmission")] = s.engine.value.transmission_c;
  v[field("powertrain.transmission_pressure")] = s.engine.value.transmission_pressure_kpa;
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
  if (s.misc.received) {
    v[field("mode.sys_state")] = number_of(s.misc.value.sys_state);
    v[field("electric.battery")] = s.misc.value.battery_v;
    v[field("electric.mode_switch")] = s.misc.value.mode_switch != 0 ? 1.0 : 0.0;
    v[field("electric.safety_switch")] = s.misc.value.safety_switch;
  }
  if (s.diagnostics.received)
    v[field("electric.diagnostics")] = diagnostic_bits(s.diagnostics.value);
  v[field("engine.fuel_pressure")] = s.engine.value.fuel_pressure_kpa;
  v[field("engine.oil_pressure")] = s.engine.value.oil_pressure_kpa;
  v[field("engine.coolant")] = s.engine.value.coolant_c;
}

void put_dynamics(Values& v, const TelemetryInputs& in) {
  const world::EgoState& ego = in.out.ego;
  v[field("dynamics.forward")] = ego.ax_mps2;
  v[field("dynamics.left")] = ego.ay_mps2;
  if (const auto& imu = in.log.imu()) {
    v[field("dynamics.up")] = imu->specific_force_mps2[2];
    v[field("dynamics.roll_rate")] = imu->rate_rad_per_s[0];
    v[field("dynamics.pitch_rate")] = imu->rate_rad_per_s[1];
  }
  v[field("dynamics.roll")] = ego.roll_rad;
  v[field("dynamics.pitch")] = ego.pitch_rad;
  v[field("dynamics.bank")] = in.car.bank_rad;
  v[field("dynamics.lateral_error")] = in.out.tracking.cross_track_m;
  v[field("dynamics.heading_error")] = in.out.tracking.heading_error_rad;
  v[field("dynamics.speed_error")] = in.out.tracking.target_speed_mps - ego.vx_mps;
}

enum Primitive : std::uint8_t {
  kNoPrimitive,
  kHoldsLine,
  kStops,
  kMerges,
  kTrails,
  kPasses,
  kClosesDoor,
  kGivesWay
};
static_assert(telemetry::label_at(telemetry::kPrimitives, kGivesWay) == "gives way");

Primitive primitive_of(const Car& car) {
  if (car.follow == safety::Follow::kNone) return kNoPrimitive;
  if (car.follow == safety::Follow::kStop) return kStops;
  const planning::State& plan = car.plan.output.next;
  switch (plan.pass.phase) {
    case planning::PassPhase::kTrail:
      return kTrails;
    case planning::PassPhase::kPass:
      return kPasses;
    case planning::PassPhase::kAhead:
      return kClosesDoor;
    case planning::PassPhase::kYield:
      return kGivesWay;
    case planning::PassPhase::kFree:
      break;
  }
  return plan.merge.length_m > 0.0 ? kMerges : kHoldsLine;
}

double role_of(const world::RaceControl& race) {
  if (race.vehicle == world::VehicleFlag::kDefender) return 1.0;
  return race.vehicle == world::VehicleFlag::kAttacker ? 2.0 : 0.0;
}

void put_plan(Values& v, const TelemetryInputs& in) {
  const Plan& plan = in.car.plan;
  if (!plan.ever) return;
  v[field("planner.primitive")] = number_of(primitive_of(in.car));
  v[field("planner.reason")] = number_of(plan.output.reason);
  v[field("planner.line")] = static_cast<double>(plan.output.line_number);
  v[field("planner.line_offset")] = plan.output.line_offset_m;
  const std::optional<planning::Passing>& passing = in.setup.params.planning.passing;
  if (passing && plan.output.next.pass.phase == planning::PassPhase::kTrail)
    v[field("planner.target_gap")] = passing->pass.trail_gap_m;
  v[field("planner.stop_distance")] = plan.output.stop_distance_m;
  v[field("planner.operator_limit")] = in.out.speed_limit_mps;
  v[field("planner.grip_limited")] = in.out.steered.speed.grip_limited ? 1.0 : 0.0;
  v[field("planner.missed_shifts")] = in.car.control.gear.missed;
  if (plan.good_at) v[field("planner.age")] = (in.now - *plan.good_at).seconds();
  if (in.out.received.race_control.ever_received)
    v[field("planner.role")] = role_of(in.out.received.race_control);
  if (!plan.made_with.ever_received) return;
  v[field("flags.track_acted_on")] = number_of(plan.made_with.track);
  v[field("flags.vehicle_acted_on")] = number_of(plan.made_with.vehicle);
}

void put_rival(telemetry::Snapshot& snapshot, const world::Received<world::RivalReport>& rival) {
  if (!rival.received || rival.value.number == 0) return;
  Values& v = snapshot.values;
  v[field("rival.number")] = rival.value.number;
  v[field("rival.rank")] = rival.value.rank;
  v[field("rival.laps")] = rival.value.laps;
  v[field("rival.lap_distance")] = rival.value.lap_distance_m;
  v[field("rival.speed")] = rival.value.speed_mps;
  snapshot.at(Group::kRival) = rival.at;
}

// Of a car whose operator has entered what is in the tank.
void put_fuel(telemetry::Snapshot& snapshot, const TelemetryInputs& in) {
  const rules::FuelLeft fuel = in.car.fuel.left(in.setup.params.fuel);
  if (fuel.state == rules::FuelState::kUnknown) return;
  snapshot.values[field("fuel.laps_left")] = fuel.least_laps;
  snapshot.at(Group::kFuel) = in.now;
}

void put_uplink(telemetry::Snapshot& snapshot, const TelemetryInputs& in) {
  const IoCounters::Uplink& up = in.io.uplink;
  if (!up.known) return;
  Values& v = snapshot.values;
  v[field("mode.stop_latch")] = up.stop_latch;
  v[field("mode.stop_challenge")] = up.stop_challenge;
  v[field("uplink.stop_reason")] = up.stop_reason;
  v[field("uplink.authority")] = up.authority;
  v[field("uplink.joystick")] = up.joystick ? 1.0 : 0.0;
  v[field("uplink.schema_agrees")] = up.schema_agrees ? 1.0 : 0.0;
  v[field("uplink.throttle_cap")] = in.out.radio.throttle_cap;
  const safety::StreamRow& base = in.out.watchdog[safety::Stream::kRadio];
  if (base.health > safety::Health::kNever) v[field("uplink.link_age")] = base.age.seconds();
  snapshot.at(Group::kUplink) = in.now;
}

template <class T>
void put_time(telemetry::Snapshot& snapshot, Group group, const world::Received<T>& received) {
  if (received.received) snapshot.at(group) = received.at;
}

void put_times(telemetry::Snapshot& snapshot, const TelemetryInputs& in) {
  const world::VehicleSignals& s = in.out.received.signals;
  snapshot.at(Group::kMode) = snapshot.at(Group::kCommand) = in.now;
  if (in.out.received.race_control.ever_received) snapshot.at(Group::kFlags) = in.now;
  if (in.out.ego.validity != world::Validity::kNever) {
    for (const Group group : {Group::kEgo, Group::kTrack, Group::kDynamics})
      snapshot.at(group) = in.out.ego.at;
  }
  if (in.car.plan.ever) snapshot.at(Group::kPlanner) = in.car.plan.at;
  put_time(snapshot, Group::kFeedback, s.steering_motor_rad);
  put_time(snapshot, Group::kWheels, s.wheel_speed_mps);
  put_time(snapshot, Group::kTyres, s.tyre_temperature_c);
  put_time(snapshot, Group::kEngine, s.powertrain);
  put_time(snapshot, Group::kPowertrain, s.powertrain);
  put_time(snapshot, Group::kElectric, s.misc);
}

}  // namespace

telemetry::Snapshot map_telemetry(const TelemetryInputs& in) {
  telemetry::Snapshot snapshot;
  Values& v = snapshot.values;
  const world::VehicleSignals& s = in.out.received.signals;
  put_decisions(v, in.out);
  put_race_control(v, in.out.received.race_control, in.now);
  put_ego(v, in.out);
  put_actuators(v, s, in.setup.params.outbound.steering_ratio);
  put_powertrain(v, s);
  put_wheels(v, s);
  put_health(v, s);
  put_dynamics(v, in);
  put_plan(v, in);
  put_fuel(snapshot, in);
  put_uplink(snapshot, in);
  put_rival(snapshot, s.rival);
  v[field("track.last_lap_time")] = in.log.last_lap_s();
  if (s.wheel_speed_mps.received)
    v[field("wheels.standstill")] = in.out.chosen.standstill ? 1.0 : 0.0;
  put_times(snapshot, in);
  map_opponents(in, snapshot);
  map_health(in, snapshot);
  return snapshot;
}

}  // namespace pitwall::pipeline
