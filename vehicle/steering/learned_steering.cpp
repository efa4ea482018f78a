// SPDX-License-Identifier: Apache-2.0
#include "vehicle/steering/learned_steering.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::steering {
namespace {

constexpr double kLearnFrom_mps = 15.0;  // below, a yaw rate over a speed says little
constexpr double kConstant = 0.5;        // weight of the constant angle beside the gradient
constexpr double kLateralScale_mps2 = 6.0;
constexpr double kEasy = 0.25;  // regularisation: on a straight little is learned
constexpr double kAverages_s = 6.0, kSlowest_s = 15.0;
constexpr double kTurns_mps2 = 3.0;  // lateral, to learn a gradient from
constexpr double kOffsetMax_rad = 0.01, kUndersteerMax = 0.003, kUndersteerMin = -0.0008;

double tick_s(Duration dt) { return std::clamp(dt.seconds(), 0.0, kTickMax_s); }

}  // namespace

double lateral_mps2(const Turning& at) {
  return at.speed_mps * at.yaw_rate_rad_per_s - kGravity_mps2 * std::sin(at.bank_rad);
}

double angle_rad(const Bicycle& car, const Learned& learned, double curvature_per_m,
                 double lateral_mps2) {
  return car.wheelbase_m * curvature_per_m + learned.offset_rad +
         (car.understeer_rad_per_mps2 + learned.understeer_rad_per_mps2) * lateral_mps2;
}

double angle_rad(const Bicycle& car, const Learned& learned, const RoadLoad& at) {
  return angle_rad(car, learned, turn_per_m(at), lateral_demand_mps2(at));
}

double understeer_to_expect(const LearningParams& params, const Bicycle& car,
                            const Learned& learned) {
  const double seen = car.understeer_rad_per_mps2 + learned.understeer_rad_per_mps2;
  const double unknown = std::exp(-0.5 * learned.turned_s / params.learn_s);
  return seen + unknown * std::max(params.understeer_most_rad_per_mps2 - seen, 0.0);
}

double yaw_rate_rad_per_s(const Bicycle& car, const Learned& learned, double angle_rad,
                          double speed_mps, double bank_rad) {
  const double gradient = car.understeer_rad_per_mps2 + learned.understeer_rad_per_mps2;
  const double fall_mps2 = kGravity_mps2 * std::sin(bank_rad);
  return speed_mps * (angle_rad - learned.offset_rad + gradient * fall_mps2) /
         (car.wheelbase_m + gradient * speed_mps * speed_mps);
}

void follow_command(const LearningParams& params, Learned& learned, double commanded_rad,
                    Duration dt) {
  if (!std::isfinite(commanded_rad)) return;
  learned.commanded_rad +=
      (1.0 - std::exp(-tick_s(dt) / params.lag_s)) * (commanded_rad - learned.commanded_rad);
}

void learn(const LearningParams& params, const Bicycle& car, Learned& learned, const Turning& at,
           Duration dt) {
  if (!(at.speed_mps > kLearnFrom_mps)) return;
  const double a_mps2 = lateral_mps2(at);
  const double residual_rad =
      learned.commanded_rad - angle_rad(car, learned, at.yaw_rate_rad_per_s / at.speed_mps, a_mps2);
  if (!std::isfinite(residual_rad)) return;
  if (std::abs(a_mps2) > kTurns_mps2) learned.turned_s += tick_s(dt);
  const double time_s =
      std::min(params.learn_s * (1.0 + learned.turned_s / kAverages_s), kSlowest_s);
  const double slope = a_mps2 / kLateralScale_mps2;
  const double step =
      residual_rad / (kConstant * kConstant + slope * slope + kEasy) * tick_s(dt) / time_s;
  learned.offset_rad =
      std::clamp(learned.offset_rad + kConstant * step, -kOffsetMax_rad, kOffsetMax_rad);
  learned.understeer_rad_per_mps2 =
      std::clamp(learned.understeer_rad_per_mps2 + slope / kLateralScale_mps2 * step,
                 kUndersteerMin, kUndersteerMax);
}

}  // namespace pitwall::steering
