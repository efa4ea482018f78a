// Cars that a camera of ours sees.
//   in     an image; where the camera is on the car, its lens, the height of the cars looked for
//   out    a frame of detections in Body, with bearing and inverse depth: of a car of the height H,
//          upright h pixels high with the focal length f, the depth is f H / h (pinhole)
//   errors read(): Problem with the file: it cannot be read, or as Network::load(). counts()
//   cost   28 ms of one processor for an image of the network's size. Allocates
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/autonomy/perception/camera/camera_model.hpp"
#include "vehicle/autonomy/perception/camera/image.hpp"
#include "vehicle/autonomy/perception/camera/image_decoder.hpp"
#include "vehicle/autonomy/perception/mount/sensor_pose.hpp"
#include "vehicle/autonomy/perception/network/network.hpp"
#include "vehicle/world/detection.hpp"

namespace pitwall::perception {

// Trained on images of the bench: training/ beside it.
inline constexpr const char* kCameraNetworkFile = "vehicle/config/networks/camera.onnx";

struct CameraMounting {
  SensorPose pose;
  CameraModel optics;            // of the image as it comes
  double car_height_m = kUnset;  // of the cars looked for
};

// Standard deviations of what it says, as measured on drawn images of a track and a body that it
// had not seen (`bench camera`).
inline constexpr double kCameraBearingSigma_rad = 0.0027, kCameraDistanceSigma = 0.10;

struct CameraCounts {
  std::size_t images = 0;
  std::size_t beyond_lens = 0;  // boxes where the lens model has no inverse
  std::size_t no_room = 0;      // detections beyond world::kDetectionsMax
};

// Of a box in pixels of the camera's own image; nullopt where the lens model has no inverse.
std::optional<world::Detection> detection_of(const ImageBox& box, const CameraMounting& camera);

class CameraDetector {
 public:
  static constexpr double kConfidenceLeast = 0.5;

  // None where there is no name of a file.
  static Result<std::optional<CameraDetector>, Problem> read(const std::string& onnx_file,
                                                             const ReadFile& read_file);

  // In pixels of the image as it comes.
  std::vector<ImageBox> boxes_in(const Image& image, double confidence_least = kConfidenceLeast);
  world::DetectionFrame detect(const Image& image, const CameraMounting& camera, std::uint8_t unit,
                               Instant at);
  const CameraCounts& counts() const { return counts_; }

 private:
  explicit CameraDetector(Network trunk) : trunk_(std::move(trunk)) {}

  Network trunk_;
  CameraCounts counts_;
};

}  // namespace pitwall::perception
