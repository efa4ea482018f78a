// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/detection_params.hpp"

#include <cmath>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::sensors {
namespace {

using world::DetectionSource;

DetectionSensor lidars() {
  DetectionSensor s;
  s.view = {.least_m = 1.5, .most_m = 120.0, .visible_share = 0.3};
  s.hit_rate = {{{60.0, 0.98}, {100.0, 0.95}, {120.0, 0.80}}};
  s.frame_loss = 0.02, s.outage = {1.0 / 120.0, 0.2}, s.miss = {1.0 / 30.0, 0.3};
  s.false_per_frame = 0.02;
  return s;
}

DetectionSensor camera(std::uint8_t unit, double facing_rad) {
  DetectionSensor s;
  s.source = DetectionSource::kCamera, s.unit = unit;
  s.cadence = {milliseconds(50), milliseconds(60), 0.010};
  s.phase = milliseconds(10 + 2 * unit);
  s.view.facing_rad = facing_rad, s.view.visible_share = 0.5;
  s.frame_loss = 0.02, s.outage = {1.0 / 120.0, 0.2}, s.miss = {1.0 / 30.0, 0.3};
  s.false_per_frame = 0.02;
  return s;
}

DetectionSensor narrow_camera(std::uint8_t unit) {
  DetectionSensor s = camera(unit, 0.0);
  s.view.width_rad = from_deg(40.0), s.view.least_m = 8.0, s.view.most_m = 150.0;
  s.hit_rate = {{{60.0, 0.97}, {100.0, 0.93}, {150.0, 0.60}}};
  return s;
}

DetectionSensor wide_camera(std::uint8_t unit, double facing_rad) {
  DetectionSensor s = camera(unit, facing_rad);
  s.view.width_rad = from_deg(100.0), s.view.least_m = 4.0, s.view.most_m = 60.0;
  s.hit_rate = {{{20.0, 0.97}, {40.0, 0.90}, {60.0, 0.70}}};
  s.camera = {.bearing_sigma_rad = 0.003, .focal_px = 900.0, .height_sigma_px = 1.5};
  return s;
}

DetectionSensor radar(std::uint8_t unit, double facing_rad) {
  DetectionSensor s;
  s.source = DetectionSource::kRadar, s.unit = unit;
  s.cadence = {milliseconds(50), milliseconds(50), 0.008};
  s.phase = milliseconds(30 + 2 * unit);
  s.view.facing_rad = facing_rad, s.view.width_rad = from_deg(90.0);
  s.view.least_m = 2.0, s.view.most_m = 160.0;
  s.hit_rate = {{{60.0, 0.95}, {100.0, 0.90}, {160.0, 0.60}}};
  s.frame_loss = 0.01, s.miss = {1.0 / 20.0, 0.2};
  s.false_per_frame = 0.1;
  return s;
}

}  // namespace

Sector lidar_sector(std::size_t unit) {
  CHECK(unit < kLidarUnits);
  constexpr double kWidth_rad = from_deg(120.0);
  const double facing_rad = static_cast<double>(unit) * kWidth_rad;
  return {wrap_pi(facing_rad - 0.5 * kWidth_rad), wrap_pi(facing_rad + 0.5 * kWidth_rad)};
}

DetectionSensors av21_detection_sensors() {
  DetectionSensors all;
  const double side_rad = from_deg(55.0), back_rad = from_deg(140.0), flank_rad = from_deg(70.0);
  for (const DetectionSensor& one :
       {lidars(), narrow_camera(0), wide_camera(1, side_rad), wide_camera(2, -side_rad),
        wide_camera(3, back_rad), wide_camera(4, -back_rad), radar(0, 0.0), radar(1, flank_rad),
        radar(2, -flank_rad)})
    CHECK(all.push(one));
  return all;
}

DetectionSensors with_noise(const DetectionSensors& sensors, double factor) {
  DetectionSensors noisy = sensors;
  for (DetectionSensor& s : noisy) {
    for (RangeRow& row : s.lidar.position_sigma_m) row.value *= factor;
    for (double* sigma :
         {&s.lidar.yaw_sigma_rad, &s.lidar.length_sigma_m, &s.lidar.width_sigma_m,
          &s.camera.bearing_sigma_rad, &s.camera.height_sigma_px, &s.radar.range_sigma_m,
          &s.radar.bearing_sigma_rad, &s.radar.rate_sigma_mps})
      *sigma *= factor;
  }
  return noisy;
}

DetectionSensors with_detector_errors(const DetectionSensors& sensors,
                                      const DetectorErrors& errors) {
  CHECK(!errors.rows.empty());
  RangeTable found, sigma;
  double yaw_squares = 0.0;
  for (const DetectorErrors::Row& row : errors.rows) {
    const double middle_m = 0.5 * (row.from_m + row.to_m);
    found.push_back({middle_m, row.found_share});
    sigma.push_back({middle_m, row.position_rms_m * std::sqrt(0.5)});
    yaw_squares += row.yaw_rms_rad * row.yaw_rms_rad;
  }
  DetectionSensors measured = sensors;
  for (DetectionSensor& sensor : measured) {
    if (sensor.source != DetectionSource::kLidar) continue;
    sensor.hit_rate = found;
    sensor.lidar.position_sigma_m = sigma;
    sensor.lidar.yaw_sigma_rad = std::sqrt(yaw_squares / static_cast<double>(errors.rows.size()));
    sensor.false_per_frame = errors.false_per_sweep;
  }
  return measured;
}

DetectionSensors without(const DetectionSensors& sensors, world::DetectionSource source) {
  DetectionSensors kept;
  for (const DetectionSensor& sensor : sensors)
    if (sensor.source != source) CHECK(kept.push(sensor));
  return kept;
}

}  // namespace pitwall::sensors
