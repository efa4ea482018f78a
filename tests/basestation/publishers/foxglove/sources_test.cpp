// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/foxglove/sources.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace pitwall::publishers::foxglove {
namespace {

using recorder::Topic;
using telemetry::field;
using telemetry::Group;

const recorder::ClockMap kClock{.utc_minus_base = seconds(1'700'000'000), .boot = "b"};

struct Taken {
  UtcTime at{};
  std::vector<std::uint8_t> body;
};

class FoxgloveSources : public testing::Test {
 protected:
  Sources::Sink sink() {
    return [this](std::size_t channel, UtcTime at, std::span<const std::uint8_t> body) {
      taken_[sources_.channels()[channel].topic] = {at, {body.begin(), body.end()}};
    };
  }
  const ChannelRow* row(const std::string& topic) const {
    for (const ChannelRow& row : sources_.channels()) {
      if (row.topic == topic) return &row;
    }
    return nullptr;
  }
  static feed::Sample everything() {
    feed::Sample sample{.received = Instant{seconds(5).ns}};
    for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
      sample.state.at(row.group) = Instant{seconds(4).ns};
      sample.groups.add(row.group);
    }
    for (telemetry::FieldIndex i = 0; i < telemetry::kFieldCount; ++i) {
      sample.state.values[i] = telemetry::kFields[i].min;
    }
    return sample;
  }

  Sources sources_{{}, kClock};
  std::map<std::string, Taken> taken_;
};

TEST_F(FoxgloveSources, TheChannelsOfARecordingHaveTheNamesAndSchemasOfTheRecording) {
  const auto recorded = recorder::channels();
  for (std::size_t i = 0; i < telemetry::kGroups + recorder::kTopics; ++i) {
    const ChannelRow* const channel = row(recorded[i].topic);
    ASSERT_NE(channel, nullptr) << recorded[i].topic;
    EXPECT_EQ(channel->schema, recorded[i].schema.text);
    EXPECT_EQ(channel->encoding, recorded[i].message_encoding);
  }
}

TEST_F(FoxgloveSources, NoTopicStandsTwice) {
  std::set<std::string> topics;
  for (const ChannelRow& channel : sources_.channels()) {
    EXPECT_TRUE(topics.insert(channel.topic).second) << channel.topic;
    EXPECT_FALSE(channel.schema.empty()) << channel.topic;
  }
  EXPECT_NE(row("/vehicle/odom"), nullptr);
  EXPECT_NE(row("/base/values/link"), nullptr);
}

TEST_F(FoxgloveSources, AStateBecomesTheRecordingsBytesAndTheStandardMessages) {
  const feed::Sample sample = everything();
  sources_.take(sample, sink());
  const auto bytes = recorder::encode(Group::kEgo, sample.state.values);
  ASSERT_TRUE(taken_.contains("/car/ego"));
  EXPECT_TRUE(std::ranges::equal(taken_["/car/ego"].body, bytes.span()));
  EXPECT_EQ(taken_["/car/ego"].at, UtcTime{seconds(1'700'000'005).ns}) << "as it was received";
  EXPECT_TRUE(taken_.contains("/gnss/top/fix"));
  for (const auto& [topic, message] : taken_) EXPECT_FALSE(message.body.empty()) << topic;
}

TEST_F(FoxgloveSources, AGroupThatIsNotNewIsNotRepeated) {
  feed::Sample sample = everything();
  sample.groups = {};
  sample.groups.add(Group::kTyres);
  sources_.take(sample, sink());
  ASSERT_EQ(taken_.size(), 1U);
  EXPECT_TRUE(taken_.contains("/car/tyres"));
}

TEST_F(FoxgloveSources, ATextIsToldAsItIs) {
  sources_.take(feed::Reported{.topic = Topic::kAlarms, .at = Instant{1}, .json = "{\"a\":1}"},
                sink());
  const auto& body = taken_.at("/base/alarms").body;
  EXPECT_EQ(std::string(body.begin(), body.end()), "{\"a\":1}");
  EXPECT_TRUE(row("/base/alarms")->latched);
  EXPECT_FALSE(row("/base/audit")->latched);
}

TEST_F(FoxgloveSources, WhatTheBaseFindsHasItsValues) {
  feed::BaseStatus base_status{.at = Instant{seconds(1).ns}};
  base_status.values[state::index_of(state::BaseField::kRoundTrip)] = 5.0;
  sources_.take(base_status, sink());
  EXPECT_TRUE(taken_.contains("/base/values/link"));
  EXPECT_FALSE(taken_.contains("/base/values/derived")) << "nothing of it is known";
  EXPECT_TRUE(taken_.contains("/diagnostics"));
}

TEST_F(FoxgloveSources, OfSeveralCarsEachHasItsSpace) {
  const Sources seven{{.space = "/car7"}, kClock};
  for (const ChannelRow& channel : seven.channels()) {
    const bool common = channel.topic == "/tf" || channel.topic == "/tf_static";
    EXPECT_TRUE(common || channel.topic.starts_with("/car7/")) << channel.topic;
  }
}

}  // namespace
}  // namespace pitwall::publishers::foxglove
