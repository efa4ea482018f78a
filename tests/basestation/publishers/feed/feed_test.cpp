// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/feed/feed.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"

namespace pitwall::publishers::feed {
namespace {

using recorder::Topic;
using telemetry::Group;

telemetry::GroupSet groups(std::initializer_list<Group> some) {
  telemetry::GroupSet set;
  for (const Group group : some) set.add(group);
  return set;
}

bool readable(const Feed& feed, Duration wait = {}) {
  const int fd = feed.fd();
  return transport::wait_readable({&fd, 1}, transport::monotonic_now() + wait) != 0;
}

TEST(Feed, WhatIsPushedIsTakenOnceAndInOrder) {
  Feed feed;
  EXPECT_FALSE(readable(feed));
  telemetry::Snapshot state;
  state.values[telemetry::field("ego.vx")] = 50.0;
  feed.sample(state, groups({Group::kEgo}), Instant{7});
  feed.text(Topic::kMark, Instant{8}, "{}");
  EXPECT_TRUE(readable(feed));
  const auto items = feed.take();
  ASSERT_EQ(items.size(), 2U);
  const Sample& sample = *std::get<std::unique_ptr<const Sample>>(items[0]);
  EXPECT_EQ(sample.state.values[telemetry::field("ego.vx")], 50.0);
  EXPECT_EQ(sample.received, Instant{7});
  EXPECT_EQ(std::get<Reported>(items[1]).json, "{}");
  EXPECT_FALSE(readable(feed));
  EXPECT_TRUE(feed.take().empty());
}

TEST(Feed, APacketWithoutAGroupIsNoSample) {
  Feed feed;
  feed.sample({}, {}, Instant{});
  EXPECT_TRUE(feed.take().empty());
}

TEST(Feed, OfTooManyTheOldestGoesAndEachOfItsGroupsIsCounted) {
  Feed feed;
  for (std::size_t i = 0; i < Feed::kItems; ++i) {
    feed.sample({}, groups({Group::kEgo, Group::kMode}), Instant{static_cast<std::int64_t>(i)});
  }
  for (int i = 0; i < 3; ++i) feed.text(Topic::kLink, Instant{}, "{}");
  const ChannelCounts drops = feed.drops();
  EXPECT_EQ(drops[recorder::channel_of(Group::kEgo)], 3U);
  EXPECT_EQ(drops[recorder::channel_of(Group::kMode)], 3U);
  EXPECT_EQ(drops[recorder::channel_of(Group::kTyres)], 0U);
  EXPECT_EQ(drops[recorder::channel_of(Topic::kLink)], 0U);
  const auto items = feed.take();
  ASSERT_EQ(items.size(), Feed::kItems);
  EXPECT_EQ(std::get<std::unique_ptr<const Sample>>(items[0])->received, Instant{3});
}

TEST(Feed, WhatTheBaseFindsIsHandedOnToo) {
  Feed feed;
  auto base_status = std::make_unique<BaseStatus>();
  base_status->at = Instant{5};
  feed.base_status(std::move(base_status));
  const auto items = feed.take();
  ASSERT_EQ(items.size(), 1U);
  EXPECT_EQ(std::get<std::unique_ptr<const BaseStatus>>(items[0])->at, Instant{5});
  for (std::size_t i = 0; i < Feed::kItems + 2; ++i)
    feed.base_status(std::make_unique<BaseStatus>());
  EXPECT_EQ(feed.drops()[kStatusChannel], 2U);
}

TEST(Feed, TextsAreBoundedByTheirBytesToo) {
  Feed feed;
  const std::string text(Feed::kTextBytes / 4, 'x');
  for (int i = 0; i < 6; ++i) feed.text(Topic::kAlarms, Instant{i}, text);
  EXPECT_EQ(feed.drops()[recorder::channel_of(Topic::kAlarms)], 2U);
  const auto items = feed.take();
  ASSERT_EQ(items.size(), 4U);
  EXPECT_EQ(std::get<Reported>(items[0]).at, Instant{2});
  feed.text(Topic::kAlarms, Instant{9}, std::string(2 * Feed::kTextBytes, 'x'));
  EXPECT_EQ(feed.take().size(), 1U) << "one alone is always kept";
}

TEST(Feed, AnotherThreadGetsAllThatIsNotCountedAsLost) {
  constexpr std::int64_t kSent = 20'000;
  Feed feed;
  std::int64_t got = 0, newest = -1;
  std::thread reader{[&] {
    for (bool more = true; more;) {
      readable(feed, seconds(20));
      more = !feed.closed();
      for (const Item& item : feed.take()) {
        const Instant at = std::get<Reported>(item).at;
        EXPECT_GT(at.ns, newest);
        newest = at.ns;
        ++got;
      }
    }
  }};
  for (std::int64_t i = 0; i < kSent; ++i) feed.text(Topic::kMark, Instant{i}, "{}");
  feed.close();
  reader.join();
  const auto lost = static_cast<std::int64_t>(feed.drops()[recorder::channel_of(Topic::kMark)]);
  EXPECT_EQ(got + lost, kSent);
  EXPECT_EQ(newest, kSent - 1);
  EXPECT_TRUE(readable(feed)) << "a closed feed never puts its reader to sleep";
}

}  // namespace
}  // namespace pitwall::publishers::feed
