// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/perception/camera_score.hpp"

#include <algorithm>
#include <vector>

#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::perception_bench {
namespace {

struct Match {
  double apart_rad;
  std::size_t car, detection;
};

double share_off(const sensors::SeenCar& car, const world::Detection& d) {
  return 1.0 / (d.inverse_depth_per_m * std::hypot(car.x_m, car.y_m)) - 1.0;
}

double bearing_off_rad(const sensors::SeenCar& car, const world::Detection& d) {
  return wrap_pi(d.bearing_rad - std::atan2(car.y_m, car.x_m));
}

CameraRangeScore* row_of(const sensors::CameraScene& scene, const sensors::SeenCar& car,
                         CameraScore& sums) {
  const bool is_within = car.u_px >= 0.0 && car.u_px < scene.image.width_px && car.v_px >= 0.0 &&
                         car.v_px < scene.image.height_px;
  if (car.pixels < kPixelsLeast || !is_within) return nullptr;
  const double range_m = std::hypot(car.x_m, car.y_m);
  for (std::size_t k = 0; k < kCameraRanges; ++k)
    if (range_m < kCameraRanges_m[k + 1]) return &sums.by_range[k];
  return nullptr;
}

}  // namespace

CameraRangeScore CameraScore::to(double most_m) const {
  CameraRangeScore sum;
  for (std::size_t k = 0; k < kCameraRanges && kCameraRanges_m[k + 1] <= most_m; ++k) {
    const CameraRangeScore& range = by_range[k];
    sum.cars += range.cars, sum.found += range.found;
    sum.bearing_squares_rad2 += range.bearing_squares_rad2;
    sum.share_squares += range.share_squares;
  }
  return sum;
}

void score(const sensors::CameraScene& scene, const world::DetectionFrame& frame,
           CameraScore& sums) {
  std::vector<Match> matches;
  for (std::size_t c = 0; c < scene.cars.size(); ++c)
    for (std::size_t k = 0; k < frame.detections.size(); ++k) {
      const double apart_rad = std::abs(bearing_off_rad(scene.cars[c], frame.detections[k]));
      if (apart_rad <= kPair_rad &&
          std::abs(share_off(scene.cars[c], frame.detections[k])) <= kPairShare)
        matches.push_back({apart_rad, c, k});
    }
  std::ranges::sort(matches, {}, &Match::apart_rad);
  std::vector<bool> car_matched(scene.cars.size()), detection_matched(frame.detections.size());
  for (const auto& [apart_rad, c, k] : matches) {
    if (car_matched[c] || detection_matched[k]) continue;
    car_matched[c] = detection_matched[k] = true;
    CameraRangeScore* const row = row_of(scene, scene.cars[c], sums);
    if (row == nullptr) continue;
    const double share = share_off(scene.cars[c], frame.detections[k]);
    ++row->found;
    row->bearing_squares_rad2 += apart_rad * apart_rad, row->share_squares += share * share;
  }
  for (const sensors::SeenCar& car : scene.cars)
    if (CameraRangeScore* const row = row_of(scene, car, sums)) ++row->cars;
  ++sums.images;
  sums.false_cars += static_cast<std::size_t>(std::ranges::count(detection_matched, false));
}

void add_gates(const CameraScore& held_back, cost::CostGates& gates) {
  const CameraRangeScore near = held_back.to(60.0), all = held_back.to(100.0);
  const auto gate = [&](const char* what, double value, double limit, bool held) {
    gates.count(formatted("camera: %s: %.4f of %.4f", what, value, limit), held);
  };
  gate("found to 60 m", near.found_share(), 0.95, near.found_share() >= 0.95);
  gate("found to 100 m", all.found_share(), 0.90, all.found_share() >= 0.90);
  gate("false cars an image", held_back.false_per_image(), 0.02,
       held_back.false_per_image() <= 0.02);
  gate("bearing rms to 100 m, rad", all.bearing_rms_rad(), 0.003, all.bearing_rms_rad() <= 0.003);
  gate("distance rms to 100 m, share", all.distance_rms_share(), 0.08,
       all.distance_rms_share() <= 0.08);
}

void add_decoy_gate(const CameraScore& among_decoys, cost::CostGates& gates) {
  const double share = among_decoys.false_per_image();
  gates.count(formatted("camera: false cars an image among decoys: %.4f of 0.0400", share),
              share <= 0.04);
}

std::string to_text(const std::string& set, const CameraScore& score) {
  std::string text = formatted("%s, camera's network: %zu images, %.4f false cars an image\n",
                               set.c_str(), score.images, score.false_per_image());
  text += formatted("  %-13s %5s %8s %13s %11s\n", "simulation", "cars", "recall", "bearing mrad",
                    "distance %");
  for (std::size_t k = 0; k < kCameraRanges; ++k) {
    const CameraRangeScore& range = score.by_range[k];
    text += formatted("  %3.0f to %3.0f m  %5zu", kCameraRanges_m[k], kCameraRanges_m[k + 1],
                      range.cars);
    if (range.found > 0)
      text += formatted(" %8.3f %13.2f %11.1f", range.found_share(), 1e3 * range.bearing_rms_rad(),
                        1e2 * range.distance_rms_share());
    text += "\n";
  }
  return text;
}

std::string to_json(const std::string& set, const CameraScore& score) {
  json::Array ranges;
  for (std::size_t k = 0; k < kCameraRanges; ++k) {
    const CameraRangeScore& range = score.by_range[k];
    json::Object row;
    row.number("from_m", kCameraRanges_m[k]).number("to_m", kCameraRanges_m[k + 1]);
    row.number("cars", range.cars);
    if (range.found > 0)
      row.number("recall", range.found_share())
          .number("bearing_rms_rad", range.bearing_rms_rad())
          .number("distance_rms_share", range.distance_rms_share());
    ranges.json(row.str());
  }
  return json::Object{}
      .text("set", set)
      .number("images", score.images)
      .number("false_per_image", score.false_per_image())
      .json("ranges", ranges.str())
      .str();
}

}  // namespace pitwall::perception_bench
