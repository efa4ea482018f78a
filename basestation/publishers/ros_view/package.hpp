// Package pitwall_msgs as source for a team's own ROS 2: `colcon build` in a workspace that has
// this folder below src/.
//   out    files with their paths inside the folder: package.xml, CMakeLists.txt, msg/*.msg
//   source ROS 2: REP 149 (package format 3), rosidl_default_generators
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::publishers::ros_view {

struct PackageFile {
  std::string path, text;
};

std::vector<PackageFile> package_files();

// Writes them into a folder, which is created; existing files of the same names are replaced.
// Returns the number of files, or a Problem with the path.
Result<std::size_t, Problem> write_package(const std::string& folder);

}  // namespace pitwall::publishers::ros_view
