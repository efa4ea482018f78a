// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/profile/lap_gradient.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pitwall::raceline {
namespace {

// Of the differences that stand for derivatives.
constexpr double kSpeedStep_mps = 1e-4, kCurvatureStep_per_m = 1e-7;

enum class Bound : std::uint8_t { kCorner, kDrive, kBrake };

// The speed one step on, by the drive, or one step before, by the brakes.
struct Reached {
  double mps, by_speed, by_curvature, by_step;
};

class Adjoint {
 public:
  Adjoint(std::span<const RoadStep> road, std::span<const LapPoint> lap,
          const envelope::EnvelopeTable& table)
      : road_(road), lap_(lap), table_(table), n_(road.size()), slope_(n_), by_speed_(n_) {}

  std::vector<LapSlope> run() {
    std::vector<Bound> bounds(n_);
    std::size_t corner = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      bounds[i] = bound_of(i);
      if (bounds[i] == Bound::kCorner) corner = i;
      const double sum = v(i) + v(i + 1), h = road_[i].step_m;
      slope_[i].by_step_s_per_m += 2.0 / sum;
      by_speed_[i] -= 2.0 * h / (sum * sum);
      by_speed_[(i + 1) % n_] -= 2.0 * h / (sum * sum);
    }
    for (std::size_t k = n_; k > 0; --k)  // what the drive hands on comes from the point before
      if (const std::size_t i = (corner + k) % n_; bounds[i] == Bound::kDrive) follow_drive(i);
    for (std::size_t k = 0; k < n_; ++k)  // and the brakes serve the point after
      if (const std::size_t i = (corner + k) % n_; bounds[i] == Bound::kBrake) follow_brake(i);
    for (std::size_t i = 0; i < n_; ++i)
      if (bounds[i] == Bound::kCorner) slope_[i].by_curvature_s_m += by_speed_[i] * corner_slope(i);
    return slope_;
  }

 private:
  double v(std::size_t i) const { return lap_[i % n_].speed_mps; }
  std::size_t before(std::size_t i) const { return (i + n_ - 1) % n_; }

  double corner_mps(std::size_t i, double more_per_m = 0.0) const {
    const double corner = table_.corner_speed_mps(
        table_.place(road_[i].curvature_per_m + more_per_m, road_[i].bank_rad));
    return std::min(corner, road_[i].cap_mps);
  }
  double corner_slope(std::size_t i) const {
    return (corner_mps(i, kCurvatureStep_per_m) - corner_mps(i, -kCurvatureStep_per_m)) /
           (2.0 * kCurvatureStep_per_m);
  }

  double accel(std::size_t i, double speed, double curvature) const {
    return table_.longitudinal(table_.place(curvature, road_[i].bank_rad), speed).accel_mps2;
  }
  double brake(std::size_t i, double speed, double curvature) const {
    return table_.longitudinal(table_.place(curvature, road_[i].bank_rad), speed).brake_mps2;
  }
  // By the limit `a` of a point, over a step.
  template <class Limit>
  Reached reached(Limit&& a, std::size_t at, double step_m) const {
    const double speed = v(at), k = road_[at].curvature_per_m, here = a(at, speed, k);
    const double by_speed = (a(at, speed + kSpeedStep_mps, k) - a(at, speed - kSpeedStep_mps, k)) /
                            (2.0 * kSpeedStep_mps);
    const double by_curvature =
        (a(at, speed, k + kCurvatureStep_per_m) - a(at, speed, k - kCurvatureStep_per_m)) /
        (2.0 * kCurvatureStep_per_m);
    const double to = std::sqrt(std::max(speed * speed + 2.0 * step_m * here, 1.0));
    Reached r{to, (speed + step_m * by_speed) / to, step_m * by_curvature / to, here / to};
    if (r.by_speed < 0.0) {
      // At the edge of the ellipse a little more speed leaves so much less drive that steps of this
      // length swing about the balance. The slopes are those of the balance.
      r.by_curvature /= 1.0 - r.by_speed, r.by_step /= 1.0 - r.by_speed;
      r.by_speed = 0.0;
    }
    return r;
  }
  Reached driven(std::size_t i) const {
    return reached([this](auto... x) { return accel(x...); }, before(i), road_[before(i)].step_m);
  }
  Reached braked(std::size_t i) const {
    return reached([this](auto... x) { return brake(x...); }, (i + 1) % n_, road_[i].step_m);
  }

  Bound bound_of(std::size_t i) const {
    const double corner = std::abs(corner_mps(i) - v(i)), drive = std::abs(driven(i).mps - v(i)),
                 brake = std::abs(braked(i).mps - v(i));
    if (corner <= drive && corner <= brake) return Bound::kCorner;
    return drive <= brake ? Bound::kDrive : Bound::kBrake;
  }

  void follow_drive(std::size_t i) {
    const Reached r = driven(i);
    by_speed_[before(i)] += by_speed_[i] * r.by_speed;
    slope_[before(i)].by_curvature_s_m += by_speed_[i] * r.by_curvature;
    slope_[before(i)].by_step_s_per_m += by_speed_[i] * r.by_step;
  }
  void follow_brake(std::size_t i) {
    const Reached r = braked(i);
    const std::size_t after = (i + 1) % n_;
    by_speed_[after] += by_speed_[i] * r.by_speed;
    slope_[after].by_curvature_s_m += by_speed_[i] * r.by_curvature;
    slope_[i].by_step_s_per_m += by_speed_[i] * r.by_step;
  }

  std::span<const RoadStep> road_;
  std::span<const LapPoint> lap_;
  const envelope::EnvelopeTable& table_;
  std::size_t n_;
  std::vector<LapSlope> slope_;
  std::vector<double> by_speed_;
};

}  // namespace

std::vector<LapSlope> lap_gradient(std::span<const RoadStep> road, std::span<const LapPoint> lap,
                                   const envelope::EnvelopeTable& table) {
  return Adjoint{road, lap, table}.run();
}

}  // namespace pitwall::raceline
