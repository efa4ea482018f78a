// `pitwall-vehicle detect FILE`: the cars in a point cloud file, for anybody's own data.
//   in     words of the command line after "detect"
//   out    a table of boxes on standard output, below it what was left out and why. Exit status: 0,
//          2 for a wrong option or a file that cannot be read
//   frames that of the file: x forward, y left, z up
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "vehicle/autonomy/perception/lidar/clusters/cluster_detector.hpp"

namespace pitwall::io {

int detect_command(std::span<const char* const> words);

std::string to_text(const perception::ClusterResult& found);

}  // namespace pitwall::io
