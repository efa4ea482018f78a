// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/ros_view/package.hpp"

#include <filesystem>
#include <system_error>

#include "basestation/publishers/ros_view/group_message.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::publishers::ros_view {
namespace {

constexpr std::string_view kPackageXml = R"(<?xml version="1.0"?>
<?xml-model href="http://download.ros.org/schema/package_format3.xsd"
  schematypens="http://www.w3.org/2001/XMLSchema"?>
<package format="3">
  <name>pitwall_msgs</name>
  <version>1.0.0</version>
  <description>What the pit wall's base tells, made by `pitwall-base export ros`.</description>
  <maintainer email="team@example.com">Your team</maintainer>
  <license>Apache-2.0</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <buildtool_depend>rosidl_default_generators</buildtool_depend>
  <depend>std_msgs</depend>
  <exec_depend>rosidl_default_runtime</exec_depend>
  <member_of_group>rosidl_interface_packages</member_of_group>
  <export>
    <build_type>ament_cmake</build_type>
  </export>
</package>
)";

constexpr std::string_view kCMakeHead = R"(cmake_minimum_required(VERSION 3.8)
project(pitwall_msgs)
find_package(ament_cmake REQUIRED)
find_package(rosidl_default_generators REQUIRED)
find_package(std_msgs REQUIRED)
rosidl_generate_interfaces(${PROJECT_NAME}
)";
constexpr std::string_view kCMakeTail = R"(  DEPENDENCIES std_msgs)
ament_export_dependencies(rosidl_default_runtime)
ament_package()
)";

std::string title_of(const GroupMessage& message) {
  return "# " + std::string{message.of_base ? "What the base itself makes" : "What the car tells"} +
         ": group " + message.group + ".\n";
}

}  // namespace

std::vector<PackageFile> package_files() {
  std::vector<PackageFile> files{{"package.xml", std::string{kPackageXml}}};
  std::string list{kCMakeHead};
  for (const GroupMessage& message : group_messages()) {
    const std::string path = "msg/" + message.name + ".msg";
    list += "  \"" + path + "\"\n";
    files.push_back({path, title_of(message) + ros::file_text(message.type.type)});
  }
  list += kCMakeTail;
  files.push_back({"CMakeLists.txt", std::move(list)});
  return files;
}

Result<std::size_t, Problem> write_package(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code failed;
  fs::create_directories(fs::path{folder} / "msg", failed);
  if (failed) return Unexpected{Problem{folder, failed.message()}};
  const std::vector<PackageFile> files = package_files();
  for (const PackageFile& file : files) {
    const auto written = transport::write_file((fs::path{folder} / file.path).string(), file.text);
    if (!written) return Unexpected{written.error()};
  }
  return files.size();
}

}  // namespace pitwall::publishers::ros_view
