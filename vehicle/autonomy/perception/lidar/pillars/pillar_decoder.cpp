// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/pillars/pillar_decoder.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>

#include "protocol/vocabulary/check.hpp"
#include "vehicle/autonomy/perception/lidar/pillars/pillar_trunk.hpp"

namespace pitwall::perception {
namespace {

constexpr std::size_t kRows = PillarTrunk::kOutRows, kColumns = PillarTrunk::kOutColumns;
constexpr double kCellLength_m = PillarTrunk::kStride * PillarGrid::kLength_m;
constexpr double kCellWidth_m = PillarTrunk::kStride * PillarGrid::kWidth_m;

struct Output {
  std::span<const float> planes;

  float at(PillarOutput output, std::size_t row, std::size_t column) const {
    return planes[static_cast<std::size_t>(output) * PillarTrunk::kOutCells + row * kColumns +
                  column];
  }
};

// Of equal ones the first is the peak.
bool is_peak(const Output& out, std::size_t row, std::size_t column) {
  const float here = out.at(PillarOutput::kCar, row, column);
  for (std::size_t r = row - std::min<std::size_t>(row, 1); r < std::min(row + 2, kRows); ++r)
    for (std::size_t c = column - std::min<std::size_t>(column, 1);
         c < std::min(column + 2, kColumns); ++c) {
      const float other = out.at(PillarOutput::kCar, r, c);
      const bool is_before = r * kColumns + c < row * kColumns + column;
      if (other > here || (other == here && is_before)) return false;
    }
  return true;
}

RoadBox box_at(const Output& out, std::size_t row, std::size_t column) {
  using enum PillarOutput;
  const auto value = [&](PillarOutput o) { return static_cast<double>(out.at(o, row, column)); };
  return {.ahead_m = (static_cast<double>(row) + 0.5 + value(kAhead)) * kCellLength_m -
                     PillarGrid::kBehind_m,
          .n_m = (static_cast<double>(column) + 0.5 + value(kLeft)) * kCellWidth_m -
                 PillarGrid::kRight_m,
          .yaw_rad = 0.5 * std::atan2(value(kSin), value(kCos)),
          .length_m = kCarLength_m * std::exp(value(kLength)),
          .width_m = kCarWidth_m * std::exp(value(kWidth)),
          .confidence = 1.0 / (1.0 + std::exp(-value(kCar)))};
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
  const Output out{planes};
  const double logit_least = std::log(confidence_least / (1.0 - confidence_least));
  std::vector<RoadBox> boxes;
  for (std::size_t row = 0; row < kRows; ++row)
    for (std::size_t column = 0; column < kColumns; ++column) {
      const double logit = out.at(PillarOutput::kCar, row, column);
      if (!(logit >= logit_least) || !is_peak(out, row, column)) continue;
      const RoadBox box = box_at(out, row, column);
      if (is_finite(box)) boxes.push_back(box);
    }
  std::ranges::stable_sort(boxes, std::ranges::greater{}, &RoadBox::confidence);
  std::vector<RoadBox> kept;
  for (const RoadBox& box : boxes)
    if (std::ranges::none_of(
            kept, [&](const RoadBox& other) { return is_same_place(flat(other), flat(box)); }))
      kept.push_back(box);
  return kept;
}

CarBox in_body(const RoadBox& box, const TrackGround& ground) {
  const TrackGround::RoadInBody road = ground.in_body(box.ahead_m, box.n_m);
  CarBox car = flat(box);
  car.x_m = road.x_m, car.y_m = road.y_m, car.ground_m = road.z_m;
  car.yaw_rad = std::remainder(road.yaw_rad + box.yaw_rad, std::numbers::pi);
  return car;
}

}  // namespace pitwall::perception
