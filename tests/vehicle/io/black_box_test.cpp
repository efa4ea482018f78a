// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/black_box.hpp"

#include <gtest/gtest.h>

#include <map>

#include "protocol/recorder/can_record.hpp"
#include "protocol/recorder/segment_folder.hpp"
#include "protocol/recording/lcm_log.hpp"
#include "protocol/recording/mcap_reader.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/bytes.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/tick.hpp"

namespace pitwall::io {
namespace {

constexpr std::uint64_t kTicks = 300;

struct Ticks {
  std::vector<can::ReceivedFrame> received{{.frame = {.id = 0x11, .length = 8}, .at = {}},
                                           {.frame = {.id = 0x12, .length = 4}, .at = {}}};
  world::SensorInput sensors;
  std::vector<can::Frame> sent{{.id = 0x21, .length = 8}};
  telemetry::Snapshot state;
  std::vector<std::uint8_t> air = std::vector<std::uint8_t>(200, 0x5A);

  void turn(BlackBox& box, std::uint64_t tick, Instant now) {
    for (can::ReceivedFrame& frame : received) frame.at = now - milliseconds(1);
    state.sampled_at.fill(now);
    state.values.at.fill(static_cast<double>(tick));
    box.tick({.now = now, .can = received, .sensors = sensors, .requests = {}}, sent);
    box.radio(true, now, {.path = 1, .bytes = air});
    box.radio(false, now, {.bytes = air});
    box.receiver(tick % 2, now, air);
    if (box.state_due(tick)) box.state(state, now);
    if (tick % 100 == 0) box.event("radio, seen by the car: something", now);
  }
};

struct Kept {
  std::map<std::string, std::uint64_t> messages;
  std::uint64_t events = 0;
};
Kept kept_in(const std::string& folder) {
  Kept kept;
  const auto paths = recorder::segments_of(folder);
  for (const std::string& path : *paths) {
    const auto file = transport::read_file(path);
    recording::McapReader reader{as_bytes(*file)};
    while (const auto m = reader.next()) ++kept.messages[reader.channels().at(m->channel).topic];
    EXPECT_EQ(reader.end(), recording::McapEnd::kComplete);
    const auto log = transport::read_file(path.substr(0, path.size() - 5) + ".lcm");
    EXPECT_TRUE(log) << path;
    recording::LcmLogReader events{as_bytes(*log)};
    while (events.next()) ++kept.events;
  }
  return kept;
}

TEST(BlackBox, KeepsEveryFrameAndTheStateAndItsTurnsAllocateNothing) {
  const auto folder = transport::TemporaryFolder::create("pitwall_black_box");
  Ticks ticks;
  {
    auto box = BlackBox::open(folder->path(), {});
    ASSERT_TRUE(box);
    const Instant begun = transport::monotonic_now();
    std::size_t allocations = 0;
    for (std::uint64_t tick = 0; tick < kTicks; ++tick) {
      const Instant now = begun + kTick * static_cast<std::int64_t>(tick);
      allocations += testing::allocations_of([&] { ticks.turn(*box, tick, now); });
    }
    EXPECT_EQ(allocations, 0U);
    EXPECT_NE(box->json().find(R"("dropped": 0,)"), std::string::npos) << box->json();
  }
  Kept kept = kept_in(folder->path());
  EXPECT_EQ(kept.messages["/can/in"], 2 * kTicks);
  EXPECT_EQ(kept.messages["/can/out"], kTicks);
  EXPECT_EQ(kept.messages["/car/tick"], kTicks);
  EXPECT_EQ(kept.messages["/car/ego"], kTicks / BlackBox::kStateEvery);
  EXPECT_EQ(kept.messages["/radio/down"], kTicks);
  EXPECT_EQ(kept.messages["/radio/up"], kTicks);
  EXPECT_EQ(kept.messages["/gnss/0"], kTicks / 2);
  EXPECT_EQ(kept.messages["/base/event"], kTicks / 100);
  EXPECT_EQ(kept.messages["/gnss/1"], kTicks / 2);
  std::uint64_t messages = 0;
  for (const auto& [topic, count] : kept.messages)
    messages += topic == "/base/picture" || topic == "/car/tick" ? 0 : count;
  EXPECT_EQ(kept.events, messages);
}

TEST(BlackBox, WhatDoesNotFitIsCountedAndNobodyWaits) {
  const auto folder = transport::TemporaryFolder::create("pitwall_black_box");
  auto box = BlackBox::open(folder->path(), {});
  ASSERT_TRUE(box);
  Ticks ticks;
  const Instant now = transport::monotonic_now();
  for (std::uint64_t tick = 0; tick < 20'000; ++tick) ticks.turn(*box, tick, now);
  EXPECT_EQ(box->json().find(R"("dropped": 0,)"), std::string::npos) << box->json();
}

TEST(BlackBox, WithoutAFolderItIsOffAndABadFolderIsRefused) {
  auto off = BlackBox::open("", {});
  ASSERT_TRUE(off);
  EXPECT_FALSE(off->on());
  Ticks{}.turn(*off, 0, {});
  EXPECT_EQ(off->json(), "{}");
  EXPECT_FALSE(BlackBox::open("/proc/nothing/here", {}));
}

}  // namespace
}  // namespace pitwall::io
