// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/console/snapshots.hpp"

#include <gtest/gtest.h>

#include <map>

#include "tests/basestation/publishers/console/fake_state_source.hpp"
#include "tests/basestation/publishers/console/now.hpp"

namespace pitwall::publishers::console {
namespace {

using telemetry::field;

TEST(Snapshots, TheFirstIsWhole) {
  FakeStateSource source;
  Snapshots snapshots;
  const auto frame = snapshots.make(source, kNow);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->count, reported_fields().size());
  EXPECT_EQ(frame->flags & web::kFullPicture, web::kFullPicture);
  EXPECT_EQ(frame->entries.size(), frame->count * web::kSnapshotEntry);
}

TEST(Snapshots, PacketsOfFiftyASecondMakeTwentyFiveFramesEachAtItsPacket) {
  FakeStateSource source;
  Snapshots snapshots;
  int frames = 0;
  for (int tick = 0; tick < 10'000; ++tick) {  // ms
    const Instant now = kNow + milliseconds(tick);
    const bool packet = tick % 20 == 7;
    if (packet) {
      source.show(field("ego.x"), tick, now);
      snapshots.receive();
    }
    if (!packet && now < snapshots.due()) continue;
    if (!snapshots.make(source, now)) continue;
    ++frames;
    EXPECT_TRUE(packet || frames == 1) << tick;
  }
  EXPECT_NEAR(frames, 250, 2);
}

TEST(Snapshots, WithoutPacketsValuesAreSeenToGrowOld) {
  FakeStateSource source;
  source.show(field("ego.x"), 1.0, kNow);
  Snapshots snapshots;
  int frames = 0;
  for (int tick = 0; tick < 1'000; ++tick) {
    if (snapshots.make(source, kNow + milliseconds(tick))) ++frames;
  }
  EXPECT_NEAR(frames, 20, 2);
}

TEST(Snapshots, ASafetyValueIsToldAtOnceAndItsAgeIsNot) {
  FakeStateSource source;
  source.show(field("mode.mode"), 2.0, kNow);
  source.show(field("uplink.link_age"), 0.1, kNow);
  Snapshots snapshots;
  ASSERT_TRUE(snapshots.make(source, kNow));
  source.show(field("mode.mode"), 2.0, kNow + milliseconds(5));
  source.show(field("uplink.link_age"), 0.2, kNow + milliseconds(5));
  snapshots.receive();
  EXPECT_FALSE(snapshots.make(source, kNow + milliseconds(5)));
  source.show(field("mode.mode"), 3.0, kNow + milliseconds(6));
  snapshots.receive();
  const auto frame = snapshots.make(source, kNow + milliseconds(6));
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->flags, web::kAtOnce);
  EXPECT_EQ(frame->entries[0], field("mode.mode"));
}

// A reader that takes every frame has at any time exactly what a new whole picture has.
TEST(Snapshots, WhatIsToldAddsUpToTheWholePicture) {
  FakeStateSource source;
  Snapshots snapshots;
  std::map<int, std::vector<std::uint8_t>> known;
  const auto take = [&](const Frame& frame) {
    for (std::size_t i = 0; i < frame.count; ++i) {
      const auto* at = &frame.entries[i * web::kSnapshotEntry];
      known[at[0] | at[1] << 8] = {at, at + web::kSnapshotEntry};
    }
  };
  for (int round = 0; round < 200; ++round) {
    const Instant now = kNow + milliseconds(40) * round;
    source.show(field("ego.x"), round / 3, now);
    if (round % 7 == 0) source.show(field("tyres.pressure_rear_left"), round, now);
    snapshots.receive();
    const auto frame = snapshots.make(source, now);
    ASSERT_TRUE(frame);
    take(*frame);
    Snapshots fresh;
    const auto whole = fresh.make(source, now);
    for (std::size_t i = 0; i < whole->count; ++i) {
      const auto* at = &whole->entries[i * web::kSnapshotEntry];
      ASSERT_EQ(known[at[0] | at[1] << 8], std::vector<std::uint8_t>(at, at + web::kSnapshotEntry))
          << "round " << round;
    }
  }
}

}  // namespace
}  // namespace pitwall::publishers::console
