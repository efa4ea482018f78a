// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/camera/image_decoder.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "protocol/vocabulary/check.hpp"
#include "vehicle/autonomy/perception/camera/camera_trunk.hpp"
#include "vehicle/autonomy/perception/network/peaks.hpp"

namespace pitwall::perception {
namespace {

ImageBox box_at(const OutputPlanes& out, std::size_t row, std::size_t column) {
  using enum CameraOutput;
  const auto value = [&](CameraOutput o) {
    return static_cast<double>(out.at(static_cast<std::size_t>(o), row, column));
  };
  constexpr double kStride = CameraTrunk::kStride;
  return {.u_px = kStride * (static_cast<double>(column) + 0.5 + value(kRight)),
          .v_px = kStride * (static_cast<double>(row) + 0.5 + value(kDown)),
          .width_px = kBoxWidth_px * std::exp(value(kWidth)),
          .height_px = kBoxHeight_px * std::exp(value(kHeight)),
          .upright_px = kUpright_px * std::exp(value(kUpright)),
          .confidence = share_of_logit(value(kCar))};
}

bool is_finite(const ImageBox& box) {
  return std::isfinite(box.u_px) && std::isfinite(box.v_px) && std::isfinite(box.width_px) &&
         std::isfinite(box.height_px) && std::isfinite(box.upright_px);
}

bool is_same_car(const ImageBox& car, const ImageBox& other) {
  return std::abs(other.u_px - car.u_px) < 0.25 * car.width_px &&
         std::abs(other.v_px - car.v_px) < 0.25 * car.height_px;
}

}  // namespace

std::vector<ImageBox> decode_image(std::span<const float> planes, double confidence_least) {
  CHECK(planes.size() == kCameraOutputs * CameraTrunk::kOutCells);
  const OutputPlanes out{planes, CameraTrunk::kOutRows, CameraTrunk::kOutColumns};
  std::vector<ImageBox> boxes;
  for (const Cell& cell : peaks_of(out, confidence_least)) {
    const ImageBox box = box_at(out, cell.row, cell.column);
    if (is_finite(box)) boxes.push_back(box);
  }
  std::ranges::stable_sort(boxes, std::ranges::greater{}, &ImageBox::confidence);
  return surest(boxes, is_same_car);
}

}  // namespace pitwall::perception
