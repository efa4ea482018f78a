// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/rig.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "hil/faults/sensor_faults.hpp"
#include "hil/scenario/perturbed.hpp"
#include "protocol/can/av21.hpp"

namespace pitwall::bench {
namespace {

using faults::BenchFaultKind;

race::Script script_of(const scenario::Scenario& scenario) {
  race::Script script;
  for (const scenario::FlagChange& change : scenario.race_control)
    script.calls.push_back({.at = Instant{} + change.at,
                            .track = change.track,
                            .vehicle = change.vehicle,
                            .round_target_speed_mph = change.round_target_speed_mph,
                            .lap = std::nullopt});
  return script;
}

// The same four in every variant.
bool is_actuator(std::uint32_t id) {
  return std::ranges::any_of(can::av21::kMessages, [id](const can::MessageRow& row) {
    return row.id == id && row.safety == can::SafetyClass::kActuator;
  });
}

}  // namespace

Result<Rig, Problem> Rig::build(const scenario::Scenario& scenario, const world::TrackMap& track) {
  if (scenario.start.speed_mps != 0.0)
    return Unexpected{Problem{
        scenario.name, "start.speed_mps: expected 0, because the bench starts at standstill"}};
  if (scenario.start.s_m >= track.length_m())
    return Unexpected{Problem{scenario.name, "start.s_m lies beyond the end of the track"}};
  auto plan = plan_faults(scenario.faults, scenario.seed);
  if (!plan) return Unexpected{plan.error()};

  auto variant = can_variant::CanVariant::of(scenario.bus);
  if (!variant) return Unexpected{variant.error()};
  Rig rig{track, *std::move(plan), *std::move(variant)};
  const world::TrackPoint at = track.offset(scenario.start.s_m, scenario.start.n_m);
  rig.perturb_ = scenario.perturb;
  rig.plant_params_ = plant::plant_of(scenario);
  rig.plant_ = plant::standing(rig.plant_params_, at.x_m, at.y_m, at.yaw_rad);
  rig.plant_.tyre_c.fill(scenario.tyres.temperature_c);
  rig.road_ = plant::road_at(rig.plant_params_, track, rig.plant_);
  if (rig.road_.contact)
    return Unexpected{Problem{scenario.name, "start.n_m puts the car into a wall"}};
  rig.ground_ = plant::RoadSurface(track, scenario.perturb.bank_error_rad,
                                   rig.plant_params_.chassis.height_m);
  rig.surface_ = rig.true_road();
  rig.truth_ = plant::observe(rig.plant_params_, rig.plant_, rig.surface_);
  rig.script_ = script_of(scenario);
  rig.timer_params_ = {.track_length_m = track.length_m()};
  rig.sensor_params_ = sensors::params_for(track);
  rig.sensors_ = sensors::make_state(rig.sensor_params_, scenario.seed, Instant{});
  rig.wheels_ = sensors::make_wheels(rig.wheel_params_, scenario.seed, Instant{});
  return rig;
}

void Rig::step(std::span<const can::ReceivedFrame> from_car, Instant now) {
  if (std::exchange(outgoing_taken_, false)) outgoing_.clear();
  apply_model_faults(now);
  for (const can::ReceivedFrame& received : from_car)
    if (is_actuator(received.frame.id)) ++actuator_frames_;
  const auto incoming = computer_silent_ ? std::span<const can::ReceivedFrame>{} : from_car;
  const auto raptor =
      drive_by_wire::step(raptor_params_, raptor_, understood(incoming), feedback(), now);
  demand_ = raptor.demand;
  step_plant();
  wheel_speed_mps_ = sensors::step_wheels(wheel_params_, wheels_, truth_.wheel_speed_mps, now);
  time_laps(now);
  for (const can::Frame& frame : raptor.frames) encode_frames(Node::kDriveByWire, frame, now);
  for (const can::Frame& frame : variant_.due(now)) send(Node::kDriveByWire, frame, now);

  const race::Timing timing{.laps = static_cast<std::uint8_t>(laps_.finished & 0xFF),
                            .lap_distance_m = road_.s_m,
                            .last_lap_s = std::isfinite(laps_.last_s) ? laps_.last_s : 0.0,
                            .speed_mps = truth_.speed_mps,
                            .rival = rival_};
  for (const can::Frame& frame : race::step(script_, race_, timing, now))
    encode_frames(Node::kRaceControl, frame, now);
  release_delayed(now);

  sensors::step(sensor_params_, sensors_, truth_, now, samples_);
}

void Rig::step_plant() {
  const plant::Actuation actuation{.steering_motor_rad = demand_.steering_motor_rad,
                                   .throttle_fraction = demand_.throttle_fraction,
                                   .brake_kpa = demand_.brake_front_kpa,
                                   .front_brake_lost = brake_lost_[0],
                                   .rear_brake_lost = brake_lost_[1],
                                   .gear = demand_.gear,
                                   .ignition = demand_.engine_on && !engine_stalled_,
                                   .starter = demand_.crank};
  plant_ = plant::step(plant_params_, plant_, actuation, surface_, kRigStep.seconds());
  road_ = plant::road_at(plant_params_, track_, plant_, road_.s_m);
  if (held_tyre_c_) plant_.tyre_c.fill(*held_tyre_c_);
  surface_ = true_road();
  truth_ = plant::observe(plant_params_, plant_, surface_);
}

plant::Surface Rig::true_road() const {
  scenario::Perturbations but_the_bank = perturb_;  // the ground has that
  but_the_bank.bank_error_rad = 0.0;
  plant::Surface road = plant::perturbed(ground_.at(road_, plant_.motion), but_the_bank);
  road.grip *= grip_;
  return road;
}

drive_by_wire::Feedback Rig::feedback() const {
  drive_by_wire::Feedback f;
  if (!wheel_speeds_lost_) f.wheel_speed_mps = wheel_speed_mps_;  // else it sends no report
  f.vehicle_speed_mps = truth_.speed_mps;
  f.brake_front_kpa = truth_.brake_front_kpa;
  f.brake_rear_kpa = truth_.brake_rear_kpa;
  f.throttle_fraction = truth_.throttle_fraction;
  f.steering_motor_rad = truth_.steering_motor_rad;
  if (truth_.fuel_kg <= 0.0) f.fuel_pressure_kpa = 0.0;
  f.engine_speed_rpm = truth_.engine_rpm;
  f.engine_running = truth_.engine_running;
  f.gear = truth_.gear;
  f.gear_shift_status = truth_.gear_shift_status;
  f.wheel_torque_nm = truth_.engine_torque_nm;
  f.tyre_temperature_c = truth_.tyre_c;
  f.wheel_load_n = truth_.load_n;
  return f;
}

std::span<const can::ReceivedFrame> Rig::understood(std::span<const can::ReceivedFrame> incoming) {
  understood_.clear();
  for (const can::ReceivedFrame& received : incoming) {
    if (const auto frame = variant_.receive(received.frame))
      understood_.push_back({*frame, received.at});
  }
  return understood_;
}

void Rig::encode_frames(Node from, const can::Frame& frame, Instant now) {
  for (const can::Frame& sent : variant_.transmitted(frame)) send(from, sent, now);
}

void Rig::send(Node from, const can::Frame& frame, Instant now) {
  if (bus_silent_) return;
  for (const faults::TimedFrame& timed : faults::apply(plan_.frames, frame_faults_, frame, now)) {
    faults::DelayQueue& later = delayed_[static_cast<std::size_t>(from)];
    const bool kept = timed.at > now ? later.push(timed) : outgoing_.push({from, timed.frame});
    if (!kept) ++overflows_;
  }
}

void Rig::release_delayed(Instant now) {
  for (std::size_t from = 0; from < delayed_.size(); ++from)
    while (const auto timed = delayed_[from].pop(now)) {
      if (bus_silent_) continue;
      if (!outgoing_.push({static_cast<Node>(from), timed->frame})) ++overflows_;
    }
}

void Rig::time_laps(Instant now) {
  const bool green = race_.flags.track == world::TrackFlag::kGreen ||
                     race_.flags.track == world::TrackFlag::kWavingGreen;
  const auto lap =
      race::step(timer_params_, timer_,
                 {.station_m = road_.s_m, .speed_mps = truth_.speed_mps, .green = green}, now);
  if (!lap) return;
  ++laps_.finished;
  laps_.last_s = (lap->end - lap->begin).seconds();
  if (!lap->flying) return;
  ++laps_.flying;
  if (lap->mean_speed_mps > laps_.best_flying_mean_mps) {
    laps_.best_flying_mean_mps = lap->mean_speed_mps;
    laps_.best_flying_s = laps_.last_s;
  }
}

void Rig::apply_model_faults(Instant now) {
  if (plan_.models.empty()) return;
  sensors_.fault = {};
  wheels_.fault = {};
  raptor_.faults = {};
  race_.faults = {};
  bus_silent_ = computer_silent_ = engine_stalled_ = wheel_speeds_lost_ = false;
  held_tyre_c_.reset();
  brake_lost_ = {};
  grip_ = 1.0;
  for (const faults::BenchFault& fault : plan_.models)
    if (faults::active(fault, now)) apply_model_fault(fault, now);
}

void Rig::apply_model_fault(const faults::BenchFault& fault, Instant now) {
  switch (fault.kind) {
    case BenchFaultKind::kRaceControlSilent:
      race_.faults.silent = true;
      return;
    case BenchFaultKind::kRaceHeartbeatStop:
      race_.faults.heartbeat_stopped = true;
      return;
    case BenchFaultKind::kWrongRoundSpeed:
      race_.faults.wrong_speed_mph = fault.value;
      return;
    case BenchFaultKind::kFlagsLate:
      race_.faults.late = from_seconds(fault.value);
      return;
    case BenchFaultKind::kSteeringStuck:
      raptor_.faults.steering_stuck = true;
      return;
    case BenchFaultKind::kSteeringSlow:
      raptor_.faults.steering_rate_rad_per_s = fault.value;
      return;
    case BenchFaultKind::kSteeringBias:
      raptor_.faults.steering_bias_rad = fault.value;
      return;
    case BenchFaultKind::kBrakeLeak:
      raptor_.faults.brake_leak = fault.value;
      return;
    case BenchFaultKind::kBrakeStuck:
      raptor_.faults.brake_stuck_kpa = fault.value;
      return;
    case BenchFaultKind::kBrakeCircuitLost:
      brake_lost_[fault.unit] = true;
      return;
    case BenchFaultKind::kThrottleStuck:
      raptor_.faults.throttle_stuck = true;
      return;
    case BenchFaultKind::kEngineStall:
      engine_stalled_ = true;
      return;
    case BenchFaultKind::kLowGrip:
      grip_ = fault.value;
      return;
    case BenchFaultKind::kFuelOut:
      plant::empty_tank(plant_params_, plant_);  // nobody fills it afterwards
      return;
    case BenchFaultKind::kColdTyres:
      held_tyre_c_ = fault.value;
      return;
    case BenchFaultKind::kWheelSpeedLoss:
      wheel_speeds_lost_ = true;
      return;
    case BenchFaultKind::kBusSilent:
      bus_silent_ = true;
      return;
    case BenchFaultKind::kComputerSilent:
      computer_silent_ = true;
      return;
    default:
      apply_sensor_fault(fault, now, sensors_, wheels_);
      return;
  }
}

std::span<const Outgoing> Rig::take_frames() {
  if (outgoing_taken_) return {};
  outgoing_taken_ = true;
  return outgoing_.span();
}

world::SensorInput Rig::take_samples() { return std::exchange(samples_, world::SensorInput{}); }

}  // namespace pitwall::bench
