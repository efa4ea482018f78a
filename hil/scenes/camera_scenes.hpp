// Drawn images of the front cameras as arrays, for the training of their detector.
//   format a folder of arrays (npy.hpp): images_000.npy, images_001.npy, ... (u8: kImagesOfFile
//          images each, rows of 3 x 672 bytes, red, green, blue), counts (u32: cars; one a scene),
//          cars (f32: u_px, v_px, width_px, height_px, depth_m, pixels, upright_px)
//   law    the same set is the same scenes, on any number of threads
//   errors Problem with the file that cannot be written
//   cost   0.1 s a scene and processor; 0.65 MB a scene
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "hil/scenes/scene_set.hpp"
#include "hil/sensors/camera/camera_scene.hpp"
#include "protocol/vocabulary/result.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::scenes {

inline constexpr std::size_t kImagesOfFile = 50;

struct CameraSet {
  Bodies bodies = Bodies::kDrawn;
  sensors::CameraRules rules;
  std::size_t scenes = 0;
  std::uint64_t seed = 0;
};

Result<bool, Problem> write_camera_scenes(const CameraSet& set, const world::TrackMap& track,
                                          const std::string& folder, unsigned at_a_time);

}  // namespace pitwall::scenes
