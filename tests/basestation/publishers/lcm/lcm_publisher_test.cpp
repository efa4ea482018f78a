// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/lcm/lcm_publisher.hpp"

#include <gtest/gtest.h>

#include <condition_variable>
#include <map>
#include <mutex>

#include "protocol/telemetry/export/lcm_schema.hpp"

namespace pitwall::publishers::lcm {
namespace {

using recorder::Topic;
using telemetry::Group;

// A network that can be held up.
struct Network {
  std::mutex lock;
  std::condition_variable changed;
  std::map<std::string, std::vector<std::vector<std::uint8_t>>> received;
  bool open = true, takes = true, waiting = false;

  LcmPublisher::Publish publish() {
    return [this](const std::string& channel, std::span<const std::uint8_t> message) {
      std::unique_lock hold(lock);
      waiting = true;
      changed.notify_all();
      changed.wait(hold, [this] { return open; });
      waiting = false;
      if (takes) received[channel].emplace_back(message.begin(), message.end());
      return takes;
    };
  }
  void set_open(bool now) {
    const std::lock_guard hold(lock);
    open = now;
    changed.notify_all();
  }
  void until_waiting() {
    std::unique_lock hold(lock);
    changed.wait(hold, [this] { return waiting; });
  }
};

const recorder::ClockMap kClock{.utc_minus_base = seconds(1'700'000'000), .boot = "b"};

telemetry::Snapshot state_with_ego() {
  telemetry::Snapshot state;
  state.values[telemetry::field("ego.vx")] = 50.0;
  state.at(Group::kEgo) = Instant{seconds(1).ns};
  return state;
}
telemetry::GroupSet groups() {
  telemetry::GroupSet set;
  set.add(Group::kEgo);
  set.add(Group::kTyres);  // never sampled
  return set;
}

TEST(LcmPublisher, AGroupAndATextArePublishedAsTheLogHasThem) {
  Network network;
  const telemetry::Snapshot state = state_with_ego();
  {
    LcmPublisher publisher{network.publish(), kClock, "/car7"};
    publisher.feed().sample(state, groups(), Instant{seconds(2).ns});
    publisher.text(Topic::kMark, Instant{5}, "{}");
  }  // what waits is published before it ends
  ASSERT_EQ(network.received.size(), 2U);
  const recorder::LcmEncoder encoder{kClock};
  std::vector<std::uint8_t> wanted;
  const auto bytes = recorder::encode(Group::kEgo, state.values);
  encoder.encode({.channel = recorder::channel_of(Group::kEgo),
                  .logged = {},
                  .published = state.at(Group::kEgo),
                  .data = bytes.span()},
                 wanted);
  EXPECT_EQ(network.received["/car7/car/ego"].at(0), wanted);
  EXPECT_EQ(network.received["/car7/base/mark"].size(), 1U);
}

TEST(LcmPublisher, ANetworkThatStallsCostsTheOldestAndEveryChannelIsCounted) {
  Network network;
  network.set_open(false);
  constexpr std::uint64_t kSent = 1'000;
  service::PublisherFigures figures;
  {
    LcmPublisher publisher{network.publish(), kClock, ""};
    publisher.feed().sample(state_with_ego(), groups(), Instant{});
    network.until_waiting();  // it is in the middle of the first one
    for (std::uint64_t i = 1; i < kSent; ++i) {
      publisher.feed().sample(state_with_ego(), groups(), Instant{});
    }
    figures = *publisher.figures();
    network.set_open(true);
  }
  ASSERT_EQ(figures.dropped.size(), 2U);
  EXPECT_EQ(figures.dropped[0].first, "/car/ego");
  EXPECT_EQ(figures.dropped[0].second, kSent - 1 - feed::Feed::kItems);
  EXPECT_EQ(network.received["/car/ego"].size(), 1 + feed::Feed::kItems);
}

TEST(LcmPublisher, WhatTheNetworkDoesNotTakeIsCounted) {
  Network network;
  network.takes = false;
  LcmPublisher publisher{network.publish(), kClock, ""};
  for (int i = 0; i < 3; ++i) publisher.text(Topic::kMark, Instant{}, "{}");
  while (publisher.figures()->failed < 3) std::this_thread::yield();
  EXPECT_EQ(publisher.figures()->sent, 0U);
}

}  // namespace
}  // namespace pitwall::publishers::lcm
