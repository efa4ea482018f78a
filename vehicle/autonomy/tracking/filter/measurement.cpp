// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/measurement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "vehicle/autonomy/tracking/filter/cholesky.hpp"
#include "vehicle/autonomy/tracking/filter/modes.hpp"

namespace pitwall::tracking {
namespace {

using world::DetectionSource;

constexpr double kSightMin_m = 0.5;  // closer than a car can be; keeps the models finite

using Square = std::array<Values, kValuesMax>;

// Of S + R.
Square factor_of(const Spread& spread, const Innovation& in) {
  return factor<kValuesMax>(in.size, [&](std::size_t i, std::size_t j) {
    return spread[i][j] + (i == j ? in.variance[i] : 0.0);
  });
}

struct Sight {
  double dx_m, dy_m, distance_m;
};

Sight sight_of(const OwnMotion& own, const Place& p) {
  const double dx_m = p.x_m - own.x_m, dy_m = p.y_m - own.y_m;
  return {dx_m, dy_m, std::max(std::hypot(dx_m, dy_m), kSightMin_m)};
}

// Gradients by x, y, yaw and speed in Map.
using Gradient = std::array<double, 4>;

struct Seen {
  double value = 0.0;
  Gradient by{};
};

Seen bearing_of(const OwnMotion& own, const Sight& s) {
  const double square_m2 = s.distance_m * s.distance_m;
  return {full_turn(std::atan2(s.dy_m, s.dx_m) - own.yaw_rad),
          {-s.dy_m / square_m2, s.dx_m / square_m2, 0.0, 0.0}};
}

Seen range_of(const Sight& s) {
  return {s.distance_m, {s.dx_m / s.distance_m, s.dy_m / s.distance_m, 0.0, 0.0}};
}

Seen inverse_depth_of(const Sight& s) {
  const double cube_m3 = s.distance_m * s.distance_m * s.distance_m;
  return {1.0 / s.distance_m, {-s.dx_m / cube_m3, -s.dy_m / cube_m3, 0.0, 0.0}};
}

// d/dt of the distance: the relative velocity along the line of sight.
Seen range_rate_of(const OwnMotion& own, const Place& p, const Sight& s) {
  const double cos_yaw = std::cos(p.yaw_rad), sin_yaw = std::sin(p.yaw_rad);
  const double ux = s.dx_m / s.distance_m, uy = s.dy_m / s.distance_m;
  const double wx_mps = p.speed_mps * cos_yaw - own.vx_mps;
  const double wy_mps = p.speed_mps * sin_yaw - own.vy_mps;
  const double rate_mps = ux * wx_mps + uy * wy_mps;
  return {rate_mps,
          {(wx_mps - rate_mps * ux) / s.distance_m, (wy_mps - rate_mps * uy) / s.distance_m,
           p.speed_mps * (uy * cos_yaw - ux * sin_yaw), ux * cos_yaw + uy * sin_yaw}};
}

Gradient by_states(const Gradient& g, const Place& p) {
  Gradient out{};
  for (std::size_t k = 0; k < g.size(); ++k)
    for (std::size_t j = 0; j < out.size(); ++j) out[j] += g[k] * p.jacobian[k][j];
  return out;
}

void set(Expectation& e, std::size_t i, const Seen& seen, const Place& p) {
  e.value[i] = seen.value;
  e.jacobian[i] = by_states(seen.by, p);
}

double square(double v) { return v * v; }

double half_turn(double angle_rad) {
  constexpr double kHalf_rad = 0.5 * std::numbers::pi;
  return std::abs(angle_rad) <= kHalf_rad ? angle_rad : std::remainder(angle_rad, std::numbers::pi);
}

Innovation lidar_reading(const RoadParams& params, const OwnMotion& own, const Measurement& m) {
  const Position at = position_of(DetectionSource::kLidar, own, m);
  const double distance_m = std::hypot(m.value[0], m.value[1]);
  const double variance = square(lidar_sigma_m(params, distance_m));
  const bool yaw = std::isfinite(m.value[2]);
  return {.size = yaw ? 3U : 2U,
          .value = {at.x_m, at.y_m, yaw ? own.yaw_rad + m.value[2] : 0.0},
          .variance = {variance, variance, square(params.lidar_yaw_sigma_rad)}};
}

// How well a mode expected a detection.
struct Fit {
  double square = 0.0;  // Mahalanobis distance
  double det = 1.0;     // of the covariance of the innovation
};

// Value by value: their noise is independent. `x` is relative to the states of the expectation.
Fit update_mode(const Expectation& e, const Innovation& in, RoadVector& x, RoadMatrix& p) {
  Fit fit;
  for (std::size_t k = 0; k < in.size; ++k) {
    const auto& h = e.jacobian[k];
    RoadVector ph{};
    double rest = in.value[k], variance = in.variance[k];
    for (std::size_t j = 0; j < h.size(); ++j) {
      for (std::size_t i = 0; i < kRoadStates; ++i) ph[i] += h[j] * p[j][i];
      rest -= h[j] * x[j];
    }
    for (std::size_t j = 0; j < h.size(); ++j) variance += h[j] * ph[j];
    const double share = 1.0 / variance;
    fit.square += rest * rest * share, fit.det *= variance;
    for (std::size_t i = 0; i < kRoadStates; ++i) {
      const double gain = share * ph[i];
      x[i] += gain * rest;
      for (std::size_t j = 0; j < kRoadStates; ++j) p[i][j] -= gain * ph[j];
    }
  }
  return fit;
}

// Bounded, so that no mode is ever ruled out.
double likelihood_ratio(const Fit& a, const Fit& b) {
  constexpr double kMost = 1e6;
  const double ratio = std::exp(0.5 * (b.square - a.square)) * std::sqrt(b.det / a.det);
  return std::clamp(ratio, 1.0 / kMost, kMost);
}

}  // namespace

Place place_of(const world::TrackMap* map, const StateVector& x) {
  Place p{.x_m = x[kAlong], .y_m = x[kAcross], .yaw_rad = x[kHeading], .speed_mps = x[kSpeed]};
  for (std::size_t i = 0; i < 4; ++i) p.jacobian[i][i] = 1.0;
  if (map == nullptr) return p;
  const world::TrackPoint line = map->at(x[kAlong]);
  const double cos_yaw = std::cos(line.yaw_rad), sin_yaw = std::sin(line.yaw_rad);
  const double left = 1.0 - line.curvature_per_m * x[kAcross];
  p.x_m = line.x_m - x[kAcross] * sin_yaw;
  p.y_m = line.y_m + x[kAcross] * cos_yaw;
  p.yaw_rad = full_turn(line.yaw_rad + x[kHeading]);
  p.curvature_per_m = line.curvature_per_m;
  p.jacobian[0] = {left * cos_yaw, -sin_yaw, 0.0, 0.0};
  p.jacobian[1] = {left * sin_yaw, cos_yaw, 0.0, 0.0};
  p.jacobian[2] = {line.curvature_per_m, 0.0, 1.0, 0.0};
  return p;
}

Expectation expectation_of(DetectionSource source, const OwnMotion& own, const Place& p) {
  Expectation e;
  switch (source) {
    case DetectionSource::kLidar:
      e.value = {p.x_m, p.y_m, p.yaw_rad};
      for (std::size_t i = 0; i < kValuesMax; ++i) e.jacobian[i] = p.jacobian[i];
      break;
    case DetectionSource::kCamera: {
      const Sight s = sight_of(own, p);
      set(e, 0, bearing_of(own, s), p);
      set(e, 1, inverse_depth_of(s), p);
      break;
    }
    case DetectionSource::kRadar: {
      const Sight s = sight_of(own, p);
      set(e, 0, range_of(s), p);
      set(e, 1, bearing_of(own, s), p);
      set(e, 2, range_rate_of(own, p, s), p);
      break;
    }
  }
  return e;
}

double way_m(const world::TrackMap* map, double from_m, double to_m) {
  return map == nullptr ? to_m - from_m : std::remainder(to_m - from_m, map->length_m());
}

Spread spread_of(const Expectation& e, std::size_t mode, const Modes& m) {
  Spread spread{};
  for (std::size_t i = 0; i < kValuesMax; ++i) {
    const auto& h = e.jacobian[i];
    Gradient row{};
    double apart = 0.0;
    for (std::size_t k = 0; k < h.size(); ++k) {
      apart += h[k] * m.apart[mode][k];
      for (std::size_t j = 0; j < row.size(); ++j) row[j] += h[k] * m.p[mode][k][j];
    }
    for (std::size_t j = 0; j < row.size(); ++j) row[j] += apart * m.apart[mode][j];
    for (std::size_t j = 0; j <= i; ++j) {
      for (std::size_t k = 0; k < row.size(); ++k) spread[i][j] += row[k] * e.jacobian[j][k];
      spread[j][i] = spread[i][j];
    }
  }
  return spread;
}

Innovation reading_of(const RoadParams& params, const FrameKey& sensor, const OwnMotion& own,
                      const Measurement& m) {
  switch (sensor.source) {
    case DetectionSource::kCamera: {
      const bool depth = std::isfinite(m.value[1]);
      const CameraSigma sigma =
          camera_sigma(params, sensor.unit, m, depth ? 1.0 / m.value[1] : kUnset);
      return {.size = depth ? 2U : 1U,
              .value = {m.value[0], depth ? m.value[1] : 0.0, 0.0},
              .variance = {square(sigma.bearing_rad), square(sigma.inverse_depth_per_m), 0.0}};
    }
    case DetectionSource::kRadar: {
      const bool rate = std::isfinite(m.value[2]);
      return {
          .size = rate ? 3U : 2U,
          .value = {m.value[0], m.value[1], rate ? m.value[2] : 0.0},
          .variance = {square(params.radar_range_sigma_m), square(params.radar_bearing_sigma_rad),
                       square(params.radar_rate_sigma_mps)}};
    }
    case DetectionSource::kLidar:
      break;
  }
  return lidar_reading(params, own, m);
}

Innovation innovation_of(DetectionSource source, const Innovation& reading, const Expectation& e) {
  Innovation in = reading;
  for (std::size_t i = 0; i < in.size; ++i) in.value[i] -= e.value[i];
  switch (source) {
    case DetectionSource::kCamera:
      in.value[0] = full_turn(in.value[0]);
      break;
    case DetectionSource::kRadar:
      in.value[1] = full_turn(in.value[1]);
      break;
    case DetectionSource::kLidar:
      in.value[2] = half_turn(in.value[2]);
      break;
  }
  return in;
}

Distance distance_of(const Spread& spread, const Innovation& in, double most) {
  for (std::size_t i = 0; i < in.size; ++i)
    if (!(square(in.value[i]) <= most * (spread[i][i] + in.variance[i])))
      return {.square = std::numeric_limits<double>::infinity()};
  const Square l = factor_of(spread, in);
  const Values y = solved(l, in.size, in.value);
  Distance d{.square = 0.0};
  double det = 1.0;
  for (std::size_t i = 0; i < in.size; ++i) d.square += y[i] * y[i], det *= l[i][i];
  d.log_det = 2.0 * std::log(det);
  return d;
}

void update(const Expectation& e, const Innovation& in, const world::TrackMap* map, Track& track) {
  Modes& m = track.modes;
  std::array<Fit, kModes> fit;
  for (std::size_t k = 0; k < kModes; ++k) fit[k] = update_mode(e, in, m.apart[k], m.p[k]);
  double sum = m.share[kSteady];
  for (std::size_t k = 1; k < kModes; ++k)
    sum += m.share[k] *= likelihood_ratio(fit[k], fit[kSteady]);
  for (double& share : m.share) share /= sum;
  centre_modes(track);
  track.x[kHeading] = full_turn(track.x[kHeading]);
  if (map != nullptr) track.x[kAlong] = map->wrap_station(track.x[kAlong]);
}

Position position_of(DetectionSource source, const OwnMotion& own, const Measurement& m) {
  double x_m = m.value[0], y_m = m.value[1];
  if (source != DetectionSource::kLidar) {
    const bool camera = source == DetectionSource::kCamera;
    const double distance_m = camera ? 1.0 / m.value[1] : m.value[0];
    const double bearing_rad = camera ? m.value[0] : m.value[1];
    x_m = distance_m * std::cos(bearing_rad), y_m = distance_m * std::sin(bearing_rad);
  }
  const double cos_yaw = std::cos(own.yaw_rad), sin_yaw = std::sin(own.yaw_rad);
  return {own.x_m + x_m * cos_yaw - y_m * sin_yaw, own.y_m + x_m * sin_yaw + y_m * cos_yaw};
}

world::Curvilinear station_of(const world::TrackMap& map, const OwnMotion& own,
                              const Position& at) {
  const double dx_m = at.x_m - own.x_m, dy_m = at.y_m - own.y_m;
  const double ahead_m = dx_m * std::cos(own.yaw_rad) + dy_m * std::sin(own.yaw_rad);
  return map.project(at.x_m, at.y_m, own.s_m + std::copysign(std::hypot(dx_m, dy_m), ahead_m));
}

double lidar_sigma_m(const RoadParams& p, double distance_m) {
  return p.lidar_sigma_m + p.lidar_sigma_per_m * std::max(0.0, distance_m - p.lidar_sigma_from_m);
}

CameraSigma camera_sigma(const RoadParams& p, std::uint8_t unit, const Measurement& m,
                         double distance_m) {
  CameraSigma sigma{p.wide_camera_bearing_sigma_rad, p.wide_camera_inverse_depth_sigma_per_m};
  if (unit == 0) sigma = {p.camera_bearing_sigma_rad, p.camera_inverse_depth_sigma_per_m};
  if (std::isfinite(m.value[2])) sigma.bearing_rad = m.value[2];
  if (std::isfinite(m.value[3])) sigma.inverse_depth_per_m = m.value[3] / distance_m;
  return sigma;
}

SightSigma sight_sigma(const RoadParams& p, const FrameKey& sensor, const Measurement& m,
                       double distance_m) {
  switch (sensor.source) {
    case DetectionSource::kCamera: {
      const CameraSigma sigma = camera_sigma(p, sensor.unit, m, distance_m);
      return {distance_m * distance_m * sigma.inverse_depth_per_m, distance_m * sigma.bearing_rad};
    }
    case DetectionSource::kRadar:
      return {p.radar_range_sigma_m, distance_m * p.radar_bearing_sigma_rad};
    case DetectionSource::kLidar:
      break;
  }
  const double sigma_m = lidar_sigma_m(p, distance_m);
  return {sigma_m, sigma_m};
}

}  // namespace pitwall::tracking
