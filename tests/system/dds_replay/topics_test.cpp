// ROS 2 topics of a recording as Cyclone DDS gets them from a replay: the bytes that were recorded,
// in their order, also across topics.
// SPDX-License-Identifier: Apache-2.0
#include <dds/ddsi/ddsi_serdata.h>
#include <gtest/gtest.h>
#include <peer.h>
#include <sqlite3.h>

#include <vector>

#include "hil/replay/player.hpp"
#include "hil/replay/recordings/recording_builder.hpp"
#include "hil/replay/replay_verb.hpp"
#include "hil/replay/socket_io.hpp"
#include "protocol/ros/cdr.hpp"
#include "protocol/ros/messages/nav.hpp"
#include "protocol/ros/messages/sensor.hpp"
#include "protocol/transport/file.hpp"
#include "tests/system/dds/cyclone_peer.hpp"

namespace pitwall::replay {
namespace {

using pitwall::testing::CyclonePeer;
using traffic::SourceKind;
using Cdr = std::vector<std::uint8_t>;

constexpr int kDomain = 33;
constexpr std::uint32_t kMessages = 20;
constexpr std::size_t kPassesOfTest = 2;
constexpr std::size_t kCloudBytes = 200'000;
constexpr std::size_t kMayLose = 1;     // topic whose reader may lose messages
constexpr std::size_t kPiece = 65'000;  // what is longer goes in several

struct SensorTopic {
  std::string name, type;
  std::vector<Cdr> messages{};
};

template <class Message>
Cdr cdr_of(const Message& message) {
  Cdr cdr;
  ros::encode(message, cdr);
  return cdr;
}

// A fix, an attitude, an odometry and a point cloud of each instant, and a topic whose type no one
// knows.
std::vector<SensorTopic> sensor_topics() {
  std::vector<SensorTopic> topics{{"/fix", "sensor_msgs/msg/NavSatFix"},
                                  {"/car/imu", "sensor_msgs/msg/Imu"},
                                  {"/odom", "nav_msgs/msg/Odometry"},
                                  {"/lidar", "sensor_msgs/msg/PointCloud2"},
                                  {"/odd", ""}};
  for (std::uint32_t i = 0; i < kMessages; ++i) {
    ros::NavSatFix fix;
    fix.header.frame_id = "gnss";
    fix.latitude = 36.27 + 1e-5 * i;
    ros::Imu imu;
    imu.angular_velocity.z = 0.25 * i;
    ros::Odometry odometry;
    odometry.child_frame_id = "base" + std::string(i % 7, '_');
    odometry.twist.twist.linear.x = 60.0 + i;
    ros::PointCloud2 cloud;
    cloud.header.stamp.sec = static_cast<std::int32_t>(i);
    cloud.data.assign(kCloudBytes + i, static_cast<std::uint8_t>(i));
    topics[0].messages.push_back(cdr_of(fix));
    topics[1].messages.push_back(cdr_of(imu));
    topics[2].messages.push_back(cdr_of(odometry));
    topics[3].messages.push_back(cdr_of(cloud));
    topics[4].messages.push_back({0, 1, 0, 0, 42, 0, 0, 0});
  }
  return topics;
}

std::int64_t stamp_of(std::size_t i) {
  return kNanosecondsPerSecond + static_cast<std::int64_t>(i) * 20'000'000;
}

traffic::Recording recording_of(const std::vector<SensorTopic>& topics) {
  traffic::RecordingBuilder builder{"bag.mcap"};
  for (const SensorTopic& topic : topics) {
    const auto source = builder.add_source(topic.name, SourceKind::kRos, topic.type);
    for (std::size_t i = 0; i < topic.messages.size(); ++i)
      EXPECT_TRUE(builder.add(source, {stamp_of(i)}, builder.pool().copy(topic.messages[i]), 0));
  }
  return std::move(builder).finish();
}

struct Taken {
  Cdr cdr;
  std::int64_t written_ns = 0;  // when the writer says that it wrote it
};

// Takes what has come to the reader, as it is on the wire.
void take_all(dds_entity_t reader, std::vector<Taken>& out) {
  ddsi_serdata* sample = nullptr;
  dds_sample_info_t info{};
  while (dds_takecdr(reader, &sample, 1, &info, DDS_ANY_STATE) > 0) {
    if (info.valid_data) {
      Cdr cdr(ddsi_serdata_size(sample));
      ddsi_serdata_to_ser(sample, 0, cdr.size(), cdr.data());
      out.push_back({std::move(cdr), info.source_timestamp});
    }
    ddsi_serdata_unref(sample);
  }
}

// Readers of all four topics, one that may lose messages among them. Those that may lose none ask
// for the messages before them: Cyclone DDS begins a volatile reader behind the first heartbeat
// after it learnt of the writer, which on a busy machine is long after the writer learnt of the
// reader.
struct Readers {
  explicit Readers(int domain) : peer(static_cast<unsigned>(domain)) {
    constexpr int kAll = 2 * kPassesOfTest * kMessages;
    of.push_back(peer.reader(peer_NavSatFix_desc, "sensor_msgs::msg::dds_::NavSatFix_", "rt/fix",
                             {.latched = true, .depth = kAll}));
    of.push_back(peer.reader(peer_Imu_desc, "sensor_msgs::msg::dds_::Imu_", "rt/car/imu",
                             {.reliable = false, .depth = kAll}));
    of.push_back(peer.reader(peer_Odometry_desc, "nav_msgs::msg::dds_::Odometry_", "rt/odom",
                             {.latched = true, .depth = kAll}));
    of.push_back(peer.reader(peer_PointCloud2_desc, "sensor_msgs::msg::dds_::PointCloud2_",
                             "rt/lidar", {.latched = true, .depth = kAll}));
  }
  // Until each knows its writer: what is written before never reaches a reader that may lose some.
  void wait_for_writers() const {
    for (const dds_entity_t reader : of)
      EXPECT_TRUE(pitwall::testing::comes([&] { return CyclonePeer::has_writer(reader); }));
  }
  // Until each that may lose none has so many, or patience ends.
  std::vector<std::vector<Taken>> take(std::size_t many) {
    std::vector<std::vector<Taken>> taken(of.size());
    pitwall::testing::comes([&] {
      bool is_complete = true;
      for (std::size_t i = 0; i < of.size(); ++i) {
        take_all(of[i], taken[i]);
        is_complete = is_complete && (i == kMayLose || taken[i].size() >= many);
      }
      return is_complete;
    });
    return taken;
  }

  CyclonePeer peer;
  std::vector<dds_entity_t> of;
};

// RTPS fills a message that goes in one piece up to a multiple of four bytes with anything, which a
// reader gets as well.
bool is_same(Cdr taken, const Cdr& recorded) {
  const std::size_t filled =
      recorded.size() > kPiece ? recorded.size() : (recorded.size() + 3) / 4 * 4;
  if (taken.size() != filled) return false;
  taken.resize(recorded.size());
  return taken == recorded;
}

// A reader that may lose messages gets some of them, those in order.
void expect_some_recorded_bytes(const std::vector<Taken>& taken, const SensorTopic& topic,
                                std::size_t passes) {
  EXPECT_FALSE(taken.empty()) << topic.name;
  std::size_t next = 0;
  const std::size_t published = passes * topic.messages.size();
  for (const Taken& one : taken) {
    while (next < published && !is_same(one.cdr, topic.messages[next % topic.messages.size()]))
      ++next;
    ASSERT_LT(next++, published) << topic.name << ": a message that is none, or out of order";
  }
}

void expect_recorded_bytes(const std::vector<Taken>& taken, const SensorTopic& topic,
                           std::size_t passes) {
  ASSERT_EQ(taken.size(), passes * topic.messages.size()) << topic.name;
  for (std::size_t i = 0; i < taken.size(); ++i)
    EXPECT_TRUE(is_same(taken[i].cdr, topic.messages[i % topic.messages.size()]))
        << topic.name << " message " << i;
}

TEST(ReplayTopics, CycloneGetsTheRecordedBytesInTheOrderOfTheRecording) {
  const auto topics = sensor_topics();
  const auto timeline = make_timeline(recording_of(topics),
                                      {.speed = 2.0, .dds = dds::DomainConfig{.domain = kDomain}});
  ASSERT_TRUE(timeline) << to_string(timeline.error());
  EXPECT_EQ(timeline->datagrams, 4 * kMessages);
  ASSERT_EQ(timeline->left_out.size(), 1U);
  EXPECT_EQ(timeline->left_out[0].source, "/odd");
  EXPECT_EQ(timeline->left_out[0].records, kMessages);

  Readers readers{kDomain};
  auto io = SocketIo::open(*timeline);
  ASSERT_TRUE(io) << to_string(io.error());
  io->wait_for_clients(seconds(30));
  EXPECT_TRUE(io->unread_topics().empty());
  readers.wait_for_writers();
  Player player(*timeline, {.passes = kPassesOfTest}, *io);
  const PlayReport report = player.play(io->now());
  io->finish(seconds(10));
  EXPECT_EQ(report.datagrams.sent, kPassesOfTest * 4 * kMessages);
  EXPECT_EQ(report.dropped(), 0U);
  EXPECT_EQ(report.lateness.count(), report.datagrams.sent);

  const auto taken = readers.take(kPassesOfTest * kMessages);
  for (std::size_t i = 0; i < taken.size(); ++i)
    (i == kMayLose ? expect_some_recorded_bytes : expect_recorded_bytes)(taken[i], topics[i],
                                                                         kPassesOfTest);
  if (HasFailure()) return;
  std::int64_t before = 0;
  for (std::size_t i = 0; i < kPassesOfTest * kMessages; ++i) {
    for (std::size_t topic = 0; topic < taken.size(); ++topic) {
      if (topic == kMayLose) continue;
      EXPECT_GE(taken[topic][i].written_ns, before) << "message " << i;
      before = taken[topic][i].written_ns;
    }
  }
}

TEST(ReplayTopics, ATopicThatNobodyReadsIsNamed) {
  const auto timeline =
      make_timeline(recording_of(sensor_topics()),
                    {.dds = dds::DomainConfig{.domain = kDomain + 1}, .topics = {"/fix"}});
  ASSERT_TRUE(timeline) << to_string(timeline.error());
  auto io = SocketIo::open(*timeline);
  ASSERT_TRUE(io) << to_string(io.error());
  io->wait_for_clients(milliseconds(100));
  EXPECT_EQ(io->unread_topics(), std::vector<std::string>{"rt/fix"});
}

void write_bag(const std::string& path, const std::vector<SensorTopic>& topics) {
  sqlite3* bag = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &bag), SQLITE_OK);
  std::string sql =
      "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, "
      "serialization_format TEXT, offered_qos_profiles TEXT);"
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, "
      "data BLOB);BEGIN;";
  for (std::size_t t = 0; t < topics.size(); ++t) {
    const std::string id = std::to_string(t + 1);
    sql += "INSERT INTO topics VALUES(" + id + ",'" + topics[t].name + "','" + topics[t].type +
           "','cdr','');";
    for (std::size_t i = 0; i < topics[t].messages.size(); ++i) {
      sql += "INSERT INTO messages(topic_id, timestamp, data) VALUES(" + id + "," +
             std::to_string(stamp_of(i)) + ",x'";
      for (const std::uint8_t byte : topics[t].messages[i])
        for (const int digit : {byte / 16, byte % 16}) sql += "0123456789abcdef"[digit];
      sql += "');";
    }
  }
  EXPECT_EQ(sqlite3_exec(bag, (sql + "COMMIT;").c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(bag);
}

TEST(ReplayTopics, TheVerbPublishesABagAndTellsWhatItDoesNotPlay) {
  const auto folder = transport::TemporaryFolder::create("pitwall-dds-");
  ASSERT_TRUE(folder);
  const auto topics = sensor_topics();
  const std::string bag = folder->path() + "/bag.db3";
  write_bag(bag, topics);
  Readers readers{kDomain + 2};
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  const int code = replay_verb(
      std::vector<std::string>{bag, "--dds", std::to_string(kDomain + 2), "--speed", "4", "--loop",
                               "2", "--topic", "/fix", "--topic", "/lidar", "--topic", "/odd"});
  const std::string output = ::testing::internal::GetCapturedStdout();
  const std::string errors = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(code, 0) << errors;
  EXPECT_NE(output.find("sent 0 frames and 80 datagrams"), std::string::npos) << output;
  EXPECT_NE(output.find("not played: 60 records of 3 sources"), std::string::npos) << output;
  EXPECT_NE(errors.find("/odd (20 records): expected a type of ROS 2"), std::string::npos)
      << errors;
  EXPECT_EQ(errors.find("nobody reads it"), std::string::npos) << errors;
  std::vector<Taken> fixes, clouds, others;
  pitwall::testing::comes([&] {
    take_all(readers.of[0], fixes);
    take_all(readers.of[3], clouds);
    return fixes.size() + clouds.size() >= 4 * kMessages;
  });
  expect_recorded_bytes(fixes, topics[0], 2);
  expect_recorded_bytes(clouds, topics[3], 2);
  take_all(readers.of[1], others);
  take_all(readers.of[2], others);
  EXPECT_TRUE(others.empty());
}

}  // namespace
}  // namespace pitwall::replay
