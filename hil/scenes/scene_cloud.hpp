// A drawn scene as the car's perception takes it.
//   out    one cloud of all sweeps, in Body at the reference time; where our car takes itself to be
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/sensors/lidar/random_scene.hpp"
#include "vehicle/autonomy/perception/lidar/point_cloud.hpp"
#include "vehicle/autonomy/perception/lidar/track_ground.hpp"

namespace pitwall::scenes {

perception::PointCloud merged(const sensors::LidarScene& scene);
perception::BodyPose pose_of(const sensors::LidarScene& scene);

}  // namespace pitwall::scenes
