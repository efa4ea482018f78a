// Steering along a trajectory: feed-forward of curvature and banking with what was learned of the
// car, feedback of the distance and the course with the lead of the yaw rate, and a slow trim.
// Made to stay stable on every car of the family of docs/safe_stop.md, not to be the stiffest.
//   in     where the car is against the path, how it turns, the path a moment ahead
//   out    road-wheel angle [rad], left positive
//   invariants
//          angle = L k + K a + d' + A k_fb + d + trim + bump, with, of the path ahead,
//          k = kappa cos(bank), a of steering/road_load.hpp, and of the learned gradient K'
//            K    = model's + K',  A = L + (model's + gain_share K') v^2
//            k_fb = -(w^2 (e + T v chi) + 2 z w v (chi + T (r / cos(bank) - v kappa))) / v^2
//                   e to the left of the path, chi the course against it, T = lead_s
//            d    = low pass over observer_s of observer_share times the residual of
//                   learned_steering.hpp
//            trim = -trim_per_s * A w^2 / v^2 * integral of e
//          bump makes the first angle that of whoever steered before; it decays over settle_s.
//          Below hold_speed_mps the wheels stay
//   errors none: what is not a number leaves the last angle
//   cost   O(1), no allocation
//   source Rajamani, Vehicle Dynamics and Control, 2nd ed., eq. 3.12 (feed-forward), with the
//          gravity of the bank; Chen et al., Disturbance-Observer-Based Control, 2016 (observer)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <type_traits>

#include "vehicle/steering/learned_steering.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::steering {

struct Params {
  Bicycle bicycle;
  LearningParams learning;
  double bandwidth_rad_per_s = 1.2;  // w
  double damping = 1.0;              // z
  double lead_s = 0.3;               // T
  double preview_s = 0.15;           // beyond the lag of the steering
  double gain_share = 0.3;           // of the learned gradient in A
  double observer_s = 0.5, observer_share = 0.5;
  double trim_per_s = 0.05;
  double settle_s = 1.0;
  double correction_max_rad = 0.03;   // of d and of trim, each
  double gain_speed_least_mps = 8.0;  // the feedback is no steeper below
  double hold_speed_mps = 0.5;
  double stray_max_m = 1.5;  // off the line by a gradient that is not yet known
};

inline constexpr auto kRanges = std::to_array<world::NamedRange<Params>>({
    {"bandwidth_rad_per_s", &Params::bandwidth_rad_per_s, 0.5, 4.0},
    {"damping", &Params::damping, 0.5, 1.5},
    {"lead_s", &Params::lead_s, 0.0, 0.5},
    {"preview_s", &Params::preview_s, 0.0, 0.5},
    {"gain_share", &Params::gain_share, 0.0, 1.0},
    {"observer_s", &Params::observer_s, 0.1, 5.0},
    {"observer_share", &Params::observer_share, 0.0, 0.9},
    {"trim_per_s", &Params::trim_per_s, 0.0, 1.0},
    {"settle_s", &Params::settle_s, 0.1, 5.0},
    {"correction_max_rad", &Params::correction_max_rad, 0.0, 0.1},
    {"gain_speed_least_mps", &Params::gain_speed_least_mps, 2.0, 20.0},
    {"hold_speed_mps", &Params::hold_speed_mps, 0.1, 5.0},
    {"stray_max_m", &Params::stray_max_m, 0.1, 10.0},
});

struct State {
  bool begun = false;
  double unknown_rad = 0.0;  // d
  double trim_rad = 0.0, bump_rad = 0.0;
};
static_assert(std::is_trivially_copyable_v<State>);

// The car against its path: left positive; the road where it is.
struct Deviation {
  double lateral_m = kUnset, course_rad = kUnset;
  double curvature_per_m = kUnset, bank_rad = kUnset;  // of the path, Map
};

struct PathAhead {
  double curvature_per_m = kUnset, bank_rad = kUnset;  // so far ahead, Map
};

struct SteeringInputs {
  Deviation deviation;
  PathAhead ahead;
  double speed_mps = kUnset, yaw_rate_rad_per_s = kUnset;  // without a yaw rate: that of the path
  double last_angle_rad = 0.0;
  double angle_max_rad = kUnset;  // what may be asked for at this speed
  double bandwidth_share = 1.0;   // of the parameter
};

// An angle d that the law does not know of leaves the car (1 - observer_share) d v^2 / (L w^2) off
// its path; with that at stray_max_m, d v^2 is this.
double stray_m_rad_per_s2(const Params& params);

// How far ahead of the car the path is that is steered for.
double preview_s(const Params& params, const Learned& learned);

double steer(const Params& params, const Learned& learned, State& state, const SteeringInputs& in,
             Duration dt);

}  // namespace pitwall::steering
