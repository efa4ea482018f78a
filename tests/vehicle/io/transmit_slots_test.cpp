// The laws of the way out, against a kernel queue modelled as what it is: a FIFO that forgets
// nothing and moves when it likes.
// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/transmit_slots.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <map>
#include <vector>

#include "tests/support/tick.hpp"
#include "tests/vehicle/safety/situation.hpp"

namespace pitwall::io {
namespace {

constexpr Instant kStart{seconds(1).ns};
constexpr std::uint32_t kFrameBytes = 768;

// A command that says when it was made.
can::Frame command(std::uint32_t id, Instant made) {
  can::Frame frame;
  frame.id = id;
  frame.length = 8;
  for (unsigned i = 0; i < 8; ++i)
    frame.data[i] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(made.ns) >> (8 * i));
  return frame;
}

Instant made_at(const can::Frame& frame) {
  std::uint64_t ns = 0;
  for (unsigned i = 0; i < 8; ++i) ns |= std::uint64_t{frame.data[i]} << (8 * i);
  return {static_cast<std::int64_t>(ns)};
}

struct Kernel {
  std::size_t room = 12;
  std::deque<can::Frame> queue;
  std::vector<can::Frame> wire;

  std::size_t take(std::span<const can::Frame> frames) {
    std::size_t taken = 0;
    for (; taken < frames.size() && queue.size() < room; ++taken) queue.push_back(frames[taken]);
    return taken;
  }
  void move(std::size_t frames) {
    for (; frames > 0 && !queue.empty(); --frames) {
      wire.push_back(queue.front());
      queue.pop_front();
    }
  }
  KernelQueue state(bool flushed = false) const {
    return {static_cast<std::uint32_t>(queue.size()) * kFrameBytes, flushed};
  }
};

std::vector<can::Frame> tick_frames(Instant now) {
  return {command(0x100, now), command(0x200, now), command(0x300, now)};
}

// One tick of CarIo: observe the queue, offer, send.
void tick(TransmitSlots& slots, Kernel& kernel, Instant now, bool flushed = false) {
  slots.observe_queue(kernel.state(flushed), now);
  slots.offer(tick_frames(now), now);
  const auto due = slots.due(now);
  slots.taken(kernel.take(due), now);
}

TEST(TransmitSlots, OnAFreeBusEverythingGoesOutAtOnceInItsOrder) {
  TransmitSlots slots;
  Kernel kernel;
  std::vector<can::Frame> wanted;
  for (int i = 0; i < 100; ++i) {
    const Instant now = kStart + i * kTick;
    tick(slots, kernel, now);
    kernel.move(10);
    for (const can::Frame& frame : tick_frames(now)) wanted.push_back(frame);
    ASSERT_EQ(slots.stalled(now), Duration{});
  }
  EXPECT_EQ(kernel.wire, wanted);
  EXPECT_EQ(slots.counters().taken, 300u);
  EXPECT_EQ(slots.counters().dropped(), 0u);
}

TEST(TransmitSlots, AfterAStallOnlyTheNewestOfEachIdFollowsWhatTheKernelHad) {
  TransmitSlots slots;
  Kernel kernel;
  Instant now = kStart;
  for (int i = 0; i < 100; ++i, now += kTick) {
    tick(slots, kernel, now);
    EXPECT_EQ(slots.stalled(now), i * kTick);  // grows from the frames that do not leave
    EXPECT_EQ(kernel.queue.size(), 3u);        // and nothing is piled upon them
  }
  EXPECT_EQ(slots.counters().replaced, 98u * 3u);
  kernel.move(10);
  kernel.wire.clear();
  tick(slots, kernel, now);
  kernel.move(10);
  EXPECT_EQ(kernel.wire, tick_frames(now));
  tick(slots, kernel, now + kTick);
  EXPECT_EQ(slots.stalled(now + kTick), Duration{});
}

TEST(TransmitSlots, WithAQueueThatCanBeEmptiedNothingOldGoesOutAtAll) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random{seed};
    TransmitSlots slots;
    Kernel kernel;
    bool moves = true, flushed = false;
    for (Instant now = kStart; now < kStart + seconds(5); now += kTick) {
      if (random.one_in(30)) moves = !moves;
      if (flushed) kernel.queue.clear();
      kernel.wire.clear();
      if (moves) kernel.move(random.below(8));
      for (const can::Frame& frame : kernel.wire)
        // Two ticks until it is stale, one until the flush, one until the queue is observed.
        ASSERT_LE(now - made_at(frame), milliseconds(40)) << "seed " << seed;
      tick(slots, kernel, now, flushed);
      flushed = slots.should_flush(now);
    }
    EXPECT_GT(slots.counters().replaced, 0u);
  }
}

TEST(TransmitSlots, AFlushIsNoProgress) {
  TransmitSlots slots;
  Kernel kernel;
  Instant now = kStart;
  int flushes = 0;
  bool flushed = false;
  for (; now < kStart + seconds(1); now += kTick) {
    if (flushed) kernel.queue.clear();
    tick(slots, kernel, now, flushed);
    flushed = slots.should_flush(now);
    flushes += flushed ? 1 : 0;
    ASSERT_EQ(slots.stalled(now), now - kStart);
  }
  EXPECT_GT(flushes, 10);
}

TEST(TransmitSlots, ARefusedFrameWaitsForItsSuccessorOrUntilItIsStale) {
  TransmitSlots slots;
  Kernel closed{.room = 0, .queue = {}, .wire = {}};
  const can::Frame once = command(0x400, kStart);
  slots.observe_queue({}, kStart);
  slots.offer(std::span(&once, 1), kStart);
  EXPECT_EQ(slots.due(kStart).size(), 1u);
  slots.taken(0, kStart);
  EXPECT_EQ(slots.counters().not_taken, 1u);
  const Instant next = kStart + kTick;
  tick(slots, closed, next);
  EXPECT_EQ(slots.due(next).size(), 4u);  // the tick's own first, then what was left
  EXPECT_EQ(slots.due(next).back().id, 0x400u);
  const Instant later = kStart + milliseconds(20);  // stale: two ticks old
  tick(slots, closed, later);
  EXPECT_EQ(slots.due(later).size(), 3u);
  EXPECT_EQ(slots.counters().stale, 1u);
  EXPECT_EQ(slots.counters().replaced, 3u);
  EXPECT_EQ(slots.stalled(later), milliseconds(20));
}

TEST(TransmitSlots, EveryFrameIsTakenReplacedStaleWithoutRoomOrStillThere) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random{seed};
    TransmitSlots slots;
    Kernel kernel{.room = 5 + random.below(60), .queue = {}, .wire = {}};
    Instant now = kStart;
    for (int i = 0; i < 300; ++i) {
      now += milliseconds(static_cast<std::int64_t>(1 + random.below(15)));
      slots.observe_queue(kernel.state(), now);
      std::vector<can::Frame> frames;
      for (std::uint64_t n = random.below(90); n > 0; --n)
        frames.push_back(command(static_cast<std::uint32_t>(random.below(80)), now));
      slots.offer(frames, now);
      const auto due = slots.due(now);
      std::map<std::uint32_t, int> ids;
      for (const can::Frame& frame : due) {
        ASSERT_EQ(++ids[frame.id], 1) << "seed " << seed;
        ASSERT_LE(now - made_at(frame), milliseconds(20)) << "seed " << seed;
      }
      slots.taken(kernel.take(due), now);
      kernel.move(random.below(60));
    }
    now += seconds(1);
    slots.observe_queue({}, now);
    ASSERT_TRUE(slots.due(now).empty());
    const TransmitCounters& c = slots.counters();
    EXPECT_EQ(c.offered, c.taken + c.replaced + c.stale + c.no_room) << "seed " << seed;
  }
}

}  // namespace
}  // namespace pitwall::io
