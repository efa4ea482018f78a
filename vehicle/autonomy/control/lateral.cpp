// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/lateral.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "vehicle/autonomy/control/bicycle_model.hpp"
#include "vehicle/autonomy/control/preview.hpp"
#include "vehicle/autonomy/control/riccati.hpp"

namespace pitwall::control {
namespace {

using world::EgoState;
using world::TrajectoryPoint;

// The mean of the bracket, its lower edge where it is open.
double design_speed(std::size_t bracket, double floor_mps) {
  const double from = kBracketFrom_mps[bracket];
  if (bracket + 1 == kSpeedBrackets) return from;
  return std::max(0.5 * (from + kBracketFrom_mps[bracket + 1]), floor_mps);
}

Result<LateralGain, RiccatiFailure> gain(const BicycleParams& car, const LateralWeights& weights,
                                         double speed_mps) {
  const ErrorVector b = steering_input(car);
  RiccatiProblem problem;
  problem.a = error_dynamics(car, speed_mps);
  problem.g = b * b.transpose() / weights.steering;
  problem.q = Eigen::Map<const ErrorVector>(weights.state.data()).asDiagonal();
  const auto x = solve(problem);
  if (!x) return Unexpected{x.error()};
  const ErrorVector k = *x * b / weights.steering;
  return LateralGain{k[0], k[1], k[2], k[3]};
}

bool legal(const LateralWeights& w) {
  const auto weight = [](double q) { return std::isfinite(q) && q >= 0.0; };
  return std::all_of(w.state.begin(), w.state.end(), weight) && std::isfinite(w.steering) &&
         w.steering > 0.0;
}

// e = (e1, e1', e2, e2') of the car at a point of the trajectory.
LateralGain error_at(const TrajectoryPoint& p, const EgoState& ego) {
  const double dx = ego.x_m - p.x_m, dy = ego.y_m - p.y_m;
  const double e2 = wrap_pi(ego.yaw_rad - p.yaw_rad);
  const double heading_rate = ego.yaw_rate_rad_per_s / std::cos(p.bank_rad);
  return {-dx * std::sin(p.yaw_rad) + dy * std::cos(p.yaw_rad),
          ego.vy_mps * std::cos(e2) + ego.vx_mps * std::sin(e2), e2,
          heading_rate - ego.vx_mps * p.curvature_per_m};
}

}  // namespace

bool is_usable(const EgoState& ego) {
  const bool placed =
      ego.validity == world::Validity::kGood || ego.validity == world::Validity::kDeadReckoning;
  return placed && std::isfinite(ego.x_m + ego.y_m + ego.yaw_rad + ego.vx_mps + ego.vy_mps +
                                 ego.yaw_rate_rad_per_s);
}

double angle_max_rad(const LateralParams& params, const Angles& angles) {
  return std::fmin(params.angle_max_rad, angles.max_rad);
}

std::size_t bracket_of(double speed_mps) {
  std::size_t bracket = 0;
  while (bracket + 1 < kSpeedBrackets && speed_mps >= kBracketFrom_mps[bracket + 1]) ++bracket;
  return bracket;
}

Result<LateralGains, Problem> design(const LateralParams& params, const BicycleParams& car) {
  LateralGains gains{};
  for (std::size_t i = 0; i < kSpeedBrackets; ++i) {
    const std::string place = "lateral.weights[" + std::to_string(i) + "]";
    if (!legal(params.weights[i])) {
      return Unexpected{Problem{place, "state weights must be >= 0 and steering > 0"}};
    }
    const double speed = design_speed(i, params.gain_speed_floor_mps);
    const auto k = gain(car, params.weights[i], speed);
    if (!k) return Unexpected{Problem{place, to_string(k.error())}};
    gains.k[i] = *k;
  }
  return gains;
}

LateralDiagnostics steer(const LateralParams& params, const LateralGains& gains,
                         const Angles& angles, const EgoState& ego,
                         const world::Trajectory& trajectory) {
  LateralDiagnostics out;
  out.angle_rad = angles.last_rad;
  if (!is_usable(ego)) return out.verdict = LateralVerdict::kNoEgo, out;
  const auto here = project(trajectory, ego.x_m, ego.y_m);
  if (!here) return out.verdict = LateralVerdict::kNoTrajectory, out;

  const LateralGain graded = error_at(at(trajectory, *here), ego);
  out.cross_track_m = graded[0];
  out.heading_error_rad = graded[2];

  const double ahead_m = params.lookahead_base_m + params.lookahead_per_speed_s * ego.vx_mps;
  const LateralGain e = error_at(at(trajectory, *here + std::max(ahead_m, 0.0)), ego);
  out.e1_m = e[0];
  out.e2_rad = e[2];
  const std::size_t bracket = bracket_of(ego.vx_mps);
  out.bracket = static_cast<std::uint8_t>(bracket);
  const LateralGain& k = gains.k[bracket];
  const double raw = -(k[0] * e[0] + k[1] * e[1] + k[2] * e[2] + k[3] * e[3]);
  if (!std::isfinite(raw)) return out.verdict = LateralVerdict::kNoTrajectory, out;
  const double max_rad = angle_max_rad(params, angles);
  out.angle_rad = std::clamp(raw, -max_rad, max_rad);
  out.saturated = out.angle_rad != raw;
  out.verdict = std::abs(out.cross_track_m) <= params.deviation_max_m ? LateralVerdict::kGood
                                                                      : LateralVerdict::kTooFar;
  return out;
}

}  // namespace pitwall::control
