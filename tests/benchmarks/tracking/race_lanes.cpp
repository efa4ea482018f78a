// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/tracking/race_lanes.hpp"

#include <cmath>

namespace pitwall::tracking_bench {
namespace {

constexpr double kStep_m = 2.0, kWindow_m = 80.0;
constexpr int kPasses = 3;                           // of a moving mean
constexpr double kLength_m = 4.92, kWidth_m = 1.89;  // of a car

std::vector<double> smoothed(const std::vector<double>& in, int half) {
  const auto n = static_cast<int>(in.size());
  std::vector<double> out(in.size());
  for (int i = 0; i < n; ++i) {
    double sum = 0.0;
    for (int k = -half; k <= half; ++k) sum += in[static_cast<std::size_t>((i + k + n) % n)];
    out[static_cast<std::size_t>(i)] = sum / (2 * half + 1);
  }
  return out;
}

}  // namespace

RaceLanes::RaceLanes(const world::TrackMap& track) : track_(&track) {
  const auto n = static_cast<std::size_t>(std::ceil(track.length_m() / kStep_m));
  step_m_ = track.length_m() / static_cast<double>(n);
  for (std::size_t i = 0; i < n; ++i) {
    const world::TrackPoint p = track.at(static_cast<double>(i) * step_m_);
    offset_m_.push_back(0.5 * (p.width_left_m - p.width_right_m));
  }
  const int half = static_cast<int>(std::lround(0.5 * kWindow_m / step_m_));
  for (int pass = 0; pass < kPasses; ++pass) offset_m_ = smoothed(offset_m_, half);
}

RaceLanes::Middle RaceLanes::middle(double s_m) const {
  const double place = track_->wrap_station(s_m) / step_m_;
  const auto i = static_cast<std::size_t>(place) % offset_m_.size();
  const double a = offset_m_[i], b = offset_m_[(i + 1) % offset_m_.size()];
  return {a + (b - a) * (place - std::floor(place)), (b - a) / step_m_};
}

// Of a car whose speed over ground is motion.speed_mps.
RaceLanes::Rates RaceLanes::rates(const Motion& motion, const world::TrackPoint& at,
                                  const Middle& middle) const {
  const double stretch = 1.0 - at.curvature_per_m * (middle.offset_m + motion.lane_m);
  Rates r;
  r.across_mps = middle.slope * motion.speed_mps / stretch + motion.lane_rate_mps;
  r.along_mps =
      std::sqrt(std::max(0.0, motion.speed_mps * motion.speed_mps - r.across_mps * r.across_mps));
  r.station_mps = r.along_mps / stretch;
  return r;
}

plant::CarPose RaceLanes::placed(const Motion& motion) const {
  const Middle mid = middle(motion.s_m);
  const world::TrackPoint at = track_->at(motion.s_m);
  const world::TrackPoint p = track_->offset(motion.s_m, mid.offset_m + motion.lane_m);
  const Rates r = rates(motion, at, mid);
  plant::CarPose car;
  car.x_m = p.x_m, car.y_m = p.y_m;
  car.yaw_rad = wrap_pi(at.yaw_rad + std::atan2(r.across_mps, r.along_mps));
  car.vx_mps = motion.speed_mps, car.vy_mps = 0.0;
  car.length_m = kLength_m, car.width_m = kWidth_m;
  return car;
}

void RaceLanes::advance(Motion& motion, double dt_s) const {
  motion.s_m += dt_s * rates(motion, track_->at(motion.s_m), middle(motion.s_m)).station_mps;
  motion.speed_mps += dt_s * motion.accel_mps2;
}

}  // namespace pitwall::tracking_bench
