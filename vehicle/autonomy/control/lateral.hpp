// Lateral controller: linear-quadratic regulator on the bicycle error model, one gain per speed
// bracket, evaluated at a look-ahead point of the trajectory. This is the published baseline; on
// purpose it has no feed-forward and no term for banking.
//   in     EgoState (Map, Body), Trajectory (Map)     out  road-wheel angle [rad], left positive
//   invariants
//          angle = clamp(-K e); e1 = -(x - x*) sin psi* + (y - y*) cos psi*,
//          e1' = vy cos e2 + vx sin e2, e2 = wrap(psi - psi*), e2' = map heading rate - vx kappa*,
//          where * is the trajectory point d = lookahead_base + lookahead_per_speed * vx ahead of
//          the projection of the car, and x, y, psi are the present pose of the car (as published)
//   limit  |angle| <= angle_max_rad of the parameters and of the tick. Below gain_speed_floor_mps
//          the gain of the first bracket is used
//   errors verdict. Without a usable trajectory or ego state the last angle is held. Beyond
//          deviation_max_m the controller still acts, with verdict kTooFar
//   cost   O(trajectory points), no allocation
//   source Saba et al., Fast and Modular Autonomy Software, sec. controls (signs as in Rajamani)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/control/bicycle_params.hpp"
#include "vehicle/autonomy/control/lqr_gains.hpp"
#include "vehicle/world/ego_state.hpp"
#include "vehicle/world/legal_range.hpp"
#include "vehicle/world/trajectory.hpp"

namespace pitwall::control {

// Lower edges; the last bracket has no upper edge.
inline constexpr std::size_t kSpeedBrackets = 11;
inline constexpr std::array<double, kSpeedBrackets> kBracketFrom_mps{0,  10, 20, 25, 30, 35,
                                                                     40, 45, 50, 55, 60};

struct LateralWeights {
  std::array<double, 4> state{kUnset, kUnset, kUnset, kUnset};  // for e1, e1', e2, e2'; >= 0
  double steering = kUnset;                                     // > 0
};

struct LateralParams {
  std::array<LateralWeights, kSpeedBrackets> weights;
  double lookahead_base_m = kUnset;
  double lookahead_per_speed_s = kUnset;
  double angle_max_rad = kUnset;
  double gain_speed_floor_mps = kUnset;  // lowest speed of the gain design
  double deviation_max_m = kUnset;       // the verdict is kTooFar above this
};

inline constexpr auto kLateralRanges = std::to_array<world::NamedRange<LateralParams>>({
    {"lookahead_base_m", &LateralParams::lookahead_base_m, 0.0, 30.0},
    {"lookahead_per_speed_s", &LateralParams::lookahead_per_speed_s, 0.0, 1.0},
    {"angle_max_rad", &LateralParams::angle_max_rad, 0.02, 0.3},
    {"gain_speed_floor_mps", &LateralParams::gain_speed_floor_mps, 1.0, 10.0},
    {"deviation_max_m", &LateralParams::deviation_max_m, 1.0, 20.0},
});

using LateralGain = std::array<double, 4>;
struct LateralGains {
  std::array<LateralGain, kSpeedBrackets> k;
  LqrGains lqr_ff;  // of lqr_ff.hpp; not made here
};

enum class LateralVerdict : std::uint8_t { kUnknown, kGood, kNoTrajectory, kNoEgo, kTooFar };

struct LateralDiagnostics {
  LateralVerdict verdict = LateralVerdict::kUnknown;
  std::uint8_t bracket = 0;
  double angle_rad = kUnset;              // after the clamp
  double e1_m = kUnset, e2_rad = kUnset;  // as used in the control law
  double cross_track_m = kUnset;          // at the projection of the car; performance metric
  double heading_error_rad = kUnset;      // at the projection of the car
  bool saturated = false;
};

// At start-up: solves one Riccati equation per bracket. Returns a Problem for a parameter outside
// its range and for a bracket without a stabilising gain; its place names the bracket.
Result<LateralGains, Problem> design(const LateralParams& params, const BicycleParams& car);

// Angle of the last tick and angle limit of this tick.
struct Angles {
  double last_rad = 0.0;
  double max_rad = kUnset;  // unset: limit of the parameters only
};

double angle_max_rad(const LateralParams& params, const Angles& angles);
std::size_t bracket_of(double speed_mps);
bool is_usable(const world::EgoState& ego);

LateralDiagnostics steer(const LateralParams& params, const LateralGains& gains,
                         const Angles& angles, const world::EgoState& ego,
                         const world::Trajectory& trajectory);

}  // namespace pitwall::control
