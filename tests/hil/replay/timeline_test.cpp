// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/timeline.hpp"

#include <gtest/gtest.h>

#include "hil/replay/recordings/recording_builder.hpp"

namespace pitwall::replay {
namespace {

CanLog log_of(const std::vector<std::pair<std::int64_t, std::uint8_t>>& stamps_us) {
  CanLog log;
  log.channels = {"can0", "can1"};
  for (const auto& [us, channel] : stamps_us) {
    LoggedFrame f;
    f.at = {1'700'000'000 * kNanosecondsPerSecond + us * 1'000};
    f.channel = channel;
    f.frame.id = static_cast<std::uint32_t>(log.frames.size());
    log.frames.push_back(f);
  }
  return log;
}

TEST(Timeline, EachBusKeepsTheOrderOfTheLog) {
  const auto t = make_timeline(log_of({{0, 0}, {10, 1}, {10, 0}, {5, 1}, {30, 0}}), {});
  ASSERT_TRUE(t.has_value());
  ASSERT_EQ(t->tracks.size(), 2U);
  EXPECT_EQ(t->tracks[0].target, "can0");
  EXPECT_EQ(t->tracks[0].due, (std::vector<Duration>{{0}, microseconds(10), microseconds(30)}));
  // The stamp that goes back is due with the one before it.
  EXPECT_EQ(t->tracks[1].due, (std::vector<Duration>{microseconds(10), microseconds(10)}));
  EXPECT_EQ(t->tracks[1].frames[1].id, 3U);
  EXPECT_EQ(t->frames, 5U);
}

TEST(Timeline, SpeedScalesFromTheStartSoNothingDrifts) {
  std::vector<std::pair<std::int64_t, std::uint8_t>> stamps;
  for (std::int64_t i = 0; i < 10'000; ++i) stamps.emplace_back(i * 1'000, 0);
  const auto t = make_timeline(log_of(stamps), {.speed = 3.0});
  ASSERT_TRUE(t.has_value());
  for (std::int64_t i = 0; i < 10'000; ++i) {
    const std::int64_t exact_ns = i * 1'000'000 / 3;
    ASSERT_LE(std::abs(t->tracks[0].due[static_cast<std::size_t>(i)].ns - exact_ns), 1) << i;
  }
  // The next pass begins one mean gap after the last frame.
  EXPECT_NEAR(static_cast<double>(t->pass.ns), 10'000 * 1e6 / 3.0, 2.0);
}

TEST(Timeline, ChannelsGoWhereTheyAreSent) {
  const auto log = log_of({{0, 0}, {1, 1}, {2, 0}});
  const auto merged = make_timeline(log, {.interface = "vcan0"});
  ASSERT_TRUE(merged.has_value());
  ASSERT_EQ(merged->tracks.size(), 1U);
  EXPECT_EQ(merged->tracks[0].frames.size(), 3U);
  const auto mapped = make_timeline(log, {.interface = "vcan0", .map = {{"can1", "vcan5"}}});
  ASSERT_TRUE(mapped.has_value());
  ASSERT_EQ(mapped->tracks.size(), 2U);
  EXPECT_EQ(mapped->tracks[0].target, "vcan0");
  EXPECT_EQ(mapped->tracks[1].target, "vcan5");
}

TEST(Timeline, WhatCannotBePlayedIsAProblem) {
  EXPECT_FALSE(make_timeline(CanLog{}, {}).has_value());
  const auto log = log_of({{0, 0}});
  for (const double speed : {0.0, -1.0, 1e-4, 1e7, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_FALSE(make_timeline(log, {.speed = speed}).has_value()) << speed;
  const auto unknown = make_timeline(log, {.map = {{"can9", "vcan0"}}});
  ASSERT_FALSE(unknown.has_value());
  EXPECT_EQ(unknown.error().place, "can9");
}

TEST(Timeline, WhatIsLeftOutTakesNoTime) {
  // Frames at 0, 1, 2 s, then a gap of an hour, then 1 s more.
  const auto log =
      log_of({{0, 0}, {1'000'000, 0}, {2'000'000, 1}, {3'602'000'000, 0}, {3'603'000'000, 0}});
  const auto late = make_timeline(log, {.interface = "v", .from = milliseconds(1'500)});
  ASSERT_TRUE(late.has_value());
  EXPECT_EQ(late->frames, 3U);
  EXPECT_EQ(late->tracks[0].due[0], Duration{});  // it begins with its first frame
  EXPECT_EQ(late->tracks[0].due[1], seconds(3'600));
  const auto skipped = make_timeline(log, {.interface = "v", .longest_gap = seconds(10)});
  ASSERT_TRUE(skipped.has_value());
  EXPECT_EQ(skipped->tracks[0].due,
            (std::vector<Duration>{{}, seconds(1), seconds(2), seconds(2), seconds(3)}));
  const auto chosen = make_timeline(log, {.interface = "v", .ids = {1, 3}});
  ASSERT_TRUE(chosen.has_value());
  ASSERT_EQ(chosen->frames, 2U);
  EXPECT_EQ(chosen->tracks[0].frames[1].id, 3U);
  EXPECT_EQ(chosen->tracks[0].due[1], seconds(3'601));
  EXPECT_FALSE(make_timeline(log, {.ids = {77}}).has_value());
  EXPECT_FALSE(make_timeline(log, {.from = seconds(4'000)}).has_value());
}

TEST(Timeline, APartEndsBeforeTheFirstStampBeyondAndWhatFollowsIsLeftOut) {
  // The frame at 2 s is beyond; the one after it has an earlier stamp, but comes later.
  const auto log = log_of({{0, 0}, {500'000, 0}, {1'000'000, 0}, {2'000'000, 0}, {1'100'000, 0}});
  const auto part = make_timeline(log, {.from = milliseconds(500), .until = milliseconds(2'000)});
  ASSERT_TRUE(part.has_value());
  ASSERT_EQ(part->frames, 2U);
  EXPECT_EQ(part->tracks[0].frames[0].id, 1U);
  EXPECT_EQ(part->tracks[0].frames[1].id, 2U);
  EXPECT_EQ(make_timeline(log, {.until = milliseconds(2'001)})->frames, 5U);
  const auto order = make_timeline(log, {.from = seconds(1), .until = seconds(1)});
  ASSERT_FALSE(order.has_value());
  EXPECT_EQ(order.error().place, "until");
  const auto beyond = make_timeline(log, {.from = seconds(3), .until = seconds(4)});
  ASSERT_FALSE(beyond.has_value());
  EXPECT_NE(beyond.error().what.find("its 2.000 s hold nothing"), std::string::npos)
      << beyond.error().what;
}

TEST(Timeline, ChannelsAndIdentifiersThatAreNamedMustOccur) {
  const auto log = log_of({{0, 0}, {1, 1}, {2, 0}});
  const auto one = make_timeline(log, {.topics = {"can1"}});
  ASSERT_TRUE(one.has_value());
  ASSERT_EQ(one->tracks.size(), 1U);
  EXPECT_EQ(one->tracks[0].target, "can1");
  ASSERT_EQ(one->left_out.size(), 1U);
  EXPECT_EQ(one->left_out[0].source, "can0");
  EXPECT_EQ(one->left_out[0].records, 2U);
  const auto but = make_timeline(log, {.not_ids = {1}});
  ASSERT_TRUE(but.has_value());
  EXPECT_EQ(but->frames, 2U);
  EXPECT_EQ(but->filtered, 1U);
  const auto no_channel = make_timeline(log, {.topics = {"can1", "can2"}});
  ASSERT_FALSE(no_channel.has_value());
  EXPECT_EQ(no_channel.error().place, "can2");
  EXPECT_TRUE(no_channel.error().what.ends_with("can0, can1"));
  for (const TimelineOptions& options :
       {TimelineOptions{.ids = {0, 9}}, TimelineOptions{.not_ids = {9}}}) {
    const auto no_id = make_timeline(log, options);
    ASSERT_FALSE(no_id.has_value());
    EXPECT_TRUE(no_id.error().what.ends_with("0, 1, 2")) << no_id.error().what;
  }
  EXPECT_FALSE(make_timeline(log, {.not_ids = {0, 1, 2}}).has_value());
}

// Frames of one message with a bare counter of one byte.
TEST(Timeline, FramesThatAreLeftBehindCountOnWhereTheyAreRestamped) {
  CanLog log = log_of({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 1}});
  for (std::size_t i = 0; i < log.frames.size(); ++i) {
    log.frames[i].frame = {.id = i == 1 ? 9U : 5U, .length = 1};
    log.frames[i].frame.data[0] = static_cast<std::uint8_t>(40 + 2 * i);
  }
  log.frames[3].frame.length = 0;
  TimelineOptions options{.not_ids = {9}};
  options.restamp = std::make_shared<const RestampRules>(
      RestampRules{.name = "m", .rules = {{.id = 5, .length = 1, .counter_bits = 8}}});
  const auto t = make_timeline(log, options);
  ASSERT_TRUE(t.has_value()) << to_string(t.error());
  ASSERT_EQ(t->tracks.size(), 2U);
  EXPECT_EQ(t->tracks[0].frames[0].data[0], 40);
  EXPECT_EQ(t->tracks[0].frames[1].data[0], 41);
  EXPECT_EQ(t->tracks[0].frames[2].length, 0);
  EXPECT_EQ(t->tracks[0].frames[3].data[0], 42);
  EXPECT_EQ(t->tracks[1].frames[0].data[0], 50) << "each bus has its own senders";
  EXPECT_EQ(t->restamped, 4U);
  EXPECT_EQ(t->unfit, 1U);
  can::Frame frame = t->tracks[0].frames[1];
  EXPECT_TRUE(t->tracks[0].restamp.stamp(1, 1, frame));
  EXPECT_EQ(frame.data[0], 44) << "a pass has three of them";
  options.not_ids = {5};
  const auto none = make_timeline(log, options);
  ASSERT_FALSE(none.has_value());
  EXPECT_EQ(none.error().place, "m");
}

TEST(Timeline, APassLongerThanAYearIsAProblemUnlessItsGapIsSkipped) {
  CanLog log = log_of({{0, 0}, {1, 0}});
  log.frames[0].at = {};  // the recorder's clock was not set yet
  EXPECT_FALSE(make_timeline(log, {}).has_value());
  EXPECT_TRUE(make_timeline(log, {.longest_gap = seconds(60)}).has_value());
  EXPECT_TRUE(make_timeline(log, {.speed = 1'000.0}).has_value());
}

TEST(Timeline, TheLongestLogAtTheHighestSpeedFits) {
  CanLog log = log_of({{0, 0}, {1, 0}});
  log.frames[0].at = {};
  log.frames[1].at = {9'000'000'000 * kNanosecondsPerSecond};
  const auto t = make_timeline(log, {.speed = 1e6});
  ASSERT_TRUE(t.has_value());
  EXPECT_EQ(t->tracks[0].due[1], seconds(9'000));
  EXPECT_EQ(t->pass, seconds(18'000));
}

TEST(Timeline, OneFrameIsATimeline) {
  const auto t = make_timeline(log_of({{7, 0}}), {});
  ASSERT_TRUE(t.has_value());
  EXPECT_EQ(t->pass.ns, 0);
  EXPECT_EQ(t->tracks[0].due[0].ns, 0);
}

constexpr UdpAddress kFirst{.port = 3'001}, kSecond{.port = 3'002};

// A car's bus in both directions, two receivers and a ROS topic; one record of each per
// millisecond, in the file the other way round than in the total order.
traffic::Recording mixed_recording(std::uint32_t steps) {
  using traffic::SourceKind;
  traffic::RecordingBuilder builder{"run.mcap"};
  builder.add_source("/can/in", SourceKind::kCan, "can");
  builder.add_source("/can/out", SourceKind::kCan, "can");
  builder.add_source("/gnss/0", SourceKind::kReceiver, "novatel");
  builder.add_source("/imu", SourceKind::kRos, "sensor_msgs/msg/Imu");
  builder.add_source("/gnss/1", SourceKind::kReceiver, "novatel");
  for (std::uint32_t i = steps; i-- > 0;) {
    const UtcTime at{kNanosecondsPerSecond + std::int64_t{i} * 1'000'000};
    for (std::uint32_t source = 5; source-- > 0;) {
      can::Frame frame;
      frame.id = i;
      const std::vector<std::uint8_t> bytes(1 + i, static_cast<std::uint8_t>(source));
      EXPECT_TRUE(source < 2 ? builder.add(source, at, frame, 0)
                             : builder.add(source, at, builder.pool().copy(bytes), 0));
    }
  }
  return std::move(builder).finish();
}

TEST(RecordingTimeline, TracksStandInTheOrderOfTheSourcesOnOneTimeBase) {
  const auto t = make_timeline(mixed_recording(50),
                               {.speed = 2.0,
                                .map = {{"/can/in", "v0"}},
                                .receivers = {{"/gnss/1", kSecond}, {"/gnss/0", kFirst}}});
  ASSERT_TRUE(t.has_value()) << to_string(t.error());
  ASSERT_EQ(t->tracks.size(), 3U);
  EXPECT_EQ(t->tracks[0].target, "v0");
  EXPECT_EQ(t->tracks[1].to, ByteTarget{kFirst});
  EXPECT_EQ(t->tracks[2].to, ByteTarget{kSecond});
  EXPECT_EQ(t->frames, 50U);
  EXPECT_EQ(t->datagrams, 100U);
  for (const Track& track : t->tracks) {
    ASSERT_EQ(track.due.size(), 50U);
    for (std::size_t i = 0; i < 50; ++i)
      EXPECT_EQ(track.due[i], microseconds(500 * static_cast<std::int64_t>(i)));
  }
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_EQ(t->tracks[0].frames[i].id, i);
    const auto bytes = t->tracks[2].datagrams[i];
    EXPECT_EQ(std::vector<std::uint8_t>(bytes.begin(), bytes.end()),
              std::vector<std::uint8_t>(i + 1, 4));
  }
}

TEST(RecordingTimeline, WhatIsNotMappedIsToldAndCounted) {
  const auto t = make_timeline(mixed_recording(7), {.interface = "v0"});
  ASSERT_TRUE(t.has_value());
  EXPECT_EQ(t->frames, 7U);  // what the car heard, not what it said
  std::vector<std::string> left;
  for (const LeftOut& one : t->left_out) {
    left.push_back(one.source);
    EXPECT_EQ(one.records, 7U);
  }
  EXPECT_EQ(left, (std::vector<std::string>{"/can/out", "/gnss/0", "/imu", "/gnss/1"}));
  EXPECT_NE(t->left_out[1].why.find("--receiver /gnss/0="), std::string::npos);
  const auto both =
      make_timeline(mixed_recording(7), {.interface = "v0", .map = {{"/can/out", "v0"}}});
  ASSERT_TRUE(both.has_value());
  EXPECT_EQ(both->frames, 14U);
  EXPECT_EQ(both->tracks.size(), 1U);
  const auto none = make_timeline(mixed_recording(7), {});
  ASSERT_FALSE(none.has_value());
  EXPECT_NE(none.error().what.find("--map /can/in=INTERFACE"), std::string::npos);
}

TEST(RecordingTimeline, TopicsArePlayedWhereThereIsADomain) {
  TimelineOptions options{.interface = "v0", .receivers = {{"/gnss/0", kFirst}}};
  auto t = make_timeline(mixed_recording(4), options);
  ASSERT_TRUE(t);
  ASSERT_EQ(t->left_out.size(), 3U);
  EXPECT_EQ(t->left_out[1].source, "/imu");
  EXPECT_NE(t->left_out[1].why.find("--dds DOMAIN"), std::string::npos);
  options.dds = dds::DomainConfig{.domain = 3};
  t = make_timeline(mixed_recording(4), options);
  ASSERT_TRUE(t);
  ASSERT_EQ(t->tracks.size(), 3U);
  EXPECT_EQ(t->tracks[2].to, (ByteTarget{RosTopic{"rt/imu", "sensor_msgs::msg::dds_::Imu_"}}));
  EXPECT_EQ(t->tracks[2].due, t->tracks[0].due);
  EXPECT_EQ(t->dds->domain, 3);
}

// One topic of two types, as two files that are one recording may have it.
TEST(RecordingTimeline, ATopicThatHasAnotherTypeAlreadyIsToldAndMessagesStayWhole) {
  using traffic::SourceKind;
  traffic::RecordingBuilder builder{"bag.mcap"};
  const std::vector<std::uint8_t> cloud(2 * transport::kMaxDatagramBytes + 1, 7);
  std::int64_t at = kNanosecondsPerSecond;
  for (const char* type : {"sensor_msgs/msg/Imu", "a/msg/Other", "sensor_msgs/msg/Imu"}) {
    const auto source = builder.add_source("/imu", SourceKind::kRos, type);
    EXPECT_TRUE(builder.add(source, UtcTime{at += 1'000}, builder.pool().copy(cloud), 0));
  }
  const auto t =
      make_timeline(std::move(builder).finish(), {.dds = dds::DomainConfig{.domain = 3}});
  ASSERT_TRUE(t) << to_string(t.error());
  ASSERT_EQ(t->tracks.size(), 1U);
  ASSERT_EQ(t->tracks[0].datagrams.size(), 2U);
  EXPECT_EQ(t->tracks[0].datagrams[1].size(), cloud.size());
  ASSERT_EQ(t->left_out.size(), 1U);
  EXPECT_NE(t->left_out[0].why.find("another type"), std::string::npos);
}

TEST(RecordingTimeline, ADomainWithoutTopicsIsRefused) {
  traffic::RecordingBuilder builder{"box.mcap"};
  const auto bus = builder.add_source("can0", traffic::SourceKind::kCan, "can");
  EXPECT_TRUE(builder.add(bus, UtcTime{kNanosecondsPerSecond}, can::Frame{}, 0));
  const auto t =
      make_timeline(std::move(builder).finish(), {.dds = dds::DomainConfig{.domain = 3}});
  ASSERT_FALSE(t);
  EXPECT_EQ(t.error().place, "--dds");
}

TEST(RecordingTimeline, IdentifiersStartAndGapsHoldForBoth) {
  const TimelineOptions options{.interface = "v0", .receivers = {{"/gnss/0", kFirst}}};
  TimelineOptions chosen = options;
  chosen.ids = {3, 4};
  auto t = make_timeline(mixed_recording(10), chosen);
  ASSERT_TRUE(t.has_value());
  EXPECT_EQ(t->frames, 2U);
  EXPECT_EQ(t->datagrams, 10U);
  EXPECT_EQ(t->tracks[0].due[0], milliseconds(3));
  TimelineOptions late = options;
  late.from = milliseconds(6);
  t = make_timeline(mixed_recording(10), late);
  ASSERT_TRUE(t.has_value());
  EXPECT_EQ(t->frames, 4U);
  EXPECT_EQ(t->datagrams, 4U);
  EXPECT_EQ(t->tracks[1].due[0], Duration{});
  TimelineOptions skipping = options;
  skipping.longest_gap = microseconds(500);
  t = make_timeline(mixed_recording(10), skipping);
  ASSERT_TRUE(t.has_value());
  EXPECT_EQ(t->tracks[1].due.back(), Duration{});
}

TEST(RecordingTimeline, SourcesThatAreNamedAloneArePlayedAndUnknownOnesAreListed) {
  TimelineOptions options{.interface = "v0", .receivers = {{"/gnss/0", kFirst}}};
  options.topics = {"/gnss/0"};
  const auto t = make_timeline(mixed_recording(4), options);
  ASSERT_TRUE(t.has_value());
  EXPECT_EQ(t->frames, 0U);
  EXPECT_EQ(t->datagrams, 4U);
  ASSERT_EQ(t->left_out.size(), 4U);
  EXPECT_EQ(t->left_out[0].source, "/can/in");
  EXPECT_EQ(t->left_out[0].why, "not among those of --topic");
  options.topics = {"/gnss/0", "/gnss/9"};
  const auto unknown = make_timeline(mixed_recording(4), options);
  ASSERT_FALSE(unknown.has_value());
  EXPECT_EQ(unknown.error().place, "/gnss/9");
  EXPECT_TRUE(unknown.error().what.ends_with("/can/in, /can/out, /gnss/0, /imu, /gnss/1"));
  options.topics = {};
  options.until = milliseconds(2);
  const auto part = make_timeline(mixed_recording(4), options);
  ASSERT_TRUE(part.has_value());
  EXPECT_EQ(part->frames, 2U);
  EXPECT_EQ(part->datagrams, 2U);
}

TEST(RecordingTimeline, LongRecordsAreSeveralDatagramsWithTheSameBytes) {
  const auto t = make_timeline(mixed_recording(5'000), {.receivers = {{"/gnss/1", kFirst}}});
  ASSERT_TRUE(t.has_value());
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < t->tracks[0].datagrams.size(); ++i) {
    const std::size_t size = t->tracks[0].datagrams[i].size();
    EXPECT_TRUE(size > 0 && size <= transport::kMaxDatagramBytes);
    bytes += size;
  }
  EXPECT_EQ(bytes, 5'000U * 5'001 / 2);
  EXPECT_EQ(t->datagrams, 2'048U + 2 * 2'048U + 3 * 904U);
  EXPECT_EQ(t->tracks[0].due.size(), t->datagrams);
}

TEST(RecordingTimeline, WrongNamesAndAddressesAreProblems) {
  const traffic::Recording recording = mixed_recording(2);
  const auto place = [&](const TimelineOptions& options) {
    const auto t = make_timeline(recording, options);
    return t ? std::string{} : t.error().place;
  };
  EXPECT_EQ(place({.map = {{"can0", "v0"}}}), "can0");
  EXPECT_EQ(place({.map = {{"/gnss/0", "v0"}}}), "/gnss/0");
  EXPECT_EQ(place({.receivers = {{"/can/in", kFirst}}}), "/can/in");
  EXPECT_EQ(place({.receivers = {{"/gnss/7", kFirst}}}), "/gnss/7");
  EXPECT_EQ(place({.receivers = {{"/gnss/0", kFirst}, {"/gnss/0", kSecond}}}), "/gnss/0");
  EXPECT_EQ(place({.receivers = {{"/gnss/0", kFirst}, {"/gnss/1", kFirst}}}), "127.0.0.1:3001");
  EXPECT_EQ(place({.speed = 0.0, .interface = "v0"}), "speed");
  EXPECT_FALSE(make_timeline(traffic::Recording{}, {.interface = "v0"}).has_value());
  const auto of_log = make_timeline(log_of({{0, 0}}), {.receivers = {{"/gnss/0", kFirst}}});
  ASSERT_FALSE(of_log.has_value());
  EXPECT_EQ(of_log.error().place, "/gnss/0");
}

}  // namespace
}  // namespace pitwall::replay
