// SPDX-License-Identifier: Apache-2.0
#include "hil/scenes/scene_cloud.hpp"

#include "hil/bench/lockstep/swept_lidars.hpp"
#include "vehicle/autonomy/perception/lidar/motion.hpp"

namespace pitwall::scenes {

perception::PointCloud merged(const sensors::LidarScene& scene) {
  perception::PointCloud cloud;
  for (const sensors::UnitSweep& sweep : scene.sweeps)
    append_in_body(
        {bench::pose_of(sweep.mount), bench::points_of(sweep.returns), -sensors::kReference_s},
        {scene.speed_mps, 0.0, scene.yaw_rate_rad_per_s}, cloud);
  return cloud;
}

perception::BodyPose pose_of(const sensors::LidarScene& scene) {
  return {scene.x_m, scene.y_m, scene.yaw_rad, sensors::kOriginOverRoad_m};
}

}  // namespace pitwall::scenes
