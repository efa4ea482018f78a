// What a third party sees on the wire: tshark's dissector of RTPS knows nothing of us.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "basestation/publishers/dds/ros_publisher.hpp"
#include "protocol/transport/clock.hpp"
#include "tests/basestation/publishers/ros_view/sample_state.hpp"
#include "tests/system/dds/cyclone_peer.hpp"

namespace pitwall::publishers::dds {
namespace {

// Lines of a program that looks on, until it ends.
class Onlooker {
 public:
  explicit Onlooker(const std::string& command) : pipe_(popen(command.c_str(), "r")) {}
  ~Onlooker() {
    if (pipe_ != nullptr) pclose(pipe_);
  }
  Onlooker(const Onlooker&) = delete;
  Onlooker& operator=(const Onlooker&) = delete;

  bool next(std::string& line) {
    std::array<char, 16'384> buffer{};
    if (pipe_ == nullptr || std::fgets(buffer.data(), buffer.size(), pipe_) == nullptr)
      return false;
    line = buffer.data();
    while (line.ends_with('\n')) line.pop_back();
    return true;
  }

 private:
  std::FILE* pipe_;
};

std::string hex(const std::string& text) {
  std::string out;
  for (const char c : text) {
    out += "0123456789abcdef"[static_cast<unsigned char>(c) / 16];
    out += "0123456789abcdef"[static_cast<unsigned char>(c) % 16];
  }
  return out;
}

// One datagram may tell of several endpoints.
std::vector<std::string> split(const std::string& text, char between) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == between) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

// Peers that join one after the other, each told of all topics: tshark says that it captures a
// little before it does.
class Newcomers {
 public:
  ~Newcomers() {
    ends_ = true;
    thread_.join();
  }

 private:
  void join_again_and_again() {
    while (!ends_) {
      const pitwall::testing::CyclonePeer peer{51};
      for (int n = 0; n < 30 && !ends_; ++n) {
        transport::sleep_until(transport::monotonic_now() + milliseconds(100));
      }
    }
  }

  std::atomic<bool> ends_ = false;
  std::thread thread_{[this] { join_again_and_again(); }};
};

// What an onlooker has heard of each topic so far; of a participant, its enclave.
struct Received {
  std::map<std::string, std::set<std::string>> types, hashes;
  bool enclave = false;

  void take(const std::string& line) {
    const std::vector<std::string> columns = split(line, '\t');
    if (columns.size() < 3) return;
    enclave = enclave || (columns[0].empty() && columns[2] == hex("enclave=/;"));
    const auto topics = split(columns[0], ','), names = split(columns[1], ','),
               data = split(columns[2], ',');
    // Where a datagram tells of endpoints with and without data, nobody knows whose it is.
    if (topics[0].empty() || topics.size() != names.size() || topics.size() != data.size()) return;
    for (std::size_t i = 0; i < topics.size(); ++i) {
      types[topics[i]].insert(names[i]);
      hashes[topics[i]].insert(data[i]);
    }
  }
};

TEST(Wire, TsharkSeesTopicsTypesHashesAndTheEnclave) {
  using Names = std::set<std::string>;
  Onlooker tshark{
      "exec timeout 120 tshark -i lo -l -f udp -T fields -e rtps.param.topicName "
      "-e rtps.param.typeName -e rtps.param.userData 2>&1"};
  std::string line;
  while (tshark.next(line) && line.find("Capturing on") == line.npos) {
  }
  ASSERT_NE(line.find("Capturing on"), line.npos) << line;
  RosConfig config{.domain = {.domain = 51}};
  config.view.course = ros_view::testing::circle();
  const ros_view::View view{config.view};
  auto publisher = start(std::move(config));
  ASSERT_TRUE(publisher) << to_string(publisher.error());
  const Newcomers newcomers;  // to whom all is told
  Received received;
  const std::size_t all = view.topics().size() + 1;  // and ros_discovery_info
  while ((received.types.size() < all || !received.enclave) && tshark.next(line))
    received.take(line);
  EXPECT_TRUE(received.enclave);
  EXPECT_EQ(received.types.size(), all);
  EXPECT_EQ(received.types["ros_discovery_info"],
            Names{"rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_"});
  EXPECT_EQ(received.types["rt/vehicle/odom"], Names{"nav_msgs::msg::dds_::Odometry_"});
  EXPECT_EQ(received.types["rt/base/tyres"], Names{"pitwall_msgs::msg::dds_::Tyres_"});
  for (const ros_view::Topic& topic : view.topics())
    EXPECT_EQ(received.hashes["rt" + topic.name], Names{hex("typehash=" + topic.hash + ";")})
        << topic.name;
}

}  // namespace
}  // namespace pitwall::publishers::dds
