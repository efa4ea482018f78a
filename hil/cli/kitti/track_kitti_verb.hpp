// Subcommand `pitwall-hil track-kitti`: the car's tracker on a sequence of KITTI's tracking
// benchmark, for the benchmark's own evaluation.
//
//   track-kitti DETECTIONS --tracker paper|road --out RESULTS [--coast FRAMES]
//   in     detections as AB3DMOT has them (kitti_files.hpp)
//   out    RESULTS in KITTI's tracking format; on stdout what it took per frame. Exit code 0: done;
//          2: the file was refused, with file:line, or wrong usage
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int track_kitti_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
