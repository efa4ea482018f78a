// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/can_part.hpp"

#include <gtest/gtest.h>

#include "hil/replay/recordings/recording_builder.hpp"
#include "tests/hil/replay/recordings/recording_samples.hpp"

namespace pitwall::traffic {
namespace {

using replay::LoggedDirection;

TEST(CanPart, HasEveryFrameInOrderAndCountsTheRest) {
  RecordingBuilder builder{"run"};
  const auto received = builder.add_source("/can/in", SourceKind::kCan, "can");
  const auto long_name = builder.add_source("/vehicle/can/from_bus", SourceKind::kCan, "can");
  const auto imu = builder.add_source("/imu", SourceKind::kRos, "sensor_msgs/msg/Imu");
  for (std::uint32_t i = 0; i < 300; ++i) {
    const UtcTime at{1'000'000'000 + std::int64_t{i} * 1'000};
    if (i % 3 == 2) {
      EXPECT_TRUE(builder.add(imu, at, builder.pool().copy(as_bytes("imu")), i));
    } else {
      EXPECT_TRUE(builder.add(i % 3 == 0 ? received : long_name, at, testing::some_frame(i), i));
    }
  }
  const Recording recording = std::move(builder).finish();
  const auto log = can_part(recording, "MCAP", "run");
  ASSERT_TRUE(log) << to_string(log.error());
  EXPECT_EQ(log->format, "MCAP");
  EXPECT_EQ(log->channels, (std::vector<std::string>{"/can/in", "can1"}));
  EXPECT_EQ(log->notes, (std::vector<std::string>{"can1 is /vehicle/can/from_bus"}));
  EXPECT_EQ(log->frames.size(), 200U);
  EXPECT_EQ(log->counters.other_records, 100U);
  EXPECT_EQ(log->counters.backward_stamps, 0U);
  std::size_t next = 0;
  for (const Record& record : recording.records) {
    if (record.frame() == nullptr) continue;
    const replay::LoggedFrame& logged = log->frames[next++];
    EXPECT_EQ(logged.frame, *record.frame());
    EXPECT_EQ(logged.at, record.at);
    EXPECT_EQ(logged.direction,
              logged.channel == 0 ? LoggedDirection::kReceived : LoggedDirection::kUnknown);
  }
}

TEST(CanPart, ARecordingWithoutFramesIsRefused) {
  RecordingBuilder builder{"run"};
  const auto imu = builder.add_source("/imu", SourceKind::kRos, "sensor_msgs/msg/Imu");
  EXPECT_TRUE(builder.add(imu, UtcTime{1}, builder.pool().copy(as_bytes("imu")), 0));
  const auto none = can_part(std::move(builder).finish(), "MCAP", "run");
  ASSERT_FALSE(none);
  EXPECT_EQ(to_string(none.error()), "run: error: holds no CAN frames");
}

TEST(CanPart, ALogIsReadAsALogAndWhatIsNeitherIsNamed) {
  const auto log = read_can_traffic(std::string{"(1.0) can0 123#11\n"}, "a.log");
  ASSERT_TRUE(log);
  EXPECT_EQ(log->frames.size(), 1U);
  EXPECT_FALSE(is_recording("(1.0) can0 123#11\n"));
  const auto page = read_can_traffic(std::string{"<html>"}, "page");
  ASSERT_FALSE(page);
  EXPECT_EQ(to_string(page.error()).rfind("page: error: looks like a web page", 0), 0U);
}

}  // namespace
}  // namespace pitwall::traffic
