// Single-track models as pure functions, for ghost cars, parameter sweeps and as a reference for
// the double-track model.
//   in     state, rate of the steering angle and longitudinal acceleration (both limited by the
//          model), parameters
//   out    derivative; the state after one Runge-Kutta step
//   source M. Althoff and G. Wuersching, CommonRoad: Vehicle Models (2020): kinematic single track
//          (KS, reference point the rear axle) and single track (ST, centre of gravity; linear
//          tyres, loads by longitudinal acceleration), with its constraints of steering and
//          acceleration. ST divides by speed: it is undefined at standstill, stiff below a few
//          metres a second, and no model of reversing
//   low speed  blended_derivative() is our own: kinematic below kBlendFrom_mps and in reverse, ST
//              from kBlendTo_mps, in between a mean with a cubic weight of speed, without step or
//              kink. The kinematic part moves slip angle and yaw rate to the values of the steering
//              angle with the time constant kSettle_s
//   errors none: blended_step() stays finite for finite inputs; its steps may be up to 10 ms with
//          tyres up to twice as stiff as the AV-21's
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/plant/params.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::plant {

struct SingleTrackLimits {
  double angle_min_rad = 0.0, angle_max_rad = 0.0;  // angle of the steered wheel
  double angle_rate_min_rad_per_s = 0.0, angle_rate_max_rad_per_s = 0.0;
  double speed_min_mps = 0.0, speed_max_mps = 0.0;
  double accel_max_mps2 = 0.0;  // in both directions; forwards it falls above switching_mps
  double switching_mps = 0.0;   // above it power limits the acceleration
};

struct SingleTrackParams {
  double front_axle_m = 0.0, rear_axle_m = 0.0;  // from the centre of gravity
  double height_m = 0.0;
  double mass_kg = 0.0, yaw_inertia_kgm2 = 0.0;
  double friction = 0.0;
  double gravity_mps2 = kGravity_mps2;  // the published figures use 9.81
  double front_stiffness_per_rad = 0.0, rear_stiffness_per_rad = 0.0;  // per friction and load
  SingleTrackLimits limits;
};

struct SingleTrackInput {
  double angle_rate_rad_per_s = 0.0, accel_mps2 = 0.0;
};

struct KinematicState {
  double x_m = 0.0, y_m = 0.0;  // of the rear axle
  double angle_rad = 0.0, speed_mps = 0.0, yaw_rad = 0.0;
};

struct SingleTrackState {
  double x_m = 0.0, y_m = 0.0;  // of the centre of gravity
  double angle_rad = 0.0, speed_mps = 0.0, yaw_rad = 0.0;
  double yaw_rate_rad_per_s = 0.0;
  double slip_rad = 0.0;  // of the centre of gravity, left of the car's axis positive
};

inline constexpr double kBlendFrom_mps = 2.0, kBlendTo_mps = 8.0;
inline constexpr double kSettle_s = 0.05;

// The input, limited by `limits`.
SingleTrackInput constrained(const SingleTrackLimits& limits, const SingleTrackInput& input,
                             double angle_rad, double speed_mps);

KinematicState kinematic_derivative(const SingleTrackParams& params, const KinematicState& state,
                                    const SingleTrackInput& input);
// The speed must not be zero.
SingleTrackState single_track_derivative(const SingleTrackParams& params,
                                         const SingleTrackState& state,
                                         const SingleTrackInput& input);
SingleTrackState blended_derivative(const SingleTrackParams& params, const SingleTrackState& state,
                                    const SingleTrackInput& input);

KinematicState kinematic_step(const SingleTrackParams& params, const KinematicState& state,
                              const SingleTrackInput& input, double dt_s);
SingleTrackState blended_step(const SingleTrackParams& params, const SingleTrackState& state,
                              const SingleTrackInput& input, double dt_s);

// Single-track parameters of a double-track car at small slip angles, without downforce and with
// rigid steering.
SingleTrackParams single_track_of(const Params& params);

}  // namespace pitwall::plant
