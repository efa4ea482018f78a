// Single-track models as pure functions: for ghosts, sweeps and as a yardstick of the double track.
//   in     state, rate of the steering angle and longitudinal acceleration (both are bounded by the
//          model's own limits), parameters
//   out    derivative; the state one Runge-Kutta step on
//   source M. Althoff and G. Wuersching, CommonRoad: Vehicle Models (2020): kinematic single track
//          (KS, reference point the rear axle) and single track (ST, centre of gravity; linear
//          tyres, loads by longitudinal acceleration), with its constraints of steering and
//          acceleration. ST divides by speed: it means nothing at standstill, is stiff below a few
//          metres a second, and is no model of reversing
//   low speed  blended_derivative() is ours: kinematic below kBlendFrom_mps and in reverse, ST from
//          kBlendTo_mps, in between their mean by a cubic weight of speed: neither a step nor
//          a kink. The kinematic part carries slip angle and yaw rate along what the steering
//          angle says and draws them there within kSettle_s
//   errors none: blended_step() stays finite for finite inputs; its steps may be up to 10 ms with
//          tyres up to twice as stiff as the AV-21's
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/plant/params.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::plant {

struct SingleTrackLimits {
  double angle_min_rad = 0.0, angle_max_rad = 0.0;  // of the steered wheel
  double angle_rate_min_rad_per_s = 0.0, angle_rate_max_rad_per_s = 0.0;
  double speed_min_mps = 0.0, speed_max_mps = 0.0;
  double accel_max_mps2 = 0.0;  // either way; forwards less above the switching speed,
  double switching_mps = 0.0;   // as power is bounded
};

struct SingleTrackParams {
  double front_axle_m = 0.0, rear_axle_m = 0.0;  // from the centre of gravity
  double height_m = 0.0;
  double mass_kg = 0.0, yaw_inertia_kgm2 = 0.0;
  double friction = 0.0;
  double gravity_mps2 = kGravity_mps2;  // the published figures were made with 9.81
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

// What of an input the limits let through.
SingleTrackInput constrained(const SingleTrackLimits& limits, const SingleTrackInput& input,
                             double angle_rad, double speed_mps);

KinematicState kinematic_derivative(const SingleTrackParams& params, const KinematicState& state,
                                    const SingleTrackInput& input);
// Needs a speed other than zero.
SingleTrackState single_track_derivative(const SingleTrackParams& params,
                                         const SingleTrackState& state,
                                         const SingleTrackInput& input);
SingleTrackState blended_derivative(const SingleTrackParams& params, const SingleTrackState& state,
                                    const SingleTrackInput& input);

KinematicState kinematic_step(const SingleTrackParams& params, const KinematicState& state,
                              const SingleTrackInput& input, double dt_s);
SingleTrackState blended_step(const SingleTrackParams& params, const SingleTrackState& state,
                              const SingleTrackInput& input, double dt_s);

// The double track's car at small slip angles, without downforce and with rigid steering.
SingleTrackParams single_track_of(const Params& params);

}  // namespace pitwall::plant
