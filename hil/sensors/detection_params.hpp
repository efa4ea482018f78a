// Parameters of the sensors that see other cars, with the processing behind them: what each can
// see, how often it misses, and its errors. The source of every number is in README.md beside this
// file.
//   units  noise: one standard deviation; angles in Body, counter-clockwise from x
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <numbers>
#include <vector>

#include "hil/sensors/unit_params.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/detection.hpp"

namespace pitwall::sensors {

// A quantity over the distance: linear between the rows, constant outside.
struct RangeRow {
  double range_m = 0.0, value = 0.0;
};
using RangeTable = std::vector<RangeRow>;  // by increasing range, at least one

struct Sector {
  double from_rad = 0.0, to_rad = 0.0;  // counter-clockwise from `from` to `to`

  bool operator==(const Sector&) const = default;
};

// Times of exponential length at exponential distances.
struct Bursts {
  double per_s = 0.0, mean_s = 0.0;  // how often one begins; how long it lasts
};

struct View {
  double facing_rad = 0.0, width_rad = 2.0 * std::numbers::pi;
  double least_m = 0.0, most_m = 0.0;
  FixedVector<Sector, 4> blind{};
  double visible_share = 0.0;  // of the car's width that no nearer car hides; less is not seen
};

// Position per axis; front and back of the box are exchanged with probability `flip`.
struct LidarNoise {
  RangeTable position_sigma_m{{{60.0, 0.15}, {100.0, 0.30}, {120.0, 0.375}}};
  double yaw_sigma_rad = from_deg(2.0), flip = 0.05;
  double length_sigma_m = 0.20, width_sigma_m = 0.08;
};

// The height of the image is focal length times the car's height over the distance, so that the
// sigma of the distance is distance^2 / (focal height) height_sigma.
struct CameraNoise {
  double bearing_sigma_rad = 0.001;
  double focal_px = 2000.0, height_m = 1.2, height_sigma_px = 1.0;
};

struct RadarNoise {
  double range_sigma_m = 0.5, bearing_sigma_rad = from_deg(1.0), rate_sigma_mps = 0.15;
};

struct DetectionSensor {
  world::DetectionSource source = world::DetectionSource::kLidar;
  std::uint8_t unit = 0;
  Cadence cadence{milliseconds(50), milliseconds(90), 0.010};
  Duration phase{};  // of the first epoch
  View view;
  RangeTable hit_rate;      // share of the cars in view that are detected
  double frame_loss = 0.0;  // probability that a frame never arrives
  Bursts outage;            // no frame at all
  Bursts miss;              // of each car by itself
  LidarNoise lidar;         // those of the other kinds are not used
  CameraNoise camera;
  RadarNoise radar;
  double false_per_frame = 0.0;    // mean of a Poisson distribution
  double confidence_least = 0.6;   // of cars: uniform up to 1
  double confidence_false = 0.75;  // of false ones: uniform between half of this and this
};

inline constexpr std::size_t kDetectionSensorsMax = 12;
using DetectionSensors = FixedVector<DetectionSensor, kDetectionSensorsMax>;

inline constexpr std::size_t kLidarUnits = 3, kCameraUnits = 5, kRadarUnits = 3;

// What one of the three LiDARs looks at: ahead, to the left and to the right rear, 120 deg each.
Sector lidar_sector(std::size_t unit);

// The car's three LiDARs as one detector, its front and its four wide cameras, its three radars.
DetectionSensors av21_detection_sensors();

// Every standard deviation times the factor.
DetectionSensors with_noise(const DetectionSensors& sensors, double factor);

// What a LiDAR detector was measured to do, by distance; its cars have five returns at least.
struct DetectorErrors {
  struct Row {
    double from_m = kUnset, to_m = kUnset;
    double found_share = kUnset, position_rms_m = kUnset, yaw_rms_rad = kUnset;
  };
  std::vector<Row> rows;  // by increasing distance, at least one
  double false_per_sweep = kUnset;
};

// The LiDAR finds as many cars, with such errors; those of the position are alike along both axes.
DetectionSensors with_detector_errors(const DetectionSensors& sensors,
                                      const DetectorErrors& errors);

// All but those of one kind.
DetectionSensors without(const DetectionSensors& sensors, world::DetectionSource source);

}  // namespace pitwall::sensors
