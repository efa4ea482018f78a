// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/camera/camera_detector.hpp"

#include <cmath>

#include "vehicle/autonomy/perception/camera/camera_trunk.hpp"

namespace pitwall::perception {

std::optional<world::Detection> detection_of(const ImageBox& box, const CameraMounting& camera) {
  const auto middle = undistort(camera.optics, {box.u_px, box.v_px});
  const auto upper = undistort(camera.optics, {box.u_px, box.v_px - 0.5 * box.upright_px});
  const auto lower = undistort(camera.optics, {box.u_px, box.v_px + 0.5 * box.upright_px});
  if (!middle || !upper || !lower || !(lower->y > upper->y)) return std::nullopt;
  const double depth_m = camera.car_height_m / (lower->y - upper->y);
  const auto at = in_body(camera.pose, axes_of(camera.pose),
                          {depth_m, -depth_m * middle->x, -depth_m * middle->y});
  world::Detection detection;
  detection.confidence = box.confidence;
  detection.bearing_rad = std::atan2(at[1], at[0]);
  detection.inverse_depth_per_m = 1.0 / std::hypot(at[0], at[1]);
  detection.bearing_sigma_rad = kCameraBearingSigma_rad;
  detection.distance_sigma = kCameraDistanceSigma;
  return detection;
}

Result<std::optional<CameraDetector>, Problem> CameraDetector::read(const std::string& onnx_file,
                                                                    const ReadFile& read_file) {
  if (onnx_file.empty()) return std::optional<CameraDetector>{};
  const auto onnx = read_file(onnx_file);
  if (!onnx) return Unexpected{onnx.error()};
  auto trunk = CameraTrunk::load(*onnx, onnx_file);
  if (!trunk) return Unexpected{trunk.error()};
  return std::optional{CameraDetector{*std::move(trunk)}};
}

std::vector<ImageBox> CameraDetector::boxes_in(const Image& image, double confidence_least) {
  std::vector<float> planes = planes_of(image);
  std::vector<ImageBox> boxes = decode_image(trunk_.run(planes), confidence_least);
  const double across = static_cast<double>(image.width_px) / CameraTrunk::kColumns;
  const double down = static_cast<double>(image.height_px) / CameraTrunk::kRows;
  for (ImageBox& box : boxes) {
    // Places are of the middles of pixels.
    box.u_px = (box.u_px + 0.5) * across - 0.5, box.v_px = (box.v_px + 0.5) * down - 0.5;
    box.width_px *= across, box.height_px *= down, box.upright_px *= down;
  }
  return boxes;
}

world::DetectionFrame CameraDetector::detect(const Image& image, const CameraMounting& camera,
                                             std::uint8_t unit, Instant at) {
  ++counts_.images;
  world::DetectionFrame frame{.source = world::DetectionSource::kCamera, .unit = unit, .at = at};
  for (const ImageBox& box : boxes_in(image)) {
    const auto detection = detection_of(box, camera);
    if (!detection)
      ++counts_.beyond_lens;
    else if (!frame.detections.push(*detection))
      ++counts_.no_room;
  }
  return frame;
}

}  // namespace pitwall::perception
