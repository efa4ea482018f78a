// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/admission.hpp"

#include <cmath>

#include "vehicle/autonomy/tracking/filter/measurement.hpp"

namespace pitwall::tracking {
namespace {

using world::Detection;
using world::DetectionFrame;
using world::DetectionSource;

constexpr double kRateMax_mps = 250.0;  // two cars at 125 m/s
constexpr double kSizeMax_m = 30.0;
constexpr double kWallSigmas = 2.0;  // by which a detection may be beyond the wall

bool is_set(double v) { return !std::isnan(v); }

// Unset, or finite and within the range.
bool may_be(double v, double least, double most) { return !is_set(v) || (v >= least && v <= most); }

Measurement measurement_of(DetectionSource source, const Detection& d) {
  switch (source) {
    case DetectionSource::kCamera:
      return {{d.bearing_rad, d.inverse_depth_per_m, d.bearing_sigma_rad, d.distance_sigma, kUnset},
              d.confidence};
    case DetectionSource::kRadar:
      return {{d.range_m, d.bearing_rad, d.range_rate_mps, kUnset, kUnset}, d.confidence};
    case DetectionSource::kLidar:
      break;
  }
  return {{d.x_m, d.y_m, d.yaw_rad, d.length_m, d.width_m}, d.confidence};
}

bool has_form(DetectionSource source, const Measurement& m) {
  constexpr double kTurn_rad = 6.3;  // an angle in any of the usual ranges
  constexpr double kLargest = 1e6;
  if (!(m.confidence >= 0.0 && m.confidence <= 1.0)) return false;
  const auto& v = m.value;
  switch (source) {
    case DetectionSource::kLidar:
      return is_set(v[0]) && is_set(v[1]) && may_be(v[0], -kLargest, kLargest) &&
             may_be(v[1], -kLargest, kLargest) && may_be(v[2], -kTurn_rad, kTurn_rad) &&
             may_be(v[3], 0.0, kSizeMax_m) && may_be(v[4], 0.0, kSizeMax_m);
    case DetectionSource::kCamera:
      return is_set(v[0]) && may_be(v[0], -kTurn_rad, kTurn_rad) &&
             may_be(v[1], 1.0 / kLargest, kLargest) && may_be(v[2], 1e-6, 1.0) &&
             may_be(v[3], 1e-6, 1.0);
    case DetectionSource::kRadar:
      return is_set(v[0]) && is_set(v[1]) && may_be(v[0], 1.0 / kLargest, kLargest) &&
             may_be(v[1], -kTurn_rad, kTurn_rad) && may_be(v[2], -kRateMax_mps, kRateMax_mps);
  }
  return false;
}

bool is_in_own_car(const Params& params, double dx_m, double dy_m, const OwnMotion& own) {
  const double c = std::cos(own.yaw_rad), s = std::sin(own.yaw_rad);
  return std::abs(c * dx_m + s * dy_m) < 0.5 * params.own_length_m &&
         std::abs(c * dy_m - s * dx_m) < 0.5 * params.own_width_m;
}

bool is_on_track(const Params& params, const world::TrackMap& map, const FrameKey& sensor,
                 const OwnMotion& own, const Measurement& m, const Position& at,
                 double distance_m) {
  const world::Curvilinear c = station_of(map, own, at);
  const world::TrackPoint line = map.at(c.s_m);
  const SightSigma sigma = sight_sigma(params.road, sensor, m, distance_m);
  const double margin_m =
      params.wall_margin_m + kWallSigmas * std::fmax(sigma.along_m, sigma.across_m);
  return c.n_m < line.width_left_m + margin_m && c.n_m > -line.width_right_m - margin_m;
}

// Counts the reason; null for a detection to use.
std::uint64_t* refusal_of(const Params& params, const Surroundings& around, const FrameKey& sensor,
                          const OwnMotion& own, const Measurement& m, Counters& n) {
  if (!has_form(sensor.source, m)) return &n.not_finite;
  if (m.confidence < params.confidence_min) return &n.low_confidence;
  const Position at = position_of(sensor.source, own, m);
  if (!is_set(at.x_m)) return nullptr;  // a bearing
  const double dx_m = at.x_m - own.x_m, dy_m = at.y_m - own.y_m;
  const double distance_m = std::hypot(dx_m, dy_m);
  if (distance_m > params.reach_m) return &n.too_far;
  if (is_in_own_car(params, dx_m, dy_m, own)) return &n.in_own_car;
  if (around.track != nullptr &&
      !is_on_track(params, *around.track, sensor, own, m, at, distance_m))
    return &n.off_track;
  return nullptr;
}

bool is_used_source(const Params& params, DetectionSource source) {
  if (static_cast<std::size_t>(source) >= world::kDetectionSources) return false;
  return params.method == Method::kRoad || source != DetectionSource::kRadar;
}

// Of cameras two can be excluded, each by itself.
bool is_excluded(const world::SensorUse& use, const DetectionFrame& frame) {
  using enum world::Excludable;
  switch (frame.source) {
    case DetectionSource::kLidar:
      return !use.uses(kLidar);
    case DetectionSource::kRadar:
      return !use.uses(kRadar);
    case DetectionSource::kCamera:
      break;
  }
  return (frame.unit == 0 && !use.uses(kCamera0)) || (frame.unit == 1 && !use.uses(kCamera1));
}

}  // namespace

std::optional<AdmittedFrame> admit(const Params& params, const Surroundings& around,
                                   const DetectionFrame& frame, Counters& counters) {
  const auto refuse = [](std::uint64_t& count) {
    ++count;
    return std::nullopt;
  };
  if (!is_used_source(params, frame.source)) return refuse(counters.frames_unknown);
  if (is_excluded(around.use, frame)) return refuse(counters.frames_excluded);
  // Sums of `now`: a difference with a stamp that makes no sense could overflow.
  if (frame.at > around.now + from_seconds(params.ahead_max_s))
    return refuse(counters.frames_in_future);
  if (frame.at < around.now - from_seconds(params.window_s)) return refuse(counters.frames_too_old);
  const std::optional<OwnMotion> own = around.own.at(frame.at);
  if (!own) return refuse(counters.frames_unplaced);
  AdmittedFrame admitted;
  admitted.key = {frame.at, frame.source, frame.unit};
  admitted.own = *own;
  for (const Detection& d : frame.detections) {
    const Measurement m = measurement_of(frame.source, d);
    if (std::uint64_t* reason = refusal_of(params, around, admitted.key, *own, m, counters))
      ++*reason;
    else
      (void)admitted.measurements.push(m);
  }
  ++counters.frames;
  counters.detections += admitted.measurements.size();
  return admitted;
}

}  // namespace pitwall::tracking
