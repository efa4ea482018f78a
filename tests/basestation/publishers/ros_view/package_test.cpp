// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/ros_view/package.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "basestation/publishers/ros_view/group_message.hpp"

namespace pitwall::publishers::ros_view {
namespace {

const std::string& text_of(const std::vector<PackageFile>& files, const std::string& path) {
  static const std::string kNone;
  const auto found = std::ranges::find(files, path, &PackageFile::path);
  EXPECT_NE(found, files.end()) << path;
  return found == files.end() ? kNone : found->text;
}

TEST(RosPackage, HasEveryMessageAndBuildsEachThatItHas) {
  const auto files = package_files();
  const std::string& list = text_of(files, "CMakeLists.txt");
  EXPECT_EQ(files.size(), group_messages().size() + 2);
  for (const GroupMessage& message : group_messages()) {
    const std::string path = "msg/" + message.name + ".msg";
    EXPECT_NE(list.find("\"" + path + "\"\n"), list.npos);
    const std::string& text = text_of(files, path);
    EXPECT_TRUE(text.ends_with(ros::file_text(message.type.type))) << path;
    EXPECT_TRUE(text.starts_with("# ")) << path;
    EXPECT_EQ(text.find("===="), text.npos) << "a .msg file holds one message";
  }
}

TEST(RosPackage, NamesItsNeeds) {
  const auto files = package_files();
  const std::string& xml = text_of(files, "package.xml");
  for (const char* const part :
       {"<name>pitwall_msgs</name>", "<depend>std_msgs</depend>", "<license>Apache-2.0</license>",
        "<member_of_group>rosidl_interface_packages</member_of_group>",
        "<buildtool_depend>rosidl_default_generators</buildtool_depend>"})
    EXPECT_NE(xml.find(part), xml.npos) << part;
  EXPECT_NE(text_of(files, "CMakeLists.txt").find("DEPENDENCIES std_msgs"), std::string::npos);
}

TEST(RosPackage, LiesInItsFolderAsItWasMade) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("pitwall-msgs-" + std::to_string(getpid()));
  const auto written = write_package(folder.string());
  ASSERT_TRUE(written) << to_string(written.error());
  EXPECT_EQ(*written, package_files().size());
  for (const PackageFile& file : package_files()) {
    std::ostringstream text;
    text << std::ifstream{folder / file.path}.rdbuf();
    EXPECT_EQ(text.str(), file.text) << file.path;
  }
  std::filesystem::remove_all(folder);
  EXPECT_FALSE(write_package("/proc/no/such/place"));
}

}  // namespace
}  // namespace pitwall::publishers::ros_view
