// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/pillars/pillar_decoder.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>

#include "protocol/vocabulary/check.hpp"
#include "vehicle/autonomy/perception/lidar/pillars/pillar_trunk.hpp"
#include "vehicle/autonomy/perception/network/peaks.hpp"

namespace pitwall::perception {
namespace {

constexpr double kCellLength_m = PillarTrunk::kStride * PillarGrid::kLength_m;
constexpr double kCellWidth_m = PillarTrunk::kStride * PillarGrid::kWidth_m;

RoadBox box_at(const OutputPlanes& out, const Cell& peak) {
  using enum PillarOutput;
  constexpr auto plane = [](PillarOutput o) { return static_cast<std::size_t>(o); };
  const AroundPeak around{out, peak};
  const auto value = [&](PillarOutput o) { return around.mean(plane(o)); };
  return {.ahead_m = around.mean_row(plane(kAhead)) * kCellLength_m - PillarGrid::kBehind_m,
          .n_m = around.mean_column(plane(kLeft)) * kCellWidth_m - PillarGrid::kRight_m,
          .yaw_rad = 0.5 * std::atan2(value(kSin), value(kCos)),
          .length_m = kCarLength_m * std::exp(value(kLength)),
          .width_m = kCarWidth_m * std::exp(value(kWidth)),
          .confidence =
              share_of_logit(static_cast<double>(out.at(plane(kCar), peak.row, peak.column)))};
}

bool is_finite(const RoadBox& box) {
  return std::isfinite(box.ahead_m) && std::isfinite(box.n_m) && std::isfinite(box.yaw_rad) &&
         std::isfinite(box.length_m) && std::isfinite(box.width_m);
}

// A turn of the road bends a car's length by a centimetre: its axes are as good as Body's.
CarBox flat(const RoadBox& box) {
  return {.x_m = box.ahead_m,
          .y_m = box.n_m,
          .yaw_rad = box.yaw_rad,
          .length_m = box.length_m,
          .width_m = box.width_m,
          .confidence = box.confidence};
}

}  // namespace

std::vector<RoadBox> decode(std::span<const float> planes, double confidence_least) {
  CHECK(planes.size() == kPillarOutputs * PillarTrunk::kOutCells);
  const OutputPlanes out{planes, PillarTrunk::kOutRows, PillarTrunk::kOutColumns};
  std::vector<RoadBox> boxes;
  for (const Cell& cell : peaks_of(out, confidence_least)) {
    const RoadBox box = box_at(out, cell);
    if (is_finite(box)) boxes.push_back(box);
  }
  std::ranges::stable_sort(boxes, std::ranges::greater{}, &RoadBox::confidence);
  return surest(boxes, [](const RoadBox& other, const RoadBox& box) {
    return is_same_place(flat(other), flat(box));
  });
}

CarBox in_body(const RoadBox& box, const TrackGround& ground) {
  const TrackGround::RoadInBody road = ground.in_body(box.ahead_m, box.n_m);
  CarBox car = flat(box);
  car.x_m = road.x_m, car.y_m = road.y_m, car.ground_m = road.z_m;
  car.yaw_rad = std::remainder(road.yaw_rad + box.yaw_rad, std::numbers::pi);
  return car;
}

}  // namespace pitwall::perception
