// Point clouds out of files: PCD of the Point Cloud Library (ascii, binary) and KITTI's .bin.
//   in     the bytes of a file, and its name, whose end tells the format
//   out    points in the file's own frame; without a field "intensity" theirs is 0
//   errors another format; in a PCD: a head that is not one, fields of other types or without x, y,
//          z, other counts than it says; in a .bin: a size that is no multiple of 16 bytes. Each
//          with its line, or the place in the file
//   source https://pcl.readthedocs.io/projects/tutorials/en/latest/pcd_file_format.html;
//          A. Geiger et al.: Vision meets robotics: the KITTI dataset, IJRR 2013
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/autonomy/perception/lidar/point_cloud.hpp"

namespace pitwall::io {

inline constexpr std::size_t kCloudPointsMax = 10'000'000;

Result<perception::PointCloud, Problem> parse_cloud(std::string_view bytes,
                                                    const std::string& name);

}  // namespace pitwall::io
