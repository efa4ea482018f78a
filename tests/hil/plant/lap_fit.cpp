// SPDX-License-Identifier: Apache-2.0
#include "tests/hil/plant/lap_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::plant {
namespace {

using plant::SingleTrackParams;
using plant::SingleTrackState;
using Vector = Eigen::Vector4d;

constexpr double kSubstep_s = 0.01;  // the longest that the single track takes
constexpr int kRounds = 6;
constexpr std::size_t kLeastSamples = 100;
// Changes that move the yaw rate by something between rounding and bend.
const Vector kNudge{1e-4, 1e-3, 4e-3, 1e-5};

Vector vector_of(const SteeringFit& f) {
  return {f.offset_rad, f.ratio, f.delay_s, f.understeer_rad_per_mps2};
}

SteeringFit fit_of(const Vector& v) {
  return {.offset_rad = v[0], .ratio = v[1], .delay_s = v[2], .understeer_rad_per_mps2 = v[3]};
}

// understeer = (1 / front - 1 / rear) / g with stiffness per load: the front axle takes it.
SingleTrackParams with_understeer(SingleTrackParams car, double understeer_rad_per_mps2) {
  const double rear = 1.0 / (car.friction * car.rear_stiffness_per_rad);
  constexpr double kStiffest = 1e-3;  // rad per load: beyond any tyre
  const double front = std::max(kStiffest, rear + car.gravity_mps2 * understeer_rad_per_mps2);
  car.front_stiffness_per_rad = 1.0 / (car.friction * front);
  return car;
}

std::vector<std::size_t> counted(const Drive& drive, Window window) {
  CHECK(window.last <= drive.samples.size());
  std::vector<std::size_t> rows;
  for (std::size_t i = window.first; i < window.last; ++i)
    if (drive.samples[i].speed_mps > kFitFrom_mps) rows.push_back(i);
  return rows;
}

double squared_error(const Drive& drive, const std::vector<std::size_t>& rows,
                     std::span<const double> modelled) {
  double sum = 0.0;
  for (const std::size_t i : rows)
    sum += std::pow(modelled[i] - drive.samples[i].yaw_rate_rad_per_s, 2);
  return sum;
}

struct Normal {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  Vector right = Vector::Zero();
};

// Of the errors, linear in the four numbers measured in nudges.
Normal normal_equations(const Drive& drive, const std::vector<std::size_t>& rows,
                        const SingleTrackParams& car, const Vector& at,
                        const std::vector<double>& modelled) {
  std::array<std::vector<double>, 4> moved;
  for (int k = 0; k < 4; ++k) {
    Vector near = at;
    near[k] += kNudge[k];
    moved[static_cast<std::size_t>(k)] = yaw_rates(drive, car, fit_of(near));
  }
  Normal normal;
  for (const std::size_t i : rows) {
    Vector slope;
    for (int k = 0; k < 4; ++k) slope[k] = moved[static_cast<std::size_t>(k)][i] - modelled[i];
    normal.matrix += slope * slope.transpose();
    normal.right += slope * (drive.samples[i].yaw_rate_rad_per_s - modelled[i]);
  }
  return normal;
}

double interpolated(double a, double b, double t) { return a + t * (b - a); }

}  // namespace

double arrived_rad(const Drive& drive, const SteeringFit& fit, double time_s) {
  const double last = static_cast<double>(drive.samples.size() - 1);
  const double at = std::clamp((time_s - fit.delay_s) / drive.period_s, 0.0, last);
  const auto i = static_cast<std::size_t>(std::min(at, last - 1.0));
  const double recorded_rad = interpolated(
      drive.samples[i].wheel_rad, drive.samples[i + 1].wheel_rad, at - static_cast<double>(i));
  return fit.ratio * recorded_rad + fit.offset_rad;
}

std::vector<double> yaw_rates(const Drive& drive, const SingleTrackParams& car,
                              const SteeringFit& fit) {
  const SingleTrackParams fitted_car = with_understeer(car, fit.understeer_rad_per_mps2);
  const auto substeps = static_cast<int>(std::ceil(drive.period_s / kSubstep_s - 1e-9));
  const double dt_s = drive.period_s / substeps;
  SingleTrackState s;
  std::vector<double> rates;
  rates.reserve(drive.samples.size());
  for (std::size_t i = 0; i < drive.samples.size(); ++i) {
    rates.push_back(s.yaw_rate_rad_per_s);
    const double from_mps = drive.samples[i].speed_mps;
    const double to_mps = drive.samples[std::min(i + 1, drive.samples.size() - 1)].speed_mps;
    for (int k = 0; k < substeps; ++k) {
      const double share = (k + 0.5) / substeps;
      const double time_s = (static_cast<double>(i) + share) * drive.period_s;
      s.angle_rad = arrived_rad(drive, fit, time_s);
      s.speed_mps = interpolated(from_mps, to_mps, share);
      s = plant::blended_step(fitted_car, s, {}, dt_s);
    }
  }
  return rates;
}

double explained(const Drive& drive, Window window, std::span<const double> modelled_rad_per_s) {
  const std::vector<std::size_t> rows = counted(drive, window);
  double mean = 0.0, variance = 0.0;
  for (const std::size_t i : rows) mean += drive.samples[i].yaw_rate_rad_per_s;
  mean /= static_cast<double>(rows.size());
  for (const std::size_t i : rows)
    variance += std::pow(drive.samples[i].yaw_rate_rad_per_s - mean, 2);
  return 1.0 - squared_error(drive, rows, modelled_rad_per_s) / variance;
}

Result<SteeringFit, Problem> fitted(const Drive& drive, Window window,
                                    const plant::SingleTrackParams& car, const SteeringFit& start) {
  const std::vector<std::size_t> rows = counted(drive, window);
  if (rows.size() < kLeastSamples)
    return Unexpected{
        Problem{"drive", "only " + std::to_string(rows.size()) + " samples are fast"}};
  Vector at = vector_of(start);
  std::vector<double> modelled = yaw_rates(drive, car, start);
  double error = squared_error(drive, rows, modelled);
  double damping = 1e-3;
  for (int round = 0; round < kRounds; ++round) {
    const Normal normal = normal_equations(drive, rows, car, at, modelled);
    if (!(normal.matrix.diagonal().minCoeff() > 0.0))
      return Unexpected{Problem{"drive", "does not tell the numbers of a fit apart"}};
    Eigen::Matrix4d damped = normal.matrix;
    damped.diagonal() *= 1.0 + damping;
    const Vector nudges = damped.ldlt().solve(normal.right);
    const Vector next = at + nudges.cwiseProduct(kNudge);
    std::vector<double> next_modelled = yaw_rates(drive, car, fit_of(next));
    const double next_error = squared_error(drive, rows, next_modelled);
    const bool better = next_error < error;
    damping *= better ? 0.1 : 30.0;
    if (!better) continue;
    at = next;
    modelled = std::move(next_modelled);
    error = next_error;
  }
  return fit_of(at);
}

double understeer_of(const plant::SingleTrackParams& car) {
  return (1.0 / car.front_stiffness_per_rad - 1.0 / car.rear_stiffness_per_rad) /
         (car.friction * car.gravity_mps2);
}

}  // namespace pitwall::plant
