// The program as a team starts it: what the README says of ROS 2, done.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <peer.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "protocol/transport/process.hpp"
#include "tests/support/oracle_node.hpp"
#include "tests/system/dds/cyclone_peer.hpp"

namespace pitwall::testing {
namespace {

namespace fs = std::filesystem;

class BaseProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* const program = std::getenv("PITWALL_BASE_PROGRAM");
    ASSERT_NE(program, nullptr);
    program_ = program;
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string in_folder(const std::string& name) const { return (folder_ / name).string(); }

  std::string program_;
  fs::path folder_ = fs::temp_directory_path() / ("pitwall-ros-base-" + std::to_string(getpid()));
};

TEST_F(BaseProgram, ExportsAPackageForColcon) {
  const std::string said =
      output_of(program_ + " export ros --out " + in_folder("src/pitwall_msgs"));
  EXPECT_NE(said.find("colcon build"), said.npos) << said;
  EXPECT_TRUE(fs::exists(folder_ / "src/pitwall_msgs/package.xml"));
  EXPECT_TRUE(fs::exists(folder_ / "src/pitwall_msgs/CMakeLists.txt"));
  EXPECT_TRUE(fs::exists(folder_ / "src/pitwall_msgs/msg/Tyres.msg"));
  EXPECT_NE(std::system((program_ + " export ros 2>/dev/null").c_str()), 0) << "where to?";
}

TEST_F(BaseProgram, IsANodeThatTellsItsTrackBeforeAnyCarIsThere) {
  output_of(program_ + " keygen --out " + in_folder("keys"));
  auto base = transport::Process::spawn(
      {.argv = {program_, "--keys", in_folder("keys/base.keys"), "--listen", "127.0.0.1:0",
                "--track", "lvms", "--ros", "--ros-domain", "52"}});
  ASSERT_TRUE(base) << to_string(base.error());
  {
    CyclonePeer peer{52};
    const auto line = peer.reader(peer_Path_desc, "nav_msgs::msg::dds_::Path_", "rt/raceline",
                                  {.reliable = true, .latched = true, .depth = 1});
    std::uint32_t points = 0;
    EXPECT_TRUE(comes([&] {
      if (const auto path = CyclonePeer::take<peer_Path>(line)) points = path->poses._length;
      return points > 0;
    }));
    EXPECT_GT(points, 400U);
    for (const Endpoint& reader : peer.others(false))  // but our own
      EXPECT_EQ(reader.topic, "rt/raceline") << "it listens to nobody";
  }
  base->kill(SIGINT);
  EXPECT_TRUE(base->wait().success());
}

TEST_F(BaseProgram, DoesNotReachOtherMachinesUnasked) {
  output_of(program_ + " keygen --out " + in_folder("keys"));
  const std::string call = program_ + " --keys " + in_folder("keys/base.keys") +
                           " --listen 127.0.0.1:0 --ros --ros-interface 10.1.2.3 --duration 1 2>" +
                           in_folder("said");
  EXPECT_NE(std::system(call.c_str()), 0);
  std::ostringstream said;
  said << std::ifstream{in_folder("said")}.rdbuf();
  EXPECT_NE(said.str().find("--network"), std::string::npos) << said.str();
}

}  // namespace
}  // namespace pitwall::testing
