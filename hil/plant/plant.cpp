// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/plant.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "hil/plant/dynamics.hpp"
#include "hil/plant/powertrain.hpp"
#include "hil/plant/runge_kutta.hpp"
#include "hil/plant/tyre_thermal.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::plant {
namespace {

static_assert(std::is_trivially_copyable_v<State>);

double bounded(double value, double low, double high) {
  return std::isfinite(value) ? std::clamp(value, low, high) : std::clamp(0.0, low, high);
}

double quantised_steering_rad(const Steering& p, double command_rad) {
  const double raw_rad = bounded(command_rad, -p.angle_max_rad, p.angle_max_rad);
  return p.quantum_rad > 0.0 ? p.quantum_rad * std::round(raw_rad / p.quantum_rad) : raw_rad;
}

// Puts a command into its delay line and takes out the one that has arrived.
template <class Kept, class Value>
Value delayed(std::array<Kept, kDelaySlots>& ring, std::size_t next, Value command, double delay_s,
              double dt_s) {
  const auto slots = static_cast<std::size_t>(std::lround(delay_s / dt_s));
  CHECK(slots < kDelaySlots);
  ring[next] = static_cast<Kept>(command);
  if (slots == 0) return command;
  return static_cast<Value>(ring[next >= slots ? next - slots : next + kDelaySlots - slots]);
}

// What has reached the actuators of what is asked now.
struct Arrived {
  SetPoints set;
  std::uint8_t gear = 0;
};

Arrived pass_delays(const Params& p, const Actuation& a, double dt_s, State& s) {
  const std::size_t next = s.delay_next;
  const double steering_rad = quantised_steering_rad(p.steering, a.steering_motor_rad);
  const double throttle = bounded(a.throttle_fraction, 0.0, 1.0);
  const double brake_kpa = bounded(a.brake_kpa, 0.0, p.brakes.pressure_max_kpa);
  Arrived out;
  out.set.steering_motor_rad =
      delayed(s.steering_delay_rad, next, steering_rad, p.steering.delay_s, dt_s);
  out.set.throttle_fraction =
      delayed(s.throttle_delay, next, throttle, p.engine.throttle_delay_s, dt_s);
  out.set.brake_front_kpa = out.set.brake_rear_kpa =
      delayed(s.brake_delay_kpa, next, brake_kpa, p.brakes.delay_s, dt_s);
  if (a.front_brake_lost) out.set.brake_front_kpa = 0.0;
  if (a.rear_brake_lost) out.set.brake_rear_kpa = 0.0;
  out.gear = delayed(s.gear_delay, next, a.gear, p.drivetrain.shift_delay_s, dt_s);
  s.delay_next = static_cast<std::uint16_t>((next + 1U) % kDelaySlots);
  return out;
}

// A wheel whose rotation has ended, or would before the next substep has, is held if friction can
// hold it; a held one is let go when it cannot.
void hold_or_release(const Params& p, const Motion& before, const Forces& f, double dt_s,
                     State& s) {
  for (std::size_t i = 0; i < world::kCorners; ++i) {
    const Tyre& tyre = tyre_of(p, i);
    double& speed = s.motion.wheel_rad_per_s[i];
    const double spare_nm = f.hold_nm[i] - std::abs(turning_moment_nm(f, i, tyre.radius_m));
    const bool ended = before.wheel_rad_per_s[i] * speed <= 0.0 ||
                       std::abs(speed) <= spare_nm * dt_s / tyre.wheel_inertia_kgm2;
    s.locked[i] = spare_nm >= 0.0 && (s.locked[i] || ended);
    if (s.locked[i]) speed = 0.0;
  }
}

void warm_tyres(const TyreThermal& t, const Forces& f, double dt_s, State& s) {
  const double speed_mps = std::abs(s.motion.vx_mps);
  for (std::size_t i = 0; i < world::kCorners; ++i)
    s.tyre_c[i] += dt_s * warming_kps(t, i < 2 ? t.front : t.rear, s.tyre_c[i],
                                      {.slip_w = f.slip_power_w[i],
                                       .rolling_w = f.rolling_power_w[i],
                                       .speed_mps = speed_mps});
}

void substep(const Params& p, const Actuation& a, const Surface& road, double dt_s, State& s) {
  const Arrived arrived = pass_delays(p, a, dt_s, s);
  Actuation now = a;
  now.gear = arrived.gear;
  advance_powertrain(p, now, dt_s, s);
  const Motion before = s.motion;
  s.motion = runge_kutta_step(
      before, [&](const Motion& m) { return derivative_of(p, s, m, road, arrived.set); }, dt_s);
  const Forces f = forces_of(p, s, s.motion, road);
  hold_or_release(p, before, f, dt_s, s);
  warm_tyres(p.thermal, f, dt_s, s);
}

std::uint8_t shift_status(const State& s) {
  switch (s.shift) {
    case ShiftPhase::kReady:
      return 1;
    case ShiftPhase::kLockedOut:
      return 2;
    case ShiftPhase::kShiftingUp:
      return 3;
    case ShiftPhase::kShiftingDown:
      return 4;
  }
  return 0;
}

void observe_map(const Motion& m, const Forces& f, const Surface& road, Truth& t) {
  const MapVelocity over_ground = map_velocity(m, road);
  t.x_m = m.x_m, t.y_m = m.y_m, t.z_m = road.height_m, t.yaw_rad = wrap_pi(m.yaw_rad);
  t.roll_rad = -road.bank_rad, t.pitch_rad = -road.climb_rad;
  t.vx_mps = m.vx_mps, t.vy_mps = m.vy_mps, t.yaw_rate_rad_per_s = m.yaw_rate_rad_per_s;
  t.map_vx_mps = over_ground.east_mps, t.map_vy_mps = over_ground.north_mps;
  t.map_vz_mps = over_ground.up_mps;
  t.heading_rate_rad_per_s = f.heading_rate_rad_per_s;
  t.bank_rad = road.bank_rad;
  t.speed_mps = std::hypot(m.vx_mps, m.vy_mps);
  t.odometer_m = m.odometer_m;
}

// Does the pit lane lie beside this station?
bool beside_pit(const world::TrackMap& track, double s_m) {
  const auto& pit = track.pit();
  return pit && track.station_ahead(pit->entry_s_m, s_m) <=
                    track.station_ahead(pit->entry_s_m, pit->exit_s_m);
}

double bank_slope_per_m(const world::TrackMap& track, double s_m) {
  constexpr double kReach_m = 1.0;
  return (track.at(s_m + kReach_m).bank_rad - track.at(s_m - kReach_m).bank_rad) / (2.0 * kReach_m);
}

}  // namespace

State standing(const Params& params, double x_m, double y_m, double yaw_rad) {
  State s;
  s.motion.x_m = x_m, s.motion.y_m = y_m, s.motion.yaw_rad = yaw_rad;
  s.tyre_c.fill(params.thermal.working_c);
  return s;
}

State rolling(const Params& params, const State& at, double speed_mps, std::uint8_t gear) {
  State s = at;
  s.motion.vx_mps = speed_mps;
  s.motion.vy_mps = s.motion.yaw_rate_rad_per_s = 0.0;
  s.motion.stretch_long_m = s.motion.stretch_lat_m = {};
  s.motion.roll_rad = s.motion.roll_rate_rad_per_s = s.motion.steering_flex_rad = 0.0;
  for (std::size_t i = 0; i < world::kCorners; ++i) {
    s.motion.wheel_rad_per_s[i] = speed_mps / tyre_of(params, i).radius_m;
    s.locked[i] = speed_mps == 0.0;
  }
  s.gear = s.target_gear = static_cast<std::uint8_t>(std::min<std::size_t>(gear, kGears));
  s.gear_delay.fill(s.gear);
  s.shift = ShiftPhase::kReady;
  s.engine_running = true;
  s.engine_rpm = clutch_of(params, s, s.motion).rpm;
  return s;
}

void empty_tank(const Params& params, State& state) { state.fuel_used_kg = params.fuel.start_kg; }

State step(const Params& params, const State& state, const Actuation& actuation,
           const Surface& surface, double dt_s) {
  const auto substeps = std::lround(dt_s / params.substep_s);
  CHECK(substeps >= 1);
  CHECK(std::abs(static_cast<double>(substeps) * params.substep_s - dt_s) < 1e-9);
  State next = state;
  for (long i = 0; i < substeps; ++i) substep(params, actuation, surface, params.substep_s, next);
  return next;
}

Truth observe(const Params& params, const State& state, const Surface& surface) {
  const Motion& m = state.motion;
  const Forces f = forces_of(params, state, m, surface);
  Truth t;
  observe_map(m, f, surface, t);
  t.rate_rad_per_s = {f.roll_rate_rad_per_s, f.pitch_rate_rad_per_s, m.yaw_rate_rad_per_s};
  const double carried_kg = mass_kg(params, state);
  t.specific_force_mps2 = {f.body_x_n / carried_kg, f.body_y_n / carried_kg,
                           f.normal_n / carried_kg};
  t.load_n = f.load_n, t.force_long_n = f.long_n, t.force_lat_n = f.lat_n;
  t.slip_ratio = f.slip_ratio;
  for (std::size_t i = 0; i < world::kCorners; ++i) {
    t.wheel_speed_mps[i] = m.wheel_rad_per_s[i] * tyre_of(params, i).radius_m;
    t.slip_angle_rad[i] = std::asin(std::clamp(f.slip_sine[i], -1.0, 1.0));
  }
  t.tyre_c = state.tyre_c;
  t.friction_use = *std::max_element(f.use.begin(), f.use.end());
  t.steering_motor_rad = m.steering_motor_rad;
  t.road_wheel_rad = road_wheel_rad(params, m);
  t.throttle_fraction = m.throttle_fraction;
  t.brake_front_kpa = m.brake_front_kpa, t.brake_rear_kpa = m.brake_rear_kpa;
  t.engine_rpm = state.engine_rpm;
  t.engine_torque_nm = clutch_of(params, state, m).crank_torque_nm;
  t.engine_running = state.engine_running;
  t.fuel_kg = fuel_left_kg(params.fuel, state);
  t.gear = state.gear;
  t.gear_shift_status = shift_status(state);
  return t;
}

Road road_at(const Params& params, const world::TrackMap& track, const State& state,
             std::optional<double> hint_s_m) {
  const Motion& m = state.motion;
  const world::Curvilinear here = track.project(m.x_m, m.y_m, hint_s_m);
  const world::TrackPoint line = track.at(here.s_m);
  Road road;
  road.s_m = here.s_m, road.n_m = here.n_m;
  road.heading_error_rad = wrap_pi(m.yaw_rad - line.yaw_rad);
  const double forward_mps =
      m.vx_mps * std::cos(road.heading_error_rad) - m.vy_mps * std::sin(road.heading_error_rad);
  const double station_mps = forward_mps / std::max(0.1, 1.0 - line.curvature_per_m * here.n_m);
  road.surface.bank_rad = line.bank_rad;
  road.surface.bank_rate_rad_per_s = bank_slope_per_m(track, here.s_m) * station_mps;
  // The rectangle round the wheels, turned by the heading error, reaches this far to either side.
  const double reach_m = 0.5 * params.chassis.width_m * std::abs(std::cos(road.heading_error_rad)) +
                         0.5 * params.chassis.length_m * std::abs(std::sin(road.heading_error_rad));
  double left_m = line.width_left_m, right_m = line.width_right_m;
  if (beside_pit(track, here.s_m)) {
    const world::PitLane& pit = *track.pit();
    left_m = std::max(left_m, pit.offset_m + 0.5 * pit.width_m);
    right_m = std::max(right_m, 0.5 * pit.width_m - pit.offset_m);
  }
  road.wall_gap_left_m = left_m - here.n_m - reach_m;
  road.wall_gap_right_m = right_m + here.n_m - reach_m;
  road.contact = !(road.wall_gap_left_m > 0.0 && road.wall_gap_right_m > 0.0);
  return road;
}

}  // namespace pitwall::plant
