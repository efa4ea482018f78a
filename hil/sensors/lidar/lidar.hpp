// Model of a scanning LiDAR on the car: one sweep, ray by ray, while everything moves.
//   in     scene; where the car and the others are at the sweep's begin, and how they move
//   out    the returns in the frame of the sensor at the time of each, as a driver publishes them,
//          not compensated for motion; which car each comes from
//   law    the signal is reflectance x cos(incidence) / range^2; a return has the probability that
//          signal and a log-normal factor pass what the reach stands for. Dust sends light back
//          from inside its clouds with the probability 1 - exp(-optical depth). Range noise along
//          the ray. A share of the rays is lost whatever they meet
//   noise  own generator: the same seed gives the same sweep
//   cost   51,600 rays a sweep, about 50 ms
//   source rings, steps and times: measured on a sweep of the AV-21's Luminar (60 rings 0.54 deg
//          apart from +7.9 deg, one each 0.84 ms, a ray each 0.14 deg, 120 deg wide). Reach: data
//          sheet of the Hydra, 250 m on 10 %. The rest is assumed: README.md one folder up
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hil/sensors/geometry.hpp"
#include "hil/sensors/lidar/body_motion.hpp"
#include "hil/sensors/lidar/ray_scene.hpp"
#include "hil/sensors/noise.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::sensors {

struct SensorMount {
  Vector3 at_m{};     // in Body
  Attitude attitude;  // of the sensor's frame in Body
};

struct LidarPattern {
  int rings = 60;
  double top_rad = from_deg(7.9), ring_step_rad = from_deg(0.54), ring_period_s = 0.84e-3;
  double half_width_rad = from_deg(60.0), ray_step_rad = from_deg(0.14);
};

struct LidarErrors {
  double range_sigma_m = 0.025;
  double lost_share = 0.02;
  double reach_m = 250.0, reach_reflectance = 0.1;
  double signal_sigma = 0.3;  // of the logarithm
  double least_m = 0.5, most_m = 245.0;
};

struct LidarUnit {
  SensorMount mount;
  LidarPattern pattern;
  LidarErrors errors;
};

// After a sweep's begin: when the rings pass the horizon, where cars are.
inline constexpr Duration kHorizon = microseconds(12'300);

// The three of the AV-21: ahead, to the left and right rear, 120 deg each.
std::vector<LidarUnit> av21_lidars();

// A cloud of dust: Gaussian about its middle.
struct DustCloud {
  Vector3 at_m{};  // Map
  double sigma_m = 1.0;
  double extinction_per_m = 0.1;  // in its middle
};

struct LidarReturn {
  float x_m = 0.0F, y_m = 0.0F, z_m = 0.0F;  // in the sensor's frame
  float intensity = 0.0F;                    // reflectance x cos(incidence), as calibrated
  float after_s = 0.0F;                      // since the sweep's begin
  std::int16_t car = -1;  // or decoy, by its number in the scene; -1: what stands still, dust
};

struct LidarWorld {
  BodyMotion ours;                   // Body
  std::span<const BodyMotion> cars;  // by their numbers in the scene, at most those
  std::span<const DustCloud> dust;
};

// Where a sensor is and how its frame lies.
struct SensorFrame {
  Vector3 at_m{};  // Map
  Rotation axes = rotation({});
};
SensorFrame frame_of(const SensorMount& mount, const BodyMotion& body);

// Places the first cars of the scene, and commits that.
void place_cars(std::span<const BodyMotion> cars, RayScene& scene);

// Rays of a pattern, row by row from its top, from its right to its left.
int columns_of(const LidarPattern& pattern);
Vector3 ray_of(const LidarPattern& pattern, int ring, int column);  // in the sensor's frame

// What the sensor makes of it, if anything.
std::optional<LidarReturn> received(const Meeting& met, const Vector3& ray, double after_s,
                                    const LidarErrors& errors, Noise& noise);

std::vector<LidarReturn> lidar_sweep(const LidarUnit& unit, RayScene& scene,
                                     const LidarWorld& world, Noise& noise);

}  // namespace pitwall::sensors
