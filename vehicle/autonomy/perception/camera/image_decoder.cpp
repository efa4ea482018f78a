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

ImageBox box_at(const OutputPlanes& out, const Cell& peak) {
  using enum CameraOutput;
  constexpr auto plane = [](CameraOutput o) { return static_cast<std::size_t>(o); };
  const AroundPeak around{out, peak};
  const auto value = [&](CameraOutput o) { return around.mean(plane(o)); };
  constexpr double kStride = CameraTrunk::kStride;
  return {.u_px = kStride * around.mean_column(plane(kRight)),
          .v_px = kStride * around.mean_row(plane(kDown)),
          .width_px = kBoxWidth_px * std::exp(value(kWidth)),
          .height_px = kBoxHeight_px * std::exp(value(kHeight)),
          .upright_px = kUpright_px * std::exp(value(kUpright)),
          .confidence =
              share_of_logit(static_cast<double>(out.at(plane(kCar), peak.row, peak.column)))};
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
    const ImageBox box = box_at(out, cell);
    if (is_finite(box)) boxes.push_back(box);
  }
  std::ranges::stable_sort(boxes, std::ranges::greater{}, &ImageBox::confidence);
  return surest(boxes, is_same_car);
}

}  // namespace pitwall::perception
