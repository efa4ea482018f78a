// The program as a team starts it: what the README says of ROS 2, done.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <peer.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
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
  const std::string output =
      output_of(program_ + " export ros --out " + in_folder("src/pitwall_msgs"));
  EXPECT_NE(output.find("colcon build"), output.npos) << output;
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

TEST_F(BaseProgram, TwoCarsHaveTopicsOfTheirOwn) {
  std::ofstream file{in_folder("cars.yaml")};
  file << "cars:\n";
  for (const char* const car : {"7", "8"}) {
    output_of(program_ + " keygen --out " + in_folder(car));
    file << "  - {number: " << car << ", keys: " << car << "/base.keys, listen: ['127.0.0.1:0']}\n";
  }
  file.close();
  auto base =
      transport::Process::spawn({.argv = {program_, "--cars", in_folder("cars.yaml"), "--track",
                                          "lvms", "--ros", "--ros-domain", "53"}});
  ASSERT_TRUE(base) << to_string(base.error());
  std::multiset<std::string> of_each, of_both;  // topics; those that are named once for all
  {
    CyclonePeer peer{53};
    const auto sort = [&] {
      of_each.clear(), of_both.clear();
      for (const Endpoint& writer : peer.others(true)) {
        const bool own =
            writer.topic.starts_with("rt/car7/") || writer.topic.starts_with("rt/car8/");
        if (own) of_each.insert(writer.topic.substr(std::string{"rt/car7/"}.size()));
        if (!own) of_both.insert(writer.topic);
      }
      return of_both.size() == 6 && of_each.contains("raceline") &&
             of_each.contains("diagnostics") &&
             std::ranges::all_of(of_each, [&](auto& topic) { return of_each.count(topic) == 2; });
    };
    EXPECT_TRUE(comes(sort)) << of_each.size() << ", " << of_both.size();
  }
  EXPECT_EQ(of_both,
            (std::multiset<std::string>{"ros_discovery_info", "ros_discovery_info", "rt/tf",
                                        "rt/tf", "rt/tf_static", "rt/tf_static"}));
  base->kill(SIGINT);
  EXPECT_TRUE(base->wait().success());
}

TEST_F(BaseProgram, DoesNotReachOtherMachinesUnasked) {
  output_of(program_ + " keygen --out " + in_folder("keys"));
  const std::string call = program_ + " --keys " + in_folder("keys/base.keys") +
                           " --listen 127.0.0.1:0 --ros --ros-interface 10.1.2.3 --duration 1 2>" +
                           in_folder("said");
  EXPECT_NE(std::system(call.c_str()), 0);
  std::ostringstream output;
  output << std::ifstream{in_folder("said")}.rdbuf();
  EXPECT_NE(output.str().find("--network"), std::string::npos) << output.str();
}

}  // namespace
}  // namespace pitwall::testing
