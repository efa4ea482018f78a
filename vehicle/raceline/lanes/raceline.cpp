// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/lanes/raceline.hpp"

#include <cmath>

namespace pitwall::raceline {
namespace {

constexpr int kStartSteps = 20;
constexpr double kStartSettled_m = 1e-6;

double wrapped(double s_m, double length_m) { return s_m - length_m * std::floor(s_m / length_m); }

// Arc length of the spline beside station 0.
double start_of(const SpiroSpline& spline, const world::TrackMap& track) {
  double s_m = 0.0;
  for (int step = 0; step < kStartSteps; ++step) {
    const SplinePoint p = spline.at(s_m);
    const double past_m = std::remainder(track.project(p.x_m, p.y_m).s_m, track.length_m());
    s_m = wrapped(s_m - past_m, spline.length_m());
    if (std::abs(past_m) < kStartSettled_m) break;
  }
  return s_m;
}

}  // namespace

Raceline sample_raceline(const SpiroSpline& spline, const world::TrackMap& track, double step_m) {
  Raceline line;
  line.length_m = spline.length_m();
  const double start_m = start_of(spline, track);
  const auto count = static_cast<std::size_t>(std::ceil(line.length_m / step_m));
  line.points.reserve(count);
  double station_m = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double along_m = line.length_m * static_cast<double>(i) / static_cast<double>(count);
    const SplinePoint p = spline.at(wrapped(start_m + along_m, line.length_m));
    station_m = track.project(p.x_m, p.y_m, station_m).s_m;
    line.points.push_back({.x_m = p.x_m,
                           .y_m = p.y_m,
                           .yaw_rad = p.yaw_rad,
                           .curvature_per_m = p.curvature_per_m,
                           .bank_rad = track.at(station_m).bank_rad});
  }
  return line;
}

}  // namespace pitwall::raceline
