// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/command_choice.hpp"

#include <algorithm>
#include <cmath>

#include "vehicle/safety/mode_table.hpp"
#include "vehicle/world/tyre_grip.hpp"

namespace pitwall::safety {
namespace {

using world::ActuatorCommand;
using world::Mode;
using world::Validity;

constexpr double kSlewTickMax_s = 0.1;  // a longer pause does not open the slew limits

double tyres_c(const Tick& t) { return world::coldest_c(t.in.signals.tyre_temperature_c, t.now); }

double ramp_dt_s(const Tick& t) {
  return std::clamp((t.now - t.state.last_chosen).seconds(), 0.0, kSlewTickMax_s);
}

// At standstill: the brake is held and the steering stays where it is.
ChosenCommand hold(const Tick& t) {
  const SupervisorState& s = t.state;
  const auto& motor = t.in.signals.steering_motor_rad;
  const double measured_rad = motor.received ? motor.value / t.params.steering_ratio : 0.0;
  const auto& powertrain = t.in.signals.powertrain;
  const std::uint8_t reported = powertrain.received ? powertrain.value.gear : std::uint8_t{0};
  return {{.at = t.now,
           .road_wheel_rad = s.last_known ? s.last.road_wheel_rad : measured_rad,
           .throttle_fraction = 0.0,
           .brake_kpa = t.params.safe_stop.hold_kpa,
           .gear = s.last_known ? s.last.gear : reported},
          CommandSource::kHold};
}

ChosenCommand stop(const Tick& t) {
  const SupervisorParams& p = t.params;
  SupervisorState& s = t.state;
  const bool biased = s.steering_bias_rad != 0.0;
  const bool hard =
      s.mode == Mode::kEmergencyStop || s.steering_deviated || biased || s.had_no_guidance;
  steering::Learned learned = t.in.learned;
  learned.offset_rad += s.steering_bias_rad;
  const auto& motor = t.in.signals.steering_motor_rad;
  const bool measured = s.steering_deviated && motor.fresh(t.now, kFeedbackAgeMax);
  const SafeStopInputs inputs{.stop = t.in.stop,
                              .last_good = s.last,
                              .speed_mps = t.speed_mps,
                              .kind = hard ? StopKind::kEmergency : StopKind::kControlled,
                              .ego = t.in.ego,
                              .tyre_c = tyres_c(t),
                              .slip = t.slip,
                              .learned = learned,
                              .steered_rad = measured ? motor.value / p.steering_ratio : kUnset};
  return {stop_along(following_of(p), s.safe_stop, inputs, t.now), CommandSource::kSafeStop};
}

// On a flat road, beside the lateral acceleration that is measured.
Grip grip_now(const Tick& t) {
  const double speed_mps = std::isfinite(t.speed_mps) ? t.speed_mps : std::abs(t.in.ego.vx_mps);
  Grip grip =
      grip_at(t.params.safe_stop, std::isfinite(speed_mps) ? speed_mps : 0.0, 0.0, 0.0, tyres_c(t));
  if (std::isfinite(t.in.ego.ay_mps2)) grip.lateral_mps2 = t.in.ego.ay_mps2;
  return grip;
}

ChosenCommand driving(const Tick& t, bool control_usable) {
  if (control_usable) return {t.in.control, CommandSource::kControl};
  return {t.state.last, CommandSource::kHold};  // known since standby
}

// The line is held, nothing pushes and, at speed, nothing brakes: the tyres have only to steer.
ChosenCommand coast(const Tick& t, bool control_usable) {
  ChosenCommand out = driving(t, control_usable);
  out.command.throttle_fraction = 0.0;
  if (!(t.speed_mps < t.params.coast_brakes_below_mps)) out.command.brake_kpa = 0.0;
  return out;
}

// By the joystick: less throttle and more brake than was chosen, never the other way.
ActuatorCommand slowed(const Tick& t, const ActuatorCommand& chosen) {
  const LinkLossOutput& radio = t.in.radio;
  ActuatorCommand out = chosen;
  out.throttle_fraction = std::min(chosen.throttle_fraction, radio.throttle_cap);
  if (radio.brake > 0.0) {
    const SafeStopParams& p = t.params.safe_stop;
    const double wanted_mps2 = radio.brake * p.decel_max_mps2;
    const double demand_kpa = brake_for(p, StopKind::kControlled, wanted_mps2, grip_now(t));
    out.brake_kpa = std::max(chosen.brake_kpa, demand_kpa);
  }
  return out;
}

// While the car drives: what stop_brake.hpp does in a stop, and no brake at all in over-steer. The
// share falls from what is in use when a wheel locks, not from what is asked for.
ActuatorCommand without_lock(const Tick& t, const ActuatorCommand& wanted) {
  ActuatorCommand out = wanted;
  double& share = t.state.safe_stop.following.lock_share;
  if (t.slip.oversteers) out.brake_kpa = 0.0;
  if (!(out.brake_kpa > kBrakeTouched_kpa)) {
    share = 1.0;
    return out;
  }
  const SafeStopParams& p = t.params.safe_stop;
  const double in_use = std::fmin(1.0, t.state.last.brake_kpa / out.brake_kpa);  // unset: 1
  if (t.slip.front > p.lock_slip) share = std::min(share, in_use);
  share = next_lock_share(p, share, t.slip, ramp_dt_s(t));
  out.brake_kpa *= share;
  return out;
}

// One gear at a time, and not sooner than the least time between two shifts.
std::uint8_t next_gear(const Tick& t, std::uint8_t wanted) {
  SupervisorState& s = t.state;
  const std::uint8_t gear = s.last.gear;
  if (wanted == gear || t.now - s.last_shift < t.params.shift_least) return gear;
  s.last_shift = t.now;
  return static_cast<std::uint8_t>(wanted > gear ? gear + 1 : gear - 1);
}

// Not more than the front tyres can take on a straight at this speed, which the gate would refuse;
// a pressure that was higher comes down as fast as it may.
double within_grip(const Tick& t, double brake_kpa) {
  const double grip_kpa = grip_now(t).total_mps2 * t.params.safe_stop.brake_share *
                          t.params.safe_stop.brake_kpa_per_mps2;
  const double falling_kpa =
      t.state.last.brake_kpa - t.params.brake_fall_kpa_per_s * ramp_dt_s(t);  // unset: the grip
  return std::min(brake_kpa, std::fmax(grip_kpa, falling_kpa));
}

// An actuator that does not follow drives the demand without end; refused, the drive-by-wire would
// take the brake itself.
double within_gate(const Tick& t, double road_wheel_rad) {
  const double limit_rad = stop_angle_max_rad(t.params.gate, t.params.steering_ratio, t.speed_mps);
  return std::clamp(road_wheel_rad, -limit_rad, limit_rad);
}

// A change of source is no jump; in a stop the throttle never rises.
ActuatorCommand limit(const Tick& t, const ActuatorCommand& wanted) {
  const SupervisorParams& p = t.params;
  ActuatorCommand out = wanted;
  if (t.state.last_known) {
    const ActuatorCommand& last = t.state.last;
    const double dt_s = ramp_dt_s(t);
    const double steer_rad = p.steer_slew_rad_per_s * dt_s;
    out.road_wheel_rad = std::clamp(wanted.road_wheel_rad, last.road_wheel_rad - steer_rad,
                                    last.road_wheel_rad + steer_rad);
    out.brake_kpa = std::clamp(wanted.brake_kpa, last.brake_kpa - p.brake_fall_kpa_per_s * dt_s,
                               last.brake_kpa + p.brake_rise_kpa_per_s * dt_s);
    out.throttle_fraction =
        std::min(wanted.throttle_fraction, last.throttle_fraction + p.throttle_rise_per_s * dt_s);
    if (t.state.mode != Mode::kDriving)
      out.throttle_fraction = std::min(out.throttle_fraction, last.throttle_fraction);
    out.gear = next_gear(t, wanted.gear);
  }
  if (t.state.mode == Mode::kCoast) out.throttle_fraction = 0.0;
  if (stops(t.state.mode) || t.state.mode == Mode::kCoast)
    out.road_wheel_rad = within_gate(t, out.road_wheel_rad);
  if (t.state.mode == Mode::kControlledStop) out.brake_kpa = within_grip(t, out.brake_kpa);
  if (out.brake_kpa > kBrakeTouched_kpa) out.throttle_fraction = 0.0;
  return out;
}

}  // namespace

bool is_located(const world::EgoState& ego) {
  return ego.validity == Validity::kGood || ego.validity == Validity::kDeadReckoning;
}

bool is_usable(const ActuatorCommand& c) {
  return std::isfinite(c.road_wheel_rad) && c.throttle_fraction >= 0.0 &&
         c.throttle_fraction <= 1.0 && c.brake_kpa >= 0.0 && std::isfinite(c.brake_kpa);
}

ChosenCommand choose(const Tick& t) {
  const SupervisorState& s = t.state;
  const bool usable = t.in.control_ok && is_usable(t.in.control);
  switch (s.mode) {
    case Mode::kDisarmed:
      return {};
    case Mode::kDriving:
      return driving(t, usable);
    case Mode::kCoast:
      return coast(t, usable);
    case Mode::kControlledStop:
    case Mode::kEmergencyStop:
      return stop(t);
    case Mode::kStandby:
    case Mode::kHalted:
      break;
  }
  return hold(t);
}

ActuatorCommand shape(const Tick& t, const ActuatorCommand& chosen) {
  const ActuatorCommand asked = slowed(t, chosen);
  return limit(t, follows_the_drive(t.state.mode) ? without_lock(t, asked) : asked);
}

}  // namespace pitwall::safety
