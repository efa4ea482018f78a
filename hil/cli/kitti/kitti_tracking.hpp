// The car's tracker over a sequence of KITTI: 10 Hz, a plane without a map, our own car at rest,
// because the detections come without its motion.
//   in     detections of one sequence; parameters of the tracker
//   out    tracks of every frame, as the evaluation takes them: those with a detection in the frame
//          or in one of the `coast_frames` before. Place, direction, length and width are the
//          tracker's, height, image and score those of the newest detection
//   errors detections beyond the room of a frame are left out, lowest score first; `left_out`
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hil/cli/kitti/kitti_files.hpp"
#include "vehicle/autonomy/tracking/tracking.hpp"

namespace pitwall::cli {

struct KittiRun {
  std::vector<KittiTrack> tracks;
  std::size_t left_out = 0;
  std::vector<double> took_us;  // processor time of the tracker, per frame
};

// Axes of Body (x forward, y left) at the camera.
world::Detection body_of(const KittiBox& box);

// The tracker's parameters for such a sequence: every detection of the file is used.
tracking::Params kitti_params(tracking::Method method);

KittiRun track_kitti(const KittiDetections& detections, const tracking::Params& params,
                     std::uint32_t coast_frames);

}  // namespace pitwall::cli
