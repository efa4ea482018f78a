// Model of a camera on the car: one image of what its rays meet.
//   in     camera; scene of rays with track_scene_meshes() and car_meshes(), its cars placed; where
//          our Body is; look of that day
//   out    the image as the camera publishes it, rows from the top, red, green, blue, and which car
//          each pixel shows
//   law    one ray a pixel, at a drawn place in it; sun, shadow and light of the sky (Lambert);
//          dust takes light by its optical depth; then blur, noise, sRGB
//   frames Map; camera: x ahead along its axis, y left, z up (as every sensor's mount here)
//   noise  own generator: the same seed gives the same image
//   cost   0.1 s an image of 672 x 320
//   limit  the whole image at one time; no motion blur, no reflections; our own body hides nothing
//   source sRGB: IEC 61966-2-1
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hil/sensors/camera/look.hpp"
#include "hil/sensors/lidar/lidar.hpp"
#include "hil/sensors/lidar/ray_scene.hpp"
#include "vehicle/autonomy/perception/camera/camera_model.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::sensors {

struct CameraUnit {
  SensorMount mount;
  perception::CameraModel optics;
  int width_px = 672, height_px = 320;
};

// The two that look ahead, 14 deg to the left and to the right, 37 deg wide each.
std::vector<CameraUnit> av21_front_cameras();

struct CameraImage {
  int width_px = 0, height_px = 0;
  std::vector<std::uint8_t> rgb;
  std::vector<std::int8_t> car;  // of each pixel; -1: none
};

// What stands still: surroundings of the track, and lines painted on the road.
std::vector<Mesh> track_scene_meshes(const world::TrackMap& track);

struct CameraWorld {
  BodyMotion ours;                   // Body
  std::span<const BodyMotion> cars;  // by their numbers in the scene
  std::span<const DustCloud> dust;
};

CameraImage camera_image(const CameraUnit& unit, const RayScene& scene, const CameraWorld& world,
                         const Look& look, Noise& noise);

}  // namespace pitwall::sensors
