// The package pitwall_msgs as a team builds it in its own ROS 2: `colcon build` in a workspace that
// has this folder below src/.
//   out    files with their paths inside the folder: package.xml, CMakeLists.txt, msg/*.msg
//   source ROS 2: REP 149 (package format 3), rosidl_default_generators
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace pitwall::outlets::ros_view {

struct PackageFile {
  std::string path, text;
};

std::vector<PackageFile> package_files();

}  // namespace pitwall::outlets::ros_view
