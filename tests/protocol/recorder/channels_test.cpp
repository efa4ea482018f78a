// SPDX-License-Identifier: Apache-2.0
#include "protocol/recorder/channels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace pitwall::recorder {
namespace {

telemetry::Values numbered() {
  telemetry::Values values;
  for (std::size_t i = 0; i < telemetry::kFieldCount; i += 1 + i % 3) {
    values[i] = 0.1 * static_cast<double>(i) - 3.0;
  }
  return values;
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

TEST(Channels, EveryGroupAndTopicHasItsPlaceAndNoTwoShareAName) {
  const auto all = channels();
  std::set<std::string> topics;
  for (const auto& channel : all) topics.insert(channel.topic);
  EXPECT_EQ(topics.size(), all.size());
  EXPECT_EQ(all[channel_of(telemetry::Group::kEgo)].topic, "/car/ego");
  EXPECT_EQ(all[channel_of(Topic::kAudit)].topic, "/base/audit");
  EXPECT_EQ(all[kSnapshotChannel].topic, "/base/picture");
  EXPECT_EQ(all[kUpChannel].topic, "/radio/up");
  EXPECT_EQ(all[kUpChannel].message_encoding, "x-pitwall-datagram");
  EXPECT_EQ(all[kReceiverChannel + 1].topic, "/gnss/1");
  for (const std::string_view name : kTopicNames) EXPECT_EQ(name_of(*topic_named(name)), name);
  EXPECT_FALSE(topic_named("nothing"));
}

TEST(Channels, AGroupComesBackToTheBit) {
  const auto all = channels();
  const telemetry::Values values = numbered();
  telemetry::Values back;
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
    const auto fields = ChannelFields::of(all[channel_of(row.group)]);
    ASSERT_TRUE(fields);
    EXPECT_EQ(fields->group(), row.group);
    ASSERT_TRUE(fields->decode(encode(row.group, values).span(), back));
  }
  for (std::size_t i = 0; i < telemetry::kFieldCount; ++i) {
    EXPECT_TRUE(same(back[i], values[i])) << i;
  }
}

TEST(Channels, APictureKeepsTheLastKnownValueOfEachField) {
  const auto all = channels();
  telemetry::Values values = numbered();
  Known known;
  constexpr auto kGroup = telemetry::Group::kTyres;
  const auto first = telemetry::fields_of(kGroup).first;
  values[first] = 81.5;
  known.take(kGroup, encode(kGroup, values).span(), Instant{100});
  values[first] = kUnset;
  values[first + 1] = 7.25;
  known.take(kGroup, encode(kGroup, values).span(), Instant{200});
  Known back;
  const auto fields = ChannelFields::of(all[kSnapshotChannel]);
  ASSERT_TRUE(fields && fields->is_snapshot());
  ASSERT_TRUE(fields->decode(encode(known), back));
  EXPECT_EQ(back.value[first], 81.5);
  EXPECT_EQ(back.sampled[first], Instant{100});
  EXPECT_EQ(back.value[first + 1], 7.25);
  EXPECT_EQ(back.sampled[first + 1], Instant{200});
  EXPECT_EQ(back.sampled.back(), telemetry::kNeverSampled);
}

TEST(Channels, AFileOfAnotherRegistryGivesTheFieldsThatBothHave) {
  recording::Channel channel = channels()[channel_of(telemetry::Group::kFuel)];
  std::string& names = channel.metadata.front().second;
  const std::size_t fields = telemetry::fields_of(telemetry::Group::kFuel).count;
  names = "fuel.of_tomorrow," + names;
  const auto theirs = ChannelFields::of(channel);
  ASSERT_TRUE(theirs);
  std::vector<std::uint8_t> sample{0, 1, 0, 0};
  sample.resize(kCdrHeader + (fields + 1) * sizeof(double));
  sample[kCdrHeader + 14] = 0xF0;  // the second number is 1.0
  sample[kCdrHeader + 15] = 0x3F;
  telemetry::Values values;
  ASSERT_TRUE(theirs->decode(sample, values));
  EXPECT_EQ(values[telemetry::fields_of(telemetry::Group::kFuel).first], 1.0);
}

TEST(Channels, BytesOfAnotherLengthOrEncodingGiveNothing) {
  const auto fields = ChannelFields::of(channels()[channel_of(telemetry::Group::kEgo)]);
  const GroupBytes whole = encode(telemetry::Group::kEgo, numbered());
  telemetry::Values values;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_FALSE(fields->decode(whole.span().first(length), values));
  }
  std::vector<std::uint8_t> other(whole.span().begin(), whole.span().end());
  other[1] = 0;  // most significant byte first
  EXPECT_FALSE(fields->decode(other, values));
  EXPECT_TRUE(std::isnan(values[telemetry::fields_of(telemetry::Group::kEgo).first]));
}

TEST(Channels, TheClockComesBackExactly) {
  recording::Metadata run;
  const ClockMap clock{.utc_minus_base = {1'700'000'000'123'456'789}, .boot = "a boot"};
  append(run, clock);
  const auto back = clock_of(run);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->utc_minus_base, clock.utc_minus_base);
  EXPECT_EQ(back->boot, clock.boot);
  EXPECT_EQ(clock.to_base(clock.to_file(Instant{-5})), Instant{-5});
  run.front().second += "x";
  EXPECT_FALSE(clock_of(run));
  EXPECT_FALSE(clock_of({}));
}

}  // namespace
}  // namespace pitwall::recorder
