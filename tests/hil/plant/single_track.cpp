// SPDX-License-Identifier: Apache-2.0
#include "tests/hil/plant/single_track.hpp"

#include <algorithm>
#include <cmath>

#include "hil/plant/compliant/brush_tyre.hpp"
#include "hil/plant/runge_kutta.hpp"
#include "hil/plant/tyre.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::plant {
namespace {

double wheelbase_m(const SingleTrackParams& p) { return p.front_axle_m + p.rear_axle_m; }

// Single track that rolls without slip, seen from the centre of gravity.
SingleTrackState rolling_derivative(const SingleTrackParams& p, const SingleTrackState& s,
                                    const SingleTrackInput& u) {
  const double length_m = wheelbase_m(p), share = p.rear_axle_m / length_m;
  const double tangent = std::tan(s.angle_rad);
  const double tangent_per_s = u.angle_rate_rad_per_s * (1.0 + tangent * tangent);
  const double slip_tangent = share * tangent;
  const double slip_rad = std::atan(slip_tangent), cos_slip = std::cos(slip_rad);
  const double slip_per_s = share * tangent_per_s / (1.0 + slip_tangent * slip_tangent);
  const double yaw_rate = s.speed_mps * cos_slip * tangent / length_m;
  const double yaw_rate_per_s =
      (u.accel_mps2 * cos_slip * tangent - s.speed_mps * std::sin(slip_rad) * slip_per_s * tangent +
       s.speed_mps * cos_slip * tangent_per_s) /
      length_m;
  return {.x_m = s.speed_mps * std::cos(s.yaw_rad + slip_rad),
          .y_m = s.speed_mps * std::sin(s.yaw_rad + slip_rad),
          .angle_rad = u.angle_rate_rad_per_s,
          .speed_mps = u.accel_mps2,
          .yaw_rad = yaw_rate,
          .yaw_rate_rad_per_s = yaw_rate_per_s + (yaw_rate - s.yaw_rate_rad_per_s) / kSettle_s,
          .slip_rad = slip_per_s + (slip_rad - s.slip_rad) / kSettle_s};
}

// The published right-hand side, its input already constrained.
SingleTrackState slipping_derivative(const SingleTrackParams& p, const SingleTrackState& s,
                                     const SingleTrackInput& u) {
  const double lf = p.front_axle_m, lr = p.rear_axle_m, length_m = wheelbase_m(p);
  // Lateral force per slip angle, mass and friction.
  const double front =
      p.front_stiffness_per_rad * (p.gravity_mps2 * lr - u.accel_mps2 * p.height_m) / length_m;
  const double rear =
      p.rear_stiffness_per_rad * (p.gravity_mps2 * lf + u.accel_mps2 * p.height_m) / length_m;
  const double v = s.speed_mps, r = s.yaw_rate_rad_per_s, slip = s.slip_rad;
  const double moment_arm = p.friction * p.mass_kg / p.yaw_inertia_kgm2;
  return {.x_m = v * std::cos(slip + s.yaw_rad),
          .y_m = v * std::sin(slip + s.yaw_rad),
          .angle_rad = u.angle_rate_rad_per_s,
          .speed_mps = u.accel_mps2,
          .yaw_rad = r,
          .yaw_rate_rad_per_s =
              moment_arm * (lf * front * s.angle_rad + (lr * rear - lf * front) * slip -
                            (lf * lf * front + lr * lr * rear) * r / v),
          .slip_rad = (p.friction * (lr * rear - lf * front) / (v * v) - 1.0) * r +
                      p.friction / v * (front * s.angle_rad - (rear + front) * slip)};
}

double stiffness_n(const Params& p, const Tyre& tyre, double load_n) {
  return p.structure == Structure::kCompliantBrush ? brush_lat_stiffness_n(tyre, p.brush, load_n)
                                                   : lat_stiffness_n(tyre, load_n, 1.0);
}

double most_power_w(const Params& p) {
  double most = 0.0;
  for (const EnginePoint& at : p.engine.full_throttle)
    most = std::max(most, at.torque_nm * from_rpm(at.rpm));
  return most * p.drivetrain.efficiency;
}

// Braking by the weaker axle's friction; forwards by the engine's power; speed by the limiter.
SingleTrackLimits limits_of(const Params& p) {
  const double angle_rad = p.steering.angle_max_rad / p.steering.ratio;
  const double rate = p.steering.rate_max_rad_per_s / p.steering.ratio;
  const double accel_mps2 = std::min(p.front.mu_long, p.rear.mu_long) * kGravity_mps2;
  const double top_mps = from_rpm(p.engine.limiter_rpm) * p.rear.radius_m /
                         (p.drivetrain.final_drive * p.drivetrain.gear.back());
  return {.angle_min_rad = -angle_rad,
          .angle_max_rad = angle_rad,
          .angle_rate_min_rad_per_s = -rate,
          .angle_rate_max_rad_per_s = rate,
          .speed_min_mps = 0.0,
          .speed_max_mps = top_mps,
          .accel_max_mps2 = accel_mps2,
          .switching_mps = most_power_w(p) / (p.chassis.mass_kg * accel_mps2)};
}

}  // namespace

SingleTrackInput constrained(const SingleTrackLimits& limits, const SingleTrackInput& input,
                             double angle_rad, double speed_mps) {
  const SingleTrackLimits& l = limits;
  SingleTrackInput u = input;
  const bool angle_ends = (angle_rad <= l.angle_min_rad && u.angle_rate_rad_per_s <= 0.0) ||
                          (angle_rad >= l.angle_max_rad && u.angle_rate_rad_per_s >= 0.0);
  u.angle_rate_rad_per_s = angle_ends
                               ? 0.0
                               : std::clamp(u.angle_rate_rad_per_s, l.angle_rate_min_rad_per_s,
                                            l.angle_rate_max_rad_per_s);
  const bool speed_ends = (speed_mps <= l.speed_min_mps && u.accel_mps2 <= 0.0) ||
                          (speed_mps >= l.speed_max_mps && u.accel_mps2 >= 0.0);
  const double forward_mps2 = speed_mps > l.switching_mps
                                  ? l.accel_max_mps2 * l.switching_mps / speed_mps
                                  : l.accel_max_mps2;
  u.accel_mps2 = speed_ends ? 0.0 : std::clamp(u.accel_mps2, -l.accel_max_mps2, forward_mps2);
  return u;
}

KinematicState kinematic_derivative(const SingleTrackParams& params, const KinematicState& state,
                                    const SingleTrackInput& input) {
  const SingleTrackInput u = constrained(params.limits, input, state.angle_rad, state.speed_mps);
  return {.x_m = state.speed_mps * std::cos(state.yaw_rad),
          .y_m = state.speed_mps * std::sin(state.yaw_rad),
          .angle_rad = u.angle_rate_rad_per_s,
          .speed_mps = u.accel_mps2,
          .yaw_rad = state.speed_mps / wheelbase_m(params) * std::tan(state.angle_rad)};
}

SingleTrackState single_track_derivative(const SingleTrackParams& params,
                                         const SingleTrackState& state,
                                         const SingleTrackInput& input) {
  return slipping_derivative(params, state,
                             constrained(params.limits, input, state.angle_rad, state.speed_mps));
}

SingleTrackState blended_derivative(const SingleTrackParams& params, const SingleTrackState& state,
                                    const SingleTrackInput& input) {
  const SingleTrackInput u = constrained(params.limits, input, state.angle_rad, state.speed_mps);
  if (state.speed_mps >= kBlendTo_mps) return slipping_derivative(params, state, u);
  const SingleTrackState rolling = rolling_derivative(params, state, u);
  if (state.speed_mps <= kBlendFrom_mps) return rolling;
  const double t = (state.speed_mps - kBlendFrom_mps) / (kBlendTo_mps - kBlendFrom_mps);
  const double weight = t * t * (3.0 - 2.0 * t);
  const SingleTrackState slipping = slipping_derivative(params, state, u);
  return ahead(rolling, ahead(slipping, rolling, -1.0), weight);
}

KinematicState kinematic_step(const SingleTrackParams& params, const KinematicState& state,
                              const SingleTrackInput& input, double dt_s) {
  return runge_kutta_step(
      state, [&](const KinematicState& s) { return kinematic_derivative(params, s, input); }, dt_s);
}

SingleTrackState blended_step(const SingleTrackParams& params, const SingleTrackState& state,
                              const SingleTrackInput& input, double dt_s) {
  return runge_kutta_step(
      state, [&](const SingleTrackState& s) { return blended_derivative(params, s, input); }, dt_s);
}

SingleTrackParams single_track_of(const Params& params) {
  const Chassis& c = params.chassis;
  const double weight_n = c.mass_kg * kGravity_mps2;
  const double length_m = c.front_axle_m + c.rear_axle_m;
  const double front_n = 0.5 * weight_n * c.rear_axle_m / length_m;
  const double rear_n = 0.5 * weight_n * c.front_axle_m / length_m;
  constexpr double kFriction = 1.0;  // is within the stiffness of the tyres
  return {.front_axle_m = c.front_axle_m,
          .rear_axle_m = c.rear_axle_m,
          .height_m = c.height_m,
          .mass_kg = c.mass_kg,
          .yaw_inertia_kgm2 = c.yaw_inertia_kgm2,
          .friction = kFriction,
          .front_stiffness_per_rad = stiffness_n(params, params.front, front_n) / front_n,
          .rear_stiffness_per_rad = stiffness_n(params, params.rear, rear_n) / rear_n,
          .limits = limits_of(params)};
}

}  // namespace pitwall::plant
