// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/powertrain.hpp"

#include <algorithm>

#include "hil/plant/engine.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::plant {
namespace {

constexpr double kCranking_rpm = 250.0;
constexpr double kFreeRevving_s = 0.15;  // how fast a disconnected engine finds its speed

double rear_rad_per_s(const Motion& m) {
  return 0.5 * (m.wheel_rad_per_s[2] + m.wheel_rad_per_s[3]);
}

double gear_ratio(const Drivetrain& d, std::uint8_t gear) {
  return gear == 0 ? 0.0 : d.final_drive * d.gear[gear - 1U];
}

bool overrevs(const Params& p, const Motion& m, std::uint8_t gear) {
  return to_rpm(rear_rad_per_s(m) * gear_ratio(p.drivetrain, gear)) > p.engine.limiter_rpm;
}

void advance_gears(const Params& p, const Actuation& a, double dt_s, State& s) {
  s.shift_left_s = std::max(0.0, s.shift_left_s - dt_s);
  const bool over = s.shift_left_s < 0.5 * dt_s;
  switch (s.shift) {
    case ShiftPhase::kShiftingUp:
    case ShiftPhase::kShiftingDown:
      if (!over) return;
      s.gear = s.target_gear;
      s.shift = ShiftPhase::kLockedOut;
      s.shift_left_s = p.drivetrain.lockout_s;
      return;
    case ShiftPhase::kLockedOut:
      if (over) s.shift = ShiftPhase::kReady;
      return;
    case ShiftPhase::kReady:
      break;
  }
  const auto wanted = static_cast<std::uint8_t>(std::min<std::size_t>(a.gear, kGears));
  if (wanted == s.gear) return;
  const bool up = wanted > s.gear;
  const auto target = static_cast<std::uint8_t>(up ? s.gear + 1 : s.gear - 1);
  if (!up && overrevs(p, s.motion, target)) return;  // refused, asked again at the next substep
  s.target_gear = target;
  s.shift = up ? ShiftPhase::kShiftingUp : ShiftPhase::kShiftingDown;
  s.shift_left_s = p.drivetrain.shift_s;
}

void advance_engine(const Params& p, const Actuation& a, double dt_s, State& s) {
  const bool fuelled = fuel_left_kg(p.fuel, s) > 0.0;
  if (!a.ignition || !fuelled) s.engine_running = false;
  const bool cranking = a.ignition && a.starter && !s.engine_running;
  s.cranked_s = cranking ? s.cranked_s + dt_s : 0.0;
  if (cranking && fuelled && s.cranked_s >= p.engine.crank_s) s.engine_running = true;
  const Clutch clutch = clutch_of(p, s, s.motion);
  const double towards_rpm = s.engine_running ? clutch.rpm : cranking ? kCranking_rpm : 0.0;
  const bool shifting = s.shift == ShiftPhase::kShiftingUp || s.shift == ShiftPhase::kShiftingDown;
  const double matched_rpm =
      to_rpm(rear_rad_per_s(s.motion) * gear_ratio(p.drivetrain, s.target_gear));
  if (clutch.engaged)
    s.engine_rpm = towards_rpm;
  else if (shifting && matched_rpm >= p.engine.launch_rpm)  // met when the next gear engages
    s.engine_rpm += (matched_rpm - s.engine_rpm) * std::min(1.0, dt_s / (s.shift_left_s + dt_s));
  else
    s.engine_rpm += (towards_rpm - s.engine_rpm) * std::min(1.0, dt_s / kFreeRevving_s);
}

void burn_fuel(const Params& p, double dt_s, State& s) {
  if (!s.engine_running) return;
  const double torque_nm = clutch_of(p, s, s.motion).crank_torque_nm;
  s.fuel_used_kg += dt_s * fuel_flow_kgps(p.engine, p.fuel, s.engine_rpm, torque_nm);
  s.fuel_used_kg = std::min(s.fuel_used_kg, std::max(0.0, p.fuel.start_kg));
}

}  // namespace

double total_ratio(const Drivetrain& drivetrain, const State& state) {
  const bool shifting =
      state.shift == ShiftPhase::kShiftingUp || state.shift == ShiftPhase::kShiftingDown;
  return shifting || !state.engine_running ? 0.0 : gear_ratio(drivetrain, state.gear);
}

Clutch clutch_of(const Params& params, const State& state, const Motion& motion) {
  const Engine& e = params.engine;
  const double throttle = motion.throttle_fraction;
  const double ratio = total_ratio(params.drivetrain, state);
  if (ratio <= 0.0) {
    // Revs freely; the governor keeps it at or above idle.
    const double free_rpm = e.idle_rpm + throttle * (e.limiter_rpm - e.idle_rpm);
    return {.engaged = false, .rpm = state.engine_running ? free_rpm : 0.0};
  }
  const double locked_rpm = to_rpm(ratio * rear_rad_per_s(motion));
  if (locked_rpm >= e.launch_rpm)
    return {.engaged = true,
            .rpm = locked_rpm,
            .crank_torque_nm = engine_torque_nm(e, locked_rpm, throttle)};
  const double torque_nm = std::max(0.0, engine_torque_nm(e, e.launch_rpm, throttle));
  const double rpm = torque_nm > 0.0 ? e.launch_rpm : std::max(e.idle_rpm, locked_rpm);
  return {.engaged = false, .rpm = rpm, .crank_torque_nm = torque_nm};
}

void advance_powertrain(const Params& params, const Actuation& actuation, double dt_s,
                        State& state) {
  advance_gears(params, actuation, dt_s, state);
  advance_engine(params, actuation, dt_s, state);
  burn_fuel(params, dt_s, state);
}

}  // namespace pitwall::plant
