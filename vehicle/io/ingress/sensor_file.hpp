// Configuration file of the sensors that are received over ROS 2 topics:
//
//     domain: 0                       # ROS_DOMAIN_ID
//     interface: 192.168.10.5         # of this machine; default 127.0.0.1
//     peers: [192.168.10.7]           # optional; hosts that multicast does not reach
//     shared_memory: true             # optional; with drivers on this computer, beside UDP
//     sensors:
//       - {name: lidar, topic: /luminar_front/points, type: PointCloud2, rate_hz: 20}
//       - {name: boxes, topic: /perception/lidar, type: Detection3DArray, rate_hz: 20}
//       - {name: images, topic: /perception/camera, type: Detection2DArray, rate_hz: 20,
//          frame: front_camera, facing_deg: 0, focal_px: 2000, centre_px: 960, height_m: 1.2}
//       - {name: echoes, topic: /perception/radar, type: RadarScan, rate_hz: 20,
//          amplitude_db: [-10, 30]}
//
// A row of points whose LiDAR the car itself looks for cars in says where that is in base_link, and
// when after the stamp its rays pass the horizon:
//
//       - {name: luminar_front, topic: /luminar_front/points, type: PointCloud2, rate_hz: 20,
//          at_m: [1.0, 0.0, 0.55], turned_deg: [0, 0, 0], horizon_ms: 12.3}
//     network: ../networks/lidar_pillars.onnx   # top level, beside this file; without: clusters
//     wait_for_all: true                        # top level; the published way, to compare with: no
//                                               # frame without a sweep of every LiDAR
//
// So does a row of images (Image, CompressedImage) in which the car looks for cars, with the lens
// (a pinhole with centre_px [u, v], or a calibration as below), the height of the cars, and as
// which camera its detections count:
//
//       - {name: front_left, topic: /front_left/image_raw, type: Image, rate_hz: 10, unit: 0,
//          at_m: [0.6, 0.15, 0.7], turned_deg: [0, 1.5, 14], focal_px: 1000,
//          centre_px: [335.5, 159.5], height_m: 1.16}
//     camera_network: ../networks/camera.onnx   # top level; needed by such a row
//
// A row of detections may have: unit (0; which one of its type), frame (base_link), and where it is
// a camera or a radar facing_deg (0; counter-clockwise from ahead). detection_codec.hpp says what
// the numbers mean. Instead of focal_px and centre_px a camera may have a calibration, beside this
// file, and say which image its boxes are of:
//
//       - {name: images, topic: /perception/camera, type: Detection2DArray, rate_hz: 20,
//          frame: front_camera, calibration: front_camera.yaml, image: raw, height_m: 1.2}
//
// image: raw (the default) or rectified. calibration_file.hpp says what such a file has.
//   invariants
//          names and topics are unique, and so are the units of one type of detections. Telemetry
//          reports the first three rows of points, units 0 and 1 of the cameras' detections, unit 0
//          of the radar's, and the frames of the LiDARs
//   errors Problem with file, line and column
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/dds/domain.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/perception/camera/camera_detector.hpp"
#include "vehicle/autonomy/perception/camera/camera_model.hpp"
#include "vehicle/autonomy/perception/lidar/motion.hpp"

namespace pitwall::io {

enum class SensorType : std::uint8_t {
  kPointCloud2,
  kImage,
  kCompressedImage,
  kNavSatFix,
  kImu,
  kDetection3DArray,  // of a LiDAR
  kDetection2DArray,  // of a camera
  kRadarScan
};

// How the messages of a sensor that detects cars are read.
struct DetectionRow {
  std::uint8_t unit = 0;
  std::string frame = "base_link";                          // header.frame_id of its messages
  double facing_rad = 0.0;                                  // camera, radar
  perception::CameraModel camera{};                         // of its image
  double height_m = kUnset;                                 // camera: of a car
  double amplitude_0_db = kUnset, amplitude_1_db = kUnset;  // radar: confidence 0 and 1
};

// A LiDAR whose points the car looks for cars in.
struct LidarRow {
  perception::SensorPose mount;
  Duration horizon{};  // when its rays pass it, after the stamp
};

// A camera whose images the car looks for cars in.
struct CameraRow {
  perception::CameraMounting mounting;
  std::uint8_t unit = 0;  // of its detections
};

struct SensorRow {
  std::string name, topic;
  SensorType type = SensorType::kPointCloud2;
  double rate_hz = 0.0;  // expected rate
  DetectionRow detections{};
  std::optional<LidarRow> lidar{};    // only of points
  std::optional<CameraRow> camera{};  // only of images
};

constexpr bool has_images(SensorType type) {
  return type == SensorType::kImage || type == SensorType::kCompressedImage;
}
constexpr bool detects_cars(SensorType type) { return type >= SensorType::kDetection3DArray; }

struct SensorFile {
  dds::DomainConfig domain;
  std::vector<SensorRow> sensors;
  std::string network{};         // file of the LiDARs' network; empty: clusters
  std::string camera_network{};  // file of the cameras' network
  bool waits_for_all = false;
};

inline constexpr std::size_t kSensorsMax = 16;

Result<SensorFile, Problem> read_sensor_file(const std::string& path);

}  // namespace pitwall::io
