// Sweeps of several LiDARs as one cloud, each point where it was at one reference time.
//   in     points in the frame of a sensor, with the time of each ray; where the sensor is mounted;
//          how our car moves
//   out    points in Body at the reference time; after_s: since that time
//   law    a thing that stands still is in one place, whichever sensor saw it, and when. What moves
//          by itself is displaced by its own motion between ray and reference: 60 m/s and 20 ms are
//          1.2 m. The reference is best the time at which the rays pass the horizon, where cars
//          are as soon as they are far
//   errors a point that is not finite stays so
//   cost   O(points), 10 ns each; no sensor waits for another: a sweep is added when it is there
//   limit  turns of less than 0.1 rad between ray and reference (second order)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/perception/lidar/point_cloud.hpp"
#include "vehicle/autonomy/perception/mount/sensor_pose.hpp"

namespace pitwall::perception {

struct BodyMotion {
  double vx_mps = 0.0, vy_mps = 0.0, yaw_rate_rad_per_s = 0.0;
};

struct LidarSweep {
  SensorPose mount;
  std::span<const LidarPoint> points;
  double begun_s = 0.0;  // since the reference time; negative where it began before
};

void append_in_body(const LidarSweep& sweep, const BodyMotion& motion, PointCloud& cloud);

}  // namespace pitwall::perception
