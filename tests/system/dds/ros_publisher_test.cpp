// What another DDS gets from the base: names, types, hashes, values; and what it cannot do to it.
// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/dds/ros_publisher.hpp"

#include <gtest/gtest.h>
#include <peer.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>

#include "protocol/transport/process.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "tests/basestation/publishers/ros_view/sample_state.hpp"
#include "tests/basestation/radio_rig.hpp"
#include "tests/system/dds/cyclone_peer.hpp"

namespace pitwall::publishers::dds {
namespace {

using pitwall::testing::comes;
using pitwall::testing::CyclonePeer;
using pitwall::testing::Endpoint;
using telemetry::field;

constexpr pitwall::testing::Ask kLatched{.reliable = true, .latched = true, .depth = 1};

RosConfig config_of(int domain, Distribution distribution = Distribution::kJazzy) {
  RosConfig config{.domain = {.domain = domain}, .distribution = distribution};
  config.view = {.space = "",
                 .hardware = "car 7",
                 .course = ros_view::testing::circle(),
                 .datum = ros_view::Geodetic{36.2722, -115.0103, 594.0}};
  return config;
}

// A base that hears a car, and its publisher.
class Base {
 public:
  explicit Base(RosConfig config) {
    rig_.snapshot = ros_view::testing::sample_state();
    rig_.sampled = telemetry::groups_of(telemetry::Direction::kDown);
    rig_.run(seconds(2));  // sessions are made, every group has come
    auto started = start(std::move(config));
    EXPECT_TRUE(started) << to_string(started.error());
    publisher_ = *std::move(started);
  }

  void turn() {
    rig_.run(milliseconds(20));
    const telemetry::Arrival all{.groups = telemetry::groups_of(telemetry::Direction::kDown),
                                 .received = rig_.now};
    publisher_->packet(*rig_.base, all);
    publisher_->publish(*rig_.base, rig_.now);
  }
  bool turns_until(const std::function<bool()>& is_so) {
    return comes([&] {
      turn();
      return is_so();
    });
  }
  service::Publisher& publisher() { return *publisher_; }
  service::CarService& service() { return *rig_.base; }
  service::PublisherFigures figures() const { return *publisher_->figures(); }
  std::uint64_t refused(const std::string& what) const {
    for (const auto& [name, count] : figures().refused)
      if (name == what) return count;
    return 0;
  }

 private:
  RadioRig rig_;
  std::unique_ptr<service::Publisher> publisher_;
};

// Takes until something is there.
template <class M>
pitwall::testing::Loan<M> awaited(Base& base, dds_entity_t reader) {
  for (int i = 0; i < 1'500; ++i) {
    base.turn();
    if (auto loan = CyclonePeer::take<M>(reader)) return loan;
    transport::sleep_until(transport::monotonic_now() + milliseconds(20));
  }
  ADD_FAILURE() << "nothing came";
  return {};
}

TEST(RosPeers, CycloneReadsWhatTheCarSays) {
  Base base{config_of(41)};
  CyclonePeer peer{41};
  const auto odom =
      peer.reader(peer_Odometry_desc, "nav_msgs::msg::dds_::Odometry_", "rt/vehicle/odom");
  const auto best_effort = peer.reader(peer_TFMessage_desc, "tf2_msgs::msg::dds_::TFMessage_",
                                       "rt/tf", {.reliable = false});
  const auto top =
      peer.reader(peer_NavSatFix_desc, "sensor_msgs::msg::dds_::NavSatFix_", "rt/gnss/top/fix");
  const auto imu = peer.reader(peer_Imu_desc, "sensor_msgs::msg::dds_::Imu_", "rt/imu");
  const auto health = peer.reader(peer_DiagnosticArray_desc,
                                  "diagnostic_msgs::msg::dds_::DiagnosticArray_", "rt/diagnostics");
  const auto wheels =
      peer.reader(peer_Wheels_desc, "pitwall_msgs::msg::dds_::Wheels_", "rt/base/wheels");
  if (const auto got = awaited<peer_Odometry>(base, odom)) {
    EXPECT_STREQ(got->header.frame_id, "map");
    EXPECT_STREQ(got->child_frame_id, "base_link");
    EXPECT_NEAR(got->pose.pose.position.x, 120.0, 0.02);  // as the radio rounds it
    EXPECT_NEAR(got->twist.twist.linear.x, 66.0, 0.02);
    EXPECT_TRUE(std::isnan(got->twist.twist.linear.z));
    EXPECT_NEAR(got->pose.covariance[7], 0.04, 0.005);
    EXPECT_EQ(got->pose.covariance[35] > 0.0, true);
  }
  if (const auto got = awaited<peer_TFMessage>(base, best_effort)) {
    ASSERT_EQ(got->transforms._length, 1U);
    EXPECT_NEAR(got->transforms._buffer[0].transform.translation.y, -45.0, 0.02);
  }
  if (const auto got = awaited<peer_NavSatFix>(base, top)) {
    EXPECT_EQ(got->status.status, 2);
    EXPECT_TRUE(std::isnan(got->latitude));
  }
  if (const auto got = awaited<peer_Imu>(base, imu)) {
    EXPECT_NEAR(got->linear_acceleration.y, 12.0, 0.1);
  }
  if (const auto got = awaited<peer_DiagnosticArray>(base, health)) {
    EXPECT_GT(got->status._length, 25U);
    EXPECT_STREQ(got->status._buffer[0].hardware_id, "car 7");
  }
  if (const auto got = awaited<peer_Wheels>(base, wheels)) {
    EXPECT_EQ(got->front_left, 0.0);
    EXPECT_EQ(got->standstill, 0.0);
  }
  EXPECT_EQ(base.figures().failed, 0U);
  EXPECT_GE(base.figures().clients, 6U);
}

// Who comes later gets the line and the transform of the Earth nevertheless.
TEST(RosPeers, WhatIsLatchedIsToldToWhoComesLater) {
  Base base{config_of(42)};
  for (int i = 0; i < 10; ++i) base.turn();
  CyclonePeer peer{42};
  const auto line =
      peer.reader(peer_Path_desc, "nav_msgs::msg::dds_::Path_", "rt/raceline", kLatched);
  const auto earth =
      peer.reader(peer_TFMessage_desc, "tf2_msgs::msg::dds_::TFMessage_", "rt/tf_static", kLatched);
  if (const auto got = awaited<peer_Path>(base, line)) {
    ASSERT_GT(got->poses._length, 300U);
    EXPECT_NEAR(got->poses._buffer[0].pose.position.x, 300.0, 0.05);
  }
  if (const auto got = awaited<peer_TFMessage>(base, earth)) {
    EXPECT_STREQ(got->transforms._buffer[0].header.frame_id, "earth");
  }
}

TEST(RosPeers, NamesTypesAndHashesAreThoseOfRos) {
  Base base{config_of(43)};
  CyclonePeer peer{43};
  std::vector<Endpoint> writers;
  const ros_view::View view{config_of(43).view};
  const std::size_t wanted = view.topics().size() + 1;  // and ros_discovery_info
  ASSERT_TRUE(comes([&] { return (writers = peer.others(true)).size() >= wanted; }))
      << writers.size() << " of " << wanted;
  EXPECT_EQ(writers.size(), wanted);
  for (const ros_view::Topic& topic : view.topics()) {
    const auto found = std::ranges::find(writers, "rt" + topic.name, &Endpoint::topic);
    ASSERT_NE(found, writers.end()) << topic.name;
    EXPECT_EQ(found->user_data, "typehash=" + topic.hash + ";");
    const std::string bare = topic.type.substr(topic.type.rfind('/') + 1);
    EXPECT_TRUE(found->type.ends_with("::msg::dds_::" + bare + "_")) << found->type;
  }
}

// The publisher has no ears: nothing that is published can reach the command path.
TEST(RosPeers, HasNoReaderOfAnything) {
  Base base{config_of(44)};
  CyclonePeer peer{44};
  ASSERT_TRUE(comes([&] { return peer.others(true).size() > 20; }));
  for (const Endpoint& reader : peer.others(false)) ADD_FAILURE() << "it reads " << reader.topic;
}

// The writers that it names are those that are there, all but that of this topic itself.
template <class Nodes>
void expect_node(const Nodes& nodes, CyclonePeer& peer, bool hashes) {
  ASSERT_EQ(nodes.nodes._length, 1U);
  const auto& node = nodes.nodes._buffer[0];
  EXPECT_STREQ(node.node_name, "pitwall_base");
  EXPECT_STREQ(node.node_namespace, "/");
  EXPECT_EQ(node.readers._length, 0U);
  std::vector<Endpoint> writers;
  EXPECT_TRUE(comes([&] {
    writers = peer.others(true);
    return writers.size() == node.writers._length + 1;
  })) << writers.size()
      << " of " << node.writers._length + 1;
  for (std::uint32_t i = 0; i < node.writers._length; ++i) {
    EXPECT_TRUE(std::ranges::any_of(writers, [&](const Endpoint& writer) {
      return std::memcmp(writer.guid.data(), node.writers._buffer[i].data, 16) == 0;
    })) << i;
  }
  for (const Endpoint& writer : writers) EXPECT_EQ(!writer.user_data.empty(), hashes);
}

TEST(RosPeers, TellsItsNodeInTheFormOfEachDistribution) {
  constexpr const char* kType = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_";
  {
    Base base{config_of(45, Distribution::kHumble)};
    CyclonePeer peer{45};
    const auto reader = peer.reader(peer_NodesOfHumble_desc, kType, "ros_discovery_info", kLatched);
    if (const auto got = awaited<peer_NodesOfHumble>(base, reader))
      expect_node(*got, peer, false);  // Humble has no hashes
  }
  Base base{config_of(46)};
  CyclonePeer peer{46};
  const auto reader = peer.reader(peer_NodesOfJazzy_desc, kType, "ros_discovery_info", kLatched);
  if (const auto got = awaited<peer_NodesOfJazzy>(base, reader)) expect_node(*got, peer, true);
}

TEST(RosPeers, StrangersAreNotConnectedAndAreCounted) {
  Base base{config_of(47)};
  CyclonePeer listener{47}, liar{47};
  const auto wrong =
      listener.reader(peer_Other_desc, "std_msgs::msg::dds_::Int32_", "rt/vehicle/odom");
  const auto writer = liar.writer(peer_Other_desc, "nav_msgs::msg::dds_::Path_", "rt/vehicle/odom");
  const peer_Other lie{.number = 7};
  EXPECT_TRUE(base.turns_until([&] {
    dds_write(writer, &lie);
    return base.refused("foreign_types") >= 2;
  }));
  EXPECT_FALSE(CyclonePeer::take<peer_Other>(wrong));
  EXPECT_EQ(base.service().requests().queue().issued(), 0U);
  EXPECT_EQ(base.figures().clients, 0U);
}

TEST(RosPeers, GarbageOnItsPortIsCountedAndTheRestGoesOn) {
  constexpr int kDomain = 48;
  Base base{config_of(kDomain)};
  CyclonePeer peer{kDomain};
  const auto odom =
      peer.reader(peer_Odometry_desc, "nav_msgs::msg::dds_::Odometry_", "rt/vehicle/odom");
  auto socket = transport::UdpSocket::bind({});
  ASSERT_TRUE(socket);
  std::uint64_t seed = 1;
  const auto shoot = [&] {
    for (const int offset : {10, 11, 12, 13}) {  // of the first two participants
      for (std::size_t length : {1U, 4U, 20U, 200U, 1'400U}) {
        std::vector<std::uint8_t> bytes(length);
        for (auto& byte : bytes) {
          seed = seed * 6'364'136'223'846'793'005U + 1'442'695'040'888'963'407U;
          byte = static_cast<std::uint8_t>(seed >> 56U);
        }
        if (length >= 20)
          std::memcpy(bytes.data(), seed % 2 == 0 ? "RTPS\2\3\1\17" : "RTPX\2\3\1\17", 8);
        socket->send_to({.port = static_cast<std::uint16_t>(7'400 + 250 * kDomain + offset)},
                        bytes);
      }
    }
  };
  for (int i = 0; i < 200; ++i) shoot();
  EXPECT_TRUE(base.turns_until([&] {
    shoot();
    return base.refused("malformed_datagrams") > 0;
  }));
  EXPECT_TRUE(awaited<peer_Odometry>(base, odom));
  EXPECT_EQ(base.service().requests().queue().issued(), 0U);
}

constexpr int kStoppedDomain = 49;

// Not a test: the reader that the next one stops.
TEST(StoppedReader, DISABLED_ReadsUntilItIsKilled) {
  CyclonePeer peer{kStoppedDomain};
  const auto odom =
      peer.reader(peer_Odometry_desc, "nav_msgs::msg::dds_::Odometry_", "rt/vehicle/odom");
  for (;;) {
    while (CyclonePeer::take<peer_Odometry>(odom)) {
    }
    transport::sleep_until(transport::monotonic_now() + milliseconds(5));
  }
}

TEST(RosPeers, AReaderThatStopsCostsNobodyElseAnything) {
  Base base{config_of(kStoppedDomain)};
  auto stopped =
      transport::Process::spawn({.argv = {"/proc/self/exe", "--gtest_also_run_disabled_tests",
                                          "--gtest_filter=StoppedReader.*"}});
  ASSERT_TRUE(stopped) << to_string(stopped.error());
  ASSERT_TRUE(base.turns_until([&] { return base.figures().clients == 1; }));
  stopped->kill(SIGSTOP);
  CyclonePeer peer{kStoppedDomain};
  const auto odom = peer.reader(peer_Odometry_desc, "nav_msgs::msg::dds_::Odometry_",
                                "rt/vehicle/odom", {.depth = 1'000});
  ASSERT_TRUE(base.turns_until([&] { return base.figures().clients == 2; }));
  std::size_t got = 0, turns = 0;
  EXPECT_TRUE(base.turns_until([&] {
    ++turns;
    while (CyclonePeer::take<peer_Odometry>(odom)) ++got;
    return got >= 200;
  })) << got;
  EXPECT_EQ(base.figures().failed, 0U);
  // A writer that waited for the stopped one would be five turns late each time; what a busy
  // machine passes over by itself is little.
  for (const auto& [topic, count] : base.figures().dropped) EXPECT_LE(count, turns / 5) << topic;
}

}  // namespace
}  // namespace pitwall::publishers::dds
