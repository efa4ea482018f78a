// Steering control law along a trajectory: feed-forward of curvature and banking with the learned
// steering correction, feedback of lateral and course error with a lead from the yaw rate, and a
// slow integral trim. It is tuned to be stable on every car of the family of docs/safe_stop.md, not
// for the highest stiffness.
//   in     position and course relative to the path, yaw rate, the path at the preview distance
//   out    road-wheel angle [rad], left positive
//   invariants
//          angle = L k + K a + d' + A k_fb + d + trim + bump, with k = k_yaw cos(bank) and a of
//          steering/road_load.hpp for the path a lag ahead, and with the learned gradient K'
//            k_yaw = kappa - dbeta/ds: the car yaws along its path as its steady-state slip angle
//                   beta changes
//            K    = model's + K',  A = L + (model's + gain_share K') v^2
//            k_fb = -(w^2 (e + T v chi) + 2 z w v (chi + T (r / cos(bank) - v k_yaw))) / v^2
//                   e to the left of the path, chi the course relative to it, T = lead_s
//            d    = low-pass over observer_s of observer_share times the residual of
//                   learned_steering.hpp
//            trim = -trim_per_s * A w^2 / v^2 * integral of e
//          bump makes the first angle equal to the last angle of the previous controller; it decays
//          over settle_s. Below hold_speed_mps the angle is held, and the law begins anew
//   errors none: if a value is not a number the last angle is held
//   cost   O(1), no allocation
//   source Rajamani, Vehicle Dynamics and Control, 2nd ed., eq. 3.12 (feed-forward), with the
//          gravity component of the bank; Chen et al., Disturbance-Observer-Based Control, 2016
//          (observer)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <type_traits>

#include "vehicle/steering/learned_steering.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::steering {

struct Params {
  Bicycle bicycle;
  LearningParams learning;
  double bandwidth_rad_per_s = 1.4;  // w
  double damping = 0.85;             // z
  double lead_s = 0.3;               // T
  double gain_share = 0.3;           // of the learned gradient in A
  double observer_s = 0.5, observer_share = 0.5;
  double trim_per_s = 0.05;
  double settle_s = 1.0;
  double correction_max_rad = 0.03;   // limit of d and of trim, each
  double gain_speed_least_mps = 8.0;  // lowest speed for the feedback gains
  double hold_speed_mps = 0.5;
  double stray_max_m = 1.5;  // allowed deviation while the gradient is not yet learned
};

inline constexpr auto kRanges = std::to_array<world::NamedRange<Params>>({
    {"bandwidth_rad_per_s", &Params::bandwidth_rad_per_s, 0.5, 4.0},
    {"damping", &Params::damping, 0.5, 1.5},
    {"lead_s", &Params::lead_s, 0.0, 0.5},
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

// Deviation of the car from its path, left positive, and the road at the car.
struct Deviation {
  double lateral_m = kUnset, course_rad = kUnset;
  double curvature_per_m = kUnset, bank_rad = kUnset;  // of the path at the car, Map
};

// Point of the path: curvature and bank, Map.
struct RoadPoint {
  double curvature_per_m = kUnset, bank_rad = kUnset;
};

// The road that the car turns on, with the curvature of its yaw: where a turn begins or ends the
// slip angle changes, and the yaw rate is not that of the path.
struct PathAhead {
  double yaw_per_m = kUnset, bank_rad = kUnset;  // at the preview distance
  double yaw_per_m_here = kUnset;                // at the car
};

struct SteeringInputs {
  Deviation deviation;
  PathAhead ahead;
  double speed_mps = kUnset, yaw_rate_rad_per_s = kUnset;  // unset yaw rate: that of the path
  double last_angle_rad = 0.0;
  double angle_max_rad = kUnset;  // limit at this speed
  double bandwidth_share = 1.0;   // factor on bandwidth_rad_per_s
};

// A steering disturbance d that is not modelled causes a lateral deviation of (1 - observer_share)
// d v^2 / (L w^2). Returns d v^2 for a deviation of stray_max_m.
double stray_m_rad_per_s2(const Params& params);

// Lag from a command to its yaw rate: the preview time of the feed-forward.
double lag_s(const Params& params, const Learned& learned);

// Curvature of the yaw at a point: kappa - dbeta/ds, with beta the steady-state slip angle, by the
// points `span_m` before and after it.
double yaw_per_m(const Params& params, const Learned& learned, double speed_mps,
                 const RoadPoint& at, const RoadPoint& before, const RoadPoint& after,
                 double span_m);

// `road_at` gives the RoadPoint of the path at a distance ahead of the car [m].
template <typename RoadAt>
PathAhead path_ahead(const Params& params, const Learned& learned, double speed_mps,
                     const RoadAt& road_at) {
  constexpr double kSpan_s = 0.05;
  const double v_mps = std::max(speed_mps, params.gain_speed_least_mps);
  const double span_m = kSpan_s * v_mps, ahead_m = speed_mps * lag_s(params, learned);
  const RoadPoint ahead = road_at(ahead_m);
  return {.yaw_per_m = yaw_per_m(params, learned, v_mps, ahead, road_at(ahead_m - span_m),
                                 road_at(ahead_m + span_m), span_m),
          .bank_rad = ahead.bank_rad,
          .yaw_per_m_here = yaw_per_m(params, learned, v_mps, road_at(0.0), road_at(-span_m),
                                      road_at(span_m), span_m)};
}

double steer(const Params& params, const Learned& learned, State& state, const SteeringInputs& in,
             Duration dt);

// Steering angle that one unit of curvature needs at a speed: A.
double angle_per_curvature_m(const Params& params, const Learned& learned, double speed_mps,
                             double lateral_mps2);

// What a feedback law adds to the feed-forward: an angle, a correction of what is not modelled, and
// the rate of its integral.
struct Feedback {
  double angle_rad = 0.0, unknown_rad = 0.0, trim_rad_per_s = 0.0;
};

struct Steered {
  double angle_rad = kUnset;
  double cut_rad = 0.0;    // what the limit took from the angle that the law asked for
  bool following = false;  // false: the angle is held, and the law begins anew
};

// The same with the feedback of another law: feed-forward, integral with anti-windup (it is held
// while the angle is at its limit), first angle without a bump.
Steered steer(const Params& params, const Learned& learned, State& state, const SteeringInputs& in,
              const Feedback& feedback, Duration dt);

}  // namespace pitwall::steering
