// SPDX-License-Identifier: Apache-2.0
#include "vehicle/steering/learned_steering.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::steering {
namespace {

constexpr double kLearnFrom_mps = 15.0;  // below, a yaw rate over a speed says little
constexpr double kCorrelation_s = 0.5;   // of the residual
constexpr double kLagDoubt_s = 0.1;  // a lag is not all that there is between angle and yaw rate
constexpr double kSurely = 2.0;      // deviations
// No further than cars corner: a cubic that falls has no inverse.
constexpr double kBendsTo_mps2 = 18.0;
// Beyond, it is no car.
constexpr double kLateralMost_mps2 = 60.0, kTurningMost_rad_per_s = 10.0;

using Numbers = std::array<double, kLearnedNumbers>;

// How far a car changes within a minute: tyres that warm and wear, fuel that burns.
constexpr double kDriftOver_s = 60.0;
constexpr Numbers kDrift{0.0005, 0.0001, 4e-7, 0.01};
constexpr Numbers kLeast{-0.01, -0.0008, -1e-6, -0.12}, kMost{0.01, 0.003, 1e-5, 0.12};
constexpr double kLagMost_s = 0.1;  // beside that of the parameters, until it is known

double square(double x) { return x * x; }
double bends(double lateral_mps2) {
  return square(std::min(std::abs(lateral_mps2), kBendsTo_mps2));
}

using Covariance = decltype(Learned::covariance);

constexpr std::size_t place_of(std::size_t i, std::size_t j) {
  const std::size_t row = i < j ? i : j, column = i < j ? j : i;
  return row * kLearnedNumbers - row * (row + 1) / 2 + column;
}

Covariance unknown(const LearningParams& p, const Bicycle& car) {
  constexpr double kAtLeast = 1e-5;
  const double gradient = p.understeer_most_rad_per_mps2 - car.understeer_rad_per_mps2;
  const Numbers most{p.offset_most_rad, std::max(gradient, kAtLeast), p.bend_most_rad_s6_per_m3,
                     kLagMost_s};
  Covariance covariance{};
  for (std::size_t i = 0; i < most.size(); ++i)
    covariance[place_of(i, i)] = square(most[i] / kSurely);
  return covariance;
}

bool is_begun(const Learned& learned) { return std::isfinite(learned.covariance[0]); }

Numbers product(const Covariance& p, const Numbers& h) {
  Numbers out{};
  for (std::size_t i = 0; i < h.size(); ++i)
    for (std::size_t j = 0; j < h.size(); ++j) out[i] += p[place_of(i, j)] * h[j];
  return out;
}

double product(const Numbers& a, const Numbers& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// What was learned, corrected by what one tick showed: h of it, with a noise.
void correct(Learned& learned, const Numbers& h, double residual_rad, double variance) {
  Covariance& p = learned.covariance;
  const Numbers ph = product(p, h);
  const double innovation = product(h, ph) + variance;
  const std::array numbers{&learned.offset_rad, &learned.understeer_rad_per_mps2,
                           &learned.bend_rad_s6_per_m3, &learned.lag_s};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    *numbers[i] = std::clamp(*numbers[i] + ph[i] / innovation * residual_rad, kLeast[i], kMost[i]);
    for (std::size_t j = i; j < numbers.size(); ++j)
      p[place_of(i, j)] -= ph[i] * ph[j] / innovation;
    p[place_of(i, i)] = std::max(p[place_of(i, i)], 0.0);
  }
}

// Of the rear axle's slip gradient [rad/(m/s^2)].
constexpr double kSlipLeast = -0.0014, kSlipMost = 0.004;
constexpr double kSlipSigma = 0.0008;     // of any car, before something is learned
constexpr double kSlipDrift = 0.0002;     // within kDriftOver_s
constexpr double kSlipNoise_rad = 0.004;  // of a slip angle by localization

void learn_rear_slip(const Bicycle& car, Learned& learned, const Turning& at, double dt_s) {
  const double a_mps2 = lateral_mps2(at);
  const double slip_rad = (car.cg_to_rear_m * at.yaw_rate_rad_per_s - at.slip_mps) / at.speed_mps;
  const double missing_rad =
      slip_rad - (car.rear_slip_rad_per_mps2 + learned.rear_slip_rad_per_mps2) * a_mps2;
  if (!std::isfinite(missing_rad)) return;
  double& variance = learned.rear_slip_variance;
  if (!std::isfinite(variance)) variance = square(kSlipSigma);
  variance += square(kSlipDrift) / kDriftOver_s * dt_s;
  const double gain = variance * a_mps2 /
                      (variance * square(a_mps2) + square(kSlipNoise_rad) * kCorrelation_s / dt_s);
  learned.rear_slip_rad_per_mps2 =
      std::clamp(learned.rear_slip_rad_per_mps2 + gain * missing_rad, kSlipLeast, kSlipMost);
  variance = std::max(variance * (1.0 - gain * a_mps2), 0.0);
}

}  // namespace

double lateral_mps2(const Turning& at) {
  return at.speed_mps * at.yaw_rate_rad_per_s - kGravity_mps2 * std::sin(at.bank_rad);
}

double understeer_at(const Bicycle& car, const Learned& learned, double lateral_mps2) {
  return car.understeer_rad_per_mps2 + learned.understeer_rad_per_mps2 +
         learned.bend_rad_s6_per_m3 * bends(lateral_mps2);
}

double angle_rad(const Bicycle& car, const Learned& learned, double curvature_per_m,
                 double lateral_mps2) {
  return car.wheelbase_m * curvature_per_m + learned.offset_rad +
         understeer_at(car, learned, lateral_mps2) * lateral_mps2;
}

double doubt_rad(const LearningParams& params, const Bicycle& car, const Learned& learned,
                 double lateral_mps2) {
  const Numbers h{0.0, lateral_mps2, lateral_mps2 * bends(lateral_mps2), 0.0};
  const Covariance& p = is_begun(learned) ? learned.covariance : unknown(params, car);
  return kSurely * std::sqrt(std::max(product(h, product(p, h)), 0.0));
}

double angle_rad(const Bicycle& car, const Learned& learned, const RoadLoad& at) {
  return angle_rad(car, learned, turn_per_m(at), lateral_demand_mps2(at));
}

double residual_rad(const Bicycle& car, const Learned& learned, const Turning& at) {
  return turned_rad(learned) -
         angle_rad(car, learned, at.yaw_rate_rad_per_s / at.speed_mps, lateral_mps2(at));
}

double slip_rad(const Bicycle& car, const Learned& learned, const RoadLoad& at) {
  return car.cg_to_rear_m * turn_per_m(at) -
         (car.rear_slip_rad_per_mps2 + learned.rear_slip_rad_per_mps2) * lateral_demand_mps2(at);
}

double yaw_rate_rad_per_s(const Bicycle& car, const Learned& learned, double angle_rad,
                          double speed_mps, double bank_rad) {
  constexpr double kTightest_per_m = 0.2, kFarthest_mps2 = 500.0;
  constexpr int kRounds = 45;
  if (!std::isfinite(angle_rad) || !std::isfinite(speed_mps)) return kUnset;
  const double fall_mps2 = kGravity_mps2 * std::sin(bank_rad);
  const double tightest_per_m = std::min(kTightest_per_m, kFarthest_mps2 / (speed_mps * speed_mps));
  double low_per_m = -tightest_per_m, high_per_m = tightest_per_m;
  for (int i = 0; i < kRounds; ++i) {
    const double middle_per_m = 0.5 * (low_per_m + high_per_m);
    const double lateral = speed_mps * speed_mps * middle_per_m - fall_mps2;
    const bool more = steering::angle_rad(car, learned, middle_per_m, lateral) < angle_rad;
    (more ? low_per_m : high_per_m) = middle_per_m;
  }
  return speed_mps * 0.5 * (low_per_m + high_per_m);
}

void follow_command(const LearningParams& params, Learned& learned, double commanded_rad,
                    Duration dt) {
  if (!std::isfinite(commanded_rad)) return;
  learned.turning_rad_per_s = (commanded_rad - learned.commanded_rad) / params.lag_s;
  learned.commanded_rad +=
      (1.0 - std::exp(-tick_s(dt) / params.lag_s)) * (commanded_rad - learned.commanded_rad);
}

void learn(const LearningParams& params, const Bicycle& car, Learned& learned, const Turning& at,
           Duration dt) {
  const double dt_s = tick_s(dt);
  learned.innovation_rad = learned.innovation_sigma_rad = kUnset;
  if (!(at.speed_mps > kLearnFrom_mps && dt_s > 0.0)) return;
  const double a_mps2 = lateral_mps2(at);
  const double missing_rad = residual_rad(car, learned, at);
  if (!std::isfinite(missing_rad) || !(std::abs(a_mps2) < kLateralMost_mps2) ||
      !(std::abs(learned.turning_rad_per_s) < kTurningMost_rad_per_s))
    return;
  if (!is_begun(learned)) learned.covariance = unknown(params, car);
  for (std::size_t i = 0; i < kDrift.size(); ++i)
    learned.covariance[place_of(i, i)] += square(kDrift[i]) / kDriftOver_s * dt_s;
  const double turning = learned.turning_rad_per_s;
  const double variance =
      (square(params.residual_sigma_rad) + square(kLagDoubt_s * turning)) * kCorrelation_s / dt_s;
  const Numbers h{1.0, a_mps2, a_mps2 * bends(a_mps2), turning};
  learned.innovation_rad = missing_rad;
  learned.innovation_sigma_rad =
      std::sqrt(std::max(product(h, product(learned.covariance, h)), 0.0) +
                square(params.residual_sigma_rad) + square(kLagDoubt_s * turning));
  correct(learned, h, missing_rad, variance);
  learn_rear_slip(car, learned, at, dt_s);
}

}  // namespace pitwall::steering
