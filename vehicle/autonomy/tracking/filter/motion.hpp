// Motion of a car between two frames: constant turn rate and acceleration, both of which are
// forgotten with time (first-order Gauss-Markov), in each mode with its own noise. With a map the
// turn rate adds to that of the road and the heading comes back to that of the road, so a car of
// which nothing is seen follows it: the middle between its walls.
//   in     a track and a step in time
//   out    its states and covariance after it
//   source Bar-Shalom, Li and Kirubarajan (2001), section 8.2.3 (Singer model)
//   invariants
//          the states are unset nowhere and finite as long as they were before
//   cost   0.6 us a step; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/tracking/filter/filter_params.hpp"
#include "vehicle/autonomy/tracking/filter/modes.hpp"
#include "vehicle/autonomy/tracking/filter/track.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::tracking {

// Indices of the states of the method "road".
inline constexpr std::size_t kAlong = 0, kAcross = 1, kHeading = 2, kSpeed = 3, kAccel = 4,
                             kTurn = 5;

// Value that is forgotten with time, and its integral, over one step.
struct Fading {
  double kept = 1.0;            // share of the value after the step
  double gain_s = 0.0;          // of the integral by the value
  double half_s = 0.0;          // the same after half of the step
  double value_variance = 0.0;  // noise
  double integral_variance = 0.0;
  double covariance = 0.0;
};
Fading fading(double sigma, double time_s, double dt_s);

struct ModeStep {
  Fading accel, turn;
};

// Constants of a step, the same for all tracks.
struct MotionStep {
  double dt_s = 0.0;
  std::array<ModeStep, kModes> mode{};
  double wander_variance = 0.0, heading_variance = 0.0;
  double heading_kept = 1.0;  // share of the heading after the step
  ModeChange change;
};
MotionStep motion_step(const RoadParams& params, bool with_map, double dt_s);

// Curvature of the reference line at the nearest of its points; zero without a map.
double curvature_at(const world::TrackMap* map, double s_m);

// Turn rate of a car that follows the road.
double road_turn_of(double curvature_per_m, const StateVector& x);

// States of a mode after a step, and the Jacobian of the two positions: all other rows are linear.
struct Advance {
  StateVector x{};
  std::array<RoadVector, 2> jacobian{};
};
Advance advanced(const MotionStep& step, std::size_t mode, double curvature_per_m,
                 const StateVector& x);

// As wrap_pi; most angles are small, and its remainder is slow.
inline double full_turn(double angle_rad) {
  return std::abs(angle_rad) <= std::numbers::pi ? angle_rad : wrap_pi(angle_rad);
}

// Moves the tracks by a time of any length, in steps of at most 0.1 s. The modes of one are joined.
void coast(const RoadParams& params, const world::TrackMap* map, Duration time, Tracks& tracks);
void coast(const RoadParams& params, const world::TrackMap* map, Duration time, Track& track);

}  // namespace pitwall::tracking
