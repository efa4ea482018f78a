// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/ingress/sensor_file.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "protocol/ros/names.hpp"
#include "protocol/yaml/strict_map.hpp"
#include "vehicle/io/ingress/calibration_file.hpp"

namespace pitwall::io {
namespace {

constexpr double kRateMin_hz = 0.1, kRateMax_hz = 2'000.0;
constexpr std::array<std::string_view, 8> kTypes{"PointCloud2",      "Image",    "CompressedImage",
                                                 "NavSatFix",        "Imu",      "Detection3DArray",
                                                 "Detection2DArray", "RadarScan"};
constexpr const char* kExpectedTypes =
    "expected one of: PointCloud2, Image, CompressedImage, NavSatFix, Imu, Detection3DArray, "
    "Detection2DArray, RadarScan";

constexpr std::int64_t kUnitMax = 15;
constexpr double kHalfTurn_deg = 180.0;
constexpr double kPixelsMax = 100'000.0;
constexpr double kHeightMin_m = 0.3, kHeightMax_m = 5.0;
constexpr double kAmplitudeMax_db = 300.0;
constexpr std::uint32_t kSharedMemory_bytes = 1U << 20U;  // a reader sends little
constexpr double kMountMost_m = 10.0, kHorizonMost_ms = 200.0;

std::string beside(const std::string& file, const std::string& path) {
  return path.starts_with('/') ? path : file.substr(0, file.rfind('/') + 1) + path;
}

perception::CameraModel read_calibrated(yaml::StrictMap& map, const std::string& file) {
  const std::string image = map.text_or("image", "raw");
  if (image != "raw" && image != "rectified") map.fail("image", "expected raw or rectified");
  const auto camera = read_calibration(beside(file, map.text("calibration")),
                                       image == "raw" ? ImageKind::kRaw : ImageKind::kRectified);
  if (!camera) throw yaml::InputError{camera.error()};
  return *camera;
}

perception::CameraModel read_lens(yaml::StrictMap& map, const std::string& file) {
  if (map.has("calibration")) return read_calibrated(map, file);
  const double focal_px = map.number("focal_px", 1.0, kPixelsMax);
  return perception::CameraModel::pinhole(focal_px,
                                          map.number("centre_px", -kPixelsMax, kPixelsMax));
}

// Of the image itself: where its middle lies, down too.
perception::CameraModel read_image_lens(yaml::StrictMap& map, const std::string& file) {
  if (map.has("calibration")) return read_calibrated(map, file);
  const double focal_px = map.number("focal_px", 1.0, kPixelsMax);
  const std::vector<double> centre_px = map.numbers("centre_px", 2, 2, -kPixelsMax, kPixelsMax);
  return {focal_px, focal_px, centre_px[0], centre_px[1], {}};
}

DetectionRow read_detections(yaml::StrictMap& map, SensorType type, const std::string& file) {
  DetectionRow row;
  row.unit = static_cast<std::uint8_t>(map.integer_or("unit", 0, 0, kUnitMax));
  row.frame = map.text_or("frame", row.frame);
  if (type == SensorType::kDetection3DArray) return row;
  row.facing_rad = from_deg(map.number_or("facing_deg", 0.0, -kHalfTurn_deg, kHalfTurn_deg));
  if (type == SensorType::kDetection2DArray) {
    row.camera = read_lens(map, file);
    row.height_m = map.number("height_m", kHeightMin_m, kHeightMax_m);
    return row;
  }
  const std::vector<double> db =
      map.numbers("amplitude_db", 2, 2, -kAmplitudeMax_db, kAmplitudeMax_db);
  if (db[1] <= db[0]) map.fail("amplitude_db", "expected the smaller one first");
  row.amplitude_0_db = db[0], row.amplitude_1_db = db[1];
  return row;
}

perception::SensorPose read_mount(yaml::StrictMap& map) {
  const std::vector<double> at_m = map.numbers("at_m", 3, 3, -kMountMost_m, kMountMost_m);
  const std::vector<double> turned_deg =
      map.has("turned_deg") ? map.numbers("turned_deg", 3, 3, -kHalfTurn_deg, kHalfTurn_deg)
                            : std::vector<double>(3, 0.0);
  return {.x_m = at_m[0],
          .y_m = at_m[1],
          .z_m = at_m[2],
          .roll_rad = from_deg(turned_deg[0]),
          .pitch_rad = from_deg(turned_deg[1]),
          .yaw_rad = from_deg(turned_deg[2])};
}

LidarRow read_lidar(yaml::StrictMap& map) {
  const double horizon_ms = map.number_or("horizon_ms", 0.0, 0.0, kHorizonMost_ms);
  return {.mount = read_mount(map),
          .horizon = microseconds(static_cast<std::int64_t>(1e3 * horizon_ms))};
}

CameraRow read_camera(yaml::StrictMap& map, const std::string& file) {
  return {.mounting = {.pose = read_mount(map),
                       .optics = read_image_lens(map, file),
                       .car_height_m = map.number("height_m", kHeightMin_m, kHeightMax_m)},
          .unit = static_cast<std::uint8_t>(map.integer_or("unit", 0, 0, kUnitMax))};
}

// Which of the cars' cameras a row is; none: it detects nothing.
std::optional<std::uint8_t> camera_unit(const SensorRow& row) {
  if (row.camera) return row.camera->unit;
  if (row.type == SensorType::kDetection2DArray) return row.detections.unit;
  return std::nullopt;
}

bool is_same_unit(const SensorRow& a, const SensorRow& b) {
  if (const auto unit = camera_unit(a)) return camera_unit(b) == unit;
  return detects_cars(a.type) && a.type == b.type && a.detections.unit == b.detections.unit;
}

SensorRow read_row(yaml::StrictMap& map, const std::string& file) {
  SensorRow row{.name = map.text("name"), .topic = map.text("topic")};
  const auto name_is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  if (row.name.empty() || !std::ranges::all_of(row.name, name_is_plain))
    map.fail("name", "expected lower-case letters, digits and '_'");
  if (const auto topic = ros::dds_topic(row.topic); !topic) map.fail("topic", topic.error().what);
  const std::string type = map.text("type");
  const auto found = std::ranges::find(kTypes, type);
  if (found == kTypes.end()) map.fail("type", kExpectedTypes);
  row.type = static_cast<SensorType>(found - kTypes.begin());
  row.rate_hz = map.number("rate_hz", kRateMin_hz, kRateMax_hz);
  if (detects_cars(row.type)) row.detections = read_detections(map, row.type, file);
  if (row.type == SensorType::kPointCloud2 && map.has("at_m")) row.lidar = read_lidar(map);
  if (has_images(row.type) && map.has("at_m")) row.camera = read_camera(map, file);
  return row;
}

SensorFile read(yaml::StrictMap& map, const std::string& path) {
  SensorFile file;
  file.domain.domain = static_cast<int>(map.integer_or("domain", 0, 0, dds::kDomainMax));
  file.domain.interface = map.text_or("interface", file.domain.interface);
  if (map.flag_or("shared_memory", false)) file.domain.shared_memory_bytes = kSharedMemory_bytes;
  file.network = map.text_or("network", {});
  file.camera_network = map.text_or("camera_network", {});
  file.waits_for_all = map.flag_or("wait_for_all", false);
  if (map.has("peers")) file.domain.peers = map.texts("peers", 0, kSensorsMax);
  for (yaml::StrictMap& row : map.maps("sensors")) {
    const SensorRow sensor = read_row(row, path);
    for (const SensorRow& other : file.sensors) {
      if (other.name == sensor.name) row.fail("name", "another sensor has this name");
      if (other.topic == sensor.topic) row.fail("topic", "another sensor has this topic");
      if (is_same_unit(sensor, other))
        row.fail("unit", "another sensor of this kind has this unit");
    }
    if (sensor.camera && file.camera_network.empty())
      row.fail("at_m", "expected camera_network at the top level, to look at these images with");
    file.sensors.push_back(sensor);
  }
  if (file.sensors.empty() || file.sensors.size() > kSensorsMax)
    map.fail("sensors", "expected 1 to " + std::to_string(kSensorsMax));
  return file;
}

}  // namespace

Result<SensorFile, Problem> read_sensor_file(const std::string& path) {
  const auto document = yaml::load_file(path);
  if (!document) return Unexpected{document.error()};
  auto file = yaml::read(*document, [&path](yaml::StrictMap& map) { return read(map, path); });
  if (file && !file->network.empty()) file->network = beside(path, file->network);
  if (file && !file->camera_network.empty())
    file->camera_network = beside(path, file->camera_network);
  return file;
}

}  // namespace pitwall::io
