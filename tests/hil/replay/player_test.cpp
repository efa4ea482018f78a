// The player on I/O in virtual time: every rule of the schedule, without a clock or a bus.
// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/player.hpp"

#include <gtest/gtest.h>

#include <random>

namespace pitwall::replay {
namespace {

struct Sent {
  std::size_t bus, frame;
  Instant at;
};

// Wakes up late by what `latency` says, and by `stall` once, at the first wake-up after `stall_at`;
// takes at most `room` frames per call. Each look at the clock takes `look`.
struct VirtualIo {
  Instant time{};
  Duration latency{}, call{}, look{};
  std::size_t room = SIZE_MAX;
  bool room_again = true;  // a full queue empties by itself
  std::size_t stop_after = SIZE_MAX;
  Instant stall_at{INT64_MAX};
  Duration stall{};
  std::vector<Sent> sent{};
  int looks = 0, waits = 0, sends = 0;

  Instant now() { return ++looks, time = time + look; }
  void wait_until(Instant deadline) {
    ++waits;
    time = std::max(time, deadline) + latency;
    if (time < stall_at) return;
    time = time + stall;
    stall_at = {INT64_MAX};
  }
  TrackOutcome send(std::size_t bus, std::size_t first, std::size_t count) {
    ++sends;
    time = time + call;
    const std::size_t n = std::min(room, count);
    for (std::size_t i = 0; i < n; ++i) sent.push_back({bus, first + i, time});
    return {.taken = n, .full = room_again};
  }
  bool stopped() const { return sent.size() >= stop_after; }
};

Timeline timeline_of(const std::vector<std::int64_t>& due_us) {
  Timeline t;
  t.tracks.push_back({.target = "a"});
  for (std::size_t i = 0; i < due_us.size(); ++i) {
    can::Frame f;
    f.id = static_cast<std::uint32_t>(i);
    t.tracks[0].frames.push_back(f);
    t.tracks[0].due.push_back(microseconds(due_us[i]));
  }
  t.frames = due_us.size();
  t.pass = t.tracks[0].due.back() + milliseconds(1);
  return t;
}

std::vector<std::int64_t> every_ms(std::int64_t count) {
  std::vector<std::int64_t> due_us;
  for (std::int64_t i = 0; i < count; ++i) due_us.push_back(i * 1'000);
  return due_us;
}

TEST(Player, EveryFrameOnceInOrderNeverEarlierThanAGroup) {
  std::mt19937_64 random(31);
  for (int round = 0; round < 100; ++round) {
    std::vector<std::int64_t> due_us{0};
    for (int i = 0; i < 300; ++i)
      due_us.push_back(due_us.back() + static_cast<std::int64_t>(random() % 400));
    const Timeline t = timeline_of(due_us);
    VirtualIo io{.latency = microseconds(static_cast<std::int64_t>(random() % 300)),
                 .call = microseconds(static_cast<std::int64_t>(random() % 30))};
    const Instant start{seconds(5).ns};
    const auto report = Player(t, {.passes = 3}, io).play(start);
    ASSERT_EQ(io.sent.size(), 3 * due_us.size());
    ASSERT_EQ(report.frames.sent, io.sent.size());
    for (std::size_t i = 0; i < io.sent.size(); ++i) {
      const std::size_t k = i % due_us.size();
      const auto pass = static_cast<std::int64_t>(i / due_us.size());
      const Instant due = start + t.pass * pass + t.tracks[0].due[k];
      ASSERT_EQ(io.sent[i].frame, k);
      ASSERT_GE(io.sent[i].at, due - kGroup);
    }
  }
}

TEST(Player, FramesOfOneGroupAreOneCall) {
  const Timeline t = timeline_of({0, 5, 20, 21, 1'000, 1'020});
  VirtualIo io;
  EXPECT_EQ(Player(t, {}, io).play({}).calls, 3U);  // 0 5 20 | 21 | 1000 1020
}

// In a guest a system call costs 16 us: what a wake-up may cost is a law, not a hope.
TEST(Player, AWakeUpIsOneSleepOneSendAndOneLookAtTheClock) {
  const Timeline t = timeline_of(every_ms(500));
  VirtualIo io{.latency = microseconds(50), .call = microseconds(20), .look = microseconds(16)};
  const Instant start{seconds(1).ns};
  const auto report = Player(t, {}, io).play(start);
  EXPECT_EQ(io.waits, 500);
  EXPECT_EQ(io.sends, 500);
  EXPECT_EQ(io.looks, 501);
  EXPECT_EQ(report.waits, 500U);
  EXPECT_EQ(report.calls, 500U);
  // Nothing but the sleep and the call itself lies between the due time and the bus.
  for (const Sent& sent : io.sent)
    ASSERT_EQ(sent.at - (start + t.tracks[0].due[sent.frame]), microseconds(70));
}

TEST(Player, WhatIsDueAlreadyIsNotSleptFor) {
  const Timeline t = timeline_of({0, 30, 60, 90, 5'000});
  VirtualIo io{.latency = microseconds(100)};
  const auto report = Player(t, {}, io).play({});
  EXPECT_EQ(report.waits, 2U);  // 30 and 5,000: the first is due at the start, the others late
  EXPECT_EQ(io.sent.back().at, Instant{} + microseconds(5'100));
}

TEST(Player, LatenessIsMeasuredFromTheScheduleAndDoesNotAddUp) {
  const Timeline t = timeline_of(every_ms(1'000));
  VirtualIo io{.latency = microseconds(70)};
  const auto report = Player(t, {}, io).play(Instant{seconds(1).ns});
  EXPECT_EQ(report.lateness.count(), 1'000U);
  EXPECT_EQ(report.lateness.latest(), microseconds(70));
  EXPECT_EQ(report.lateness.earliest(), microseconds(70));
  EXPECT_EQ(report.lateness.quantile(0.5), microseconds(71));  // upper edge of its cell
}

TEST(Player, PassesDoNotDriftAndTheSeamIsMeasured) {
  const Timeline t = timeline_of(every_ms(20));
  VirtualIo steady{.latency = microseconds(70)};
  const Instant start{seconds(1).ns};
  auto report = Player(t, {.passes = 1'000}, steady).play(start);
  ASSERT_EQ(steady.sent.size(), 20'000U);
  EXPECT_EQ(steady.sent.back().at,
            start + t.pass * 999 + t.tracks[0].due.back() + microseconds(70));
  EXPECT_EQ(report.seam_error.ns, 0);
  // A stall that strikes the first frame of the third pass is the error of that seam.
  VirtualIo stalled{.latency = microseconds(70)};
  stalled.stall_at = start + t.pass * 2;
  stalled.stall = microseconds(700);
  report = Player(t, {.passes = 5}, stalled).play(start);
  EXPECT_EQ(report.seam_error, microseconds(700));
}

TEST(Player, AFullQueueIsRetriedInOrder) {
  const Timeline t = timeline_of({0, 1, 2, 3, 4, 5, 6, 7});
  VirtualIo io{.room = 3};
  const auto report = Player(t, {}, io).play({});
  ASSERT_EQ(io.sent.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(io.sent[i].frame, i);
  EXPECT_EQ(report.retries, 2U);
  EXPECT_EQ(report.dropped(), 0U);
  EXPECT_EQ(report.lateness.count(), 8U);
}

TEST(Player, ABusThatTakesNothingEndsInDropsNotInAHang) {
  const Timeline t = timeline_of({0, 1, 2});
  VirtualIo io{.room = 0};
  const auto report = Player(t, {}, io).play({});
  EXPECT_EQ(report.frames.sent, 0U);
  EXPECT_EQ(report.frames.dropped_full, 3U);
  EXPECT_GT(report.retries, 0U);
  EXPECT_LE(report.retries, 3U * (kMaxRetry / kRetryPause + 1));
  EXPECT_EQ(report.lateness.count(), 0U);
}

TEST(Player, WhatTheKernelRefusesForGoodIsNotRetried) {
  const Timeline t = timeline_of({0, 1, 2});
  VirtualIo io{.room = 0, .room_again = false};
  const auto report = Player(t, {}, io).play({});
  EXPECT_EQ(report.frames.dropped_refused, 3U);
  EXPECT_EQ(report.retries, 0U);
  EXPECT_EQ(io.waits, 0);
}

// One stall of 10 ms in the middle of a log of one frame a millisecond, under each policy.
class LatePolicies : public testing::Test {
 protected:
  PlayReport play(const PlayOptions& options) {
    io_.stall_at = start_ + milliseconds(50);
    io_.stall = milliseconds(10);
    return Player(timeline_, options, io_).play(start_);
  }
  Timeline timeline_ = timeline_of(every_ms(100));
  Instant start_{seconds(1).ns};
  VirtualIo io_{.latency = microseconds(30)};
};

TEST_F(LatePolicies, CatchUpSendsAllInOrderAndIsOnScheduleAgain) {
  const auto report = play({});
  ASSERT_EQ(io_.sent.size(), 100U);
  for (std::size_t i = 0; i < 100; ++i) ASSERT_EQ(io_.sent[i].frame, i);
  EXPECT_EQ(report.lateness.latest(), milliseconds(10) + microseconds(30));
  EXPECT_EQ(io_.sent.back().at, start_ + milliseconds(99) + microseconds(30));
  EXPECT_EQ(report.calls, 91U);  // the ten that became due meanwhile went out in one
}

TEST_F(LatePolicies, DropLeavesOutExactlyWhatIsTooLateAndNamesIt) {
  const auto report = play({.late = LatePolicy::kDrop, .late_limit = milliseconds(4)});
  // Due at 50 .. 60, looked at at 60.03: 50 .. 56 are later than 4 ms.
  EXPECT_EQ(report.frames.dropped_late, 7U);
  EXPECT_EQ(report.dropped(), 7U);
  EXPECT_EQ(report.frames.sent, 93U);
  ASSERT_EQ(report.dropped_list.size(), 7U);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(report.dropped_list[i].record, 50 + i);
    EXPECT_GT(report.dropped_list[i].late, milliseconds(4));
  }
  for (const Sent& sent : io_.sent) {
    EXPECT_TRUE(sent.frame < 50 || sent.frame > 56) << sent.frame;
    EXPECT_LE(sent.at - (start_ + timeline_.tracks[0].due[sent.frame]), milliseconds(4));
  }
  EXPECT_EQ(report.lateness.count(), 93U);  // what was not sent was not late
  EXPECT_FALSE(report.aborted);
}

TEST_F(LatePolicies, AbortSendsNothingThatIsTooLate) {
  const auto report = play({.late = LatePolicy::kAbort, .late_limit = milliseconds(4)});
  EXPECT_TRUE(report.aborted);
  EXPECT_EQ(report.frames.sent, 50U);
  EXPECT_EQ(report.dropped(), 0U);
}

TEST_F(LatePolicies, WithinTheLimitNothingChanges) {
  for (const LatePolicy policy : {LatePolicy::kDrop, LatePolicy::kAbort}) {
    io_ = VirtualIo{.latency = microseconds(30)};
    const auto report = play({.late = policy, .late_limit = milliseconds(11)});
    EXPECT_EQ(report.frames.sent, 100U);
    EXPECT_FALSE(report.aborted);
  }
}

TEST(Player, MoreDropsThanTheListHoldsAreCountedAllTheSame) {
  const Timeline t = timeline_of(every_ms(1'000));
  VirtualIo io{.time = Instant{seconds(5).ns}};  // the whole schedule has passed
  const auto report =
      Player(t, {.late = LatePolicy::kDrop, .late_limit = milliseconds(1)}, io).play({});
  EXPECT_EQ(report.frames.dropped_late, 1'000U);
  EXPECT_EQ(report.dropped_list.size(), kListedDrops);
  EXPECT_EQ(io.sends, 0);
}

TEST(Player, AStopEndsItBetweenFrames) {
  const Timeline t = timeline_of({0, 1'000, 2'000, 3'000});
  VirtualIo io{.stop_after = 2};
  const auto report = Player(t, {.passes = 100}, io).play({});
  EXPECT_TRUE(report.stopped);
  EXPECT_EQ(report.frames.sent, 2U);
}

TEST(Player, TwoBusesShareOneClock) {
  Timeline t = timeline_of({0, 1'000, 2'000});
  Timeline other = timeline_of({500, 1'005, 9'000});
  t.tracks.push_back(other.tracks[0]);
  VirtualIo io;
  const auto report = Player(t, {}, io).play({});
  EXPECT_EQ(report.frames.sent, 6U);
  EXPECT_EQ(report.waits, 4U);  // 0 is due when it begins; 1,000 and 1,005 share a wake-up
  EXPECT_TRUE(std::is_sorted(io.sent.begin(), io.sent.end(),
                             [](const Sent& a, const Sent& b) { return a.at < b.at; }));
  EXPECT_EQ(io.sent.back().at, Instant{} + microseconds(9'000));
}

// On time, late and with full queues: none ahead of another by more than a group, and what is due
// at the same time in the order of the tracks.
TEST(Player, FramesAndDatagramsOfAllTracksKeepOneOrder) {
  std::mt19937_64 random(47);
  for (int round = 0; round < 100; ++round) {
    Timeline t;
    t.tracks = {{.target = "a"}, {.target = "b"}, {.target = "c", .to = UdpAddress{}}};
    std::int64_t due_us = 0;
    for (int i = 0; i < 400; ++i) {
      Track& track = t.tracks[random() % 3];
      if (random() % 3 != 0) due_us += static_cast<std::int64_t>(random() % 60);
      track.due.push_back(microseconds(due_us));
      ++(track.to ? t.datagrams : t.frames);
    }
    t.pass = microseconds(due_us + 50);
    VirtualIo io{.latency = microseconds(static_cast<std::int64_t>(random() % 90)),
                 .call = microseconds(static_cast<std::int64_t>(random() % 30)),
                 .room = 1 + random() % 4,
                 .stall_at = Instant{} + microseconds(due_us / 3),
                 .stall = milliseconds(static_cast<std::int64_t>(random() % 5))};
    const auto report = Player(t, {.passes = 3}, io).play({});
    EXPECT_EQ(report.frames.sent, 3 * t.frames);
    EXPECT_EQ(report.datagrams.sent, 3 * t.datagrams);
    ASSERT_EQ(io.sent.size(), 3 * t.size());
    const auto place = [&](const Sent& sent) { return t.tracks[sent.bus].due[sent.frame]; };
    for (std::size_t i = 0; i < io.sent.size(); ++i) {
      const std::size_t pass_end = (i / t.size() + 1) * t.size();
      for (std::size_t j = i + 1; j < pass_end; ++j) {
        ASSERT_GE(place(io.sent[j]), place(io.sent[i]) - kGroup);
        if (place(io.sent[j]) == place(io.sent[i])) {
          ASSERT_GE(io.sent[j].bus, io.sent[i].bus) << round << ": " << i << ", " << j;
        }
      }
    }
  }
}

TEST(Player, DroppedDatagramsAreCountedApartFromFrames) {
  Timeline t = timeline_of(every_ms(3));
  t.tracks.push_back({.target = "r", .due = t.tracks[0].due, .to = UdpAddress{}});
  VirtualIo io{.room = 0, .room_again = false};
  const auto report = Player(t, {.passes = 2}, io).play({});
  EXPECT_EQ(report.frames.dropped_refused, 6U);
  EXPECT_EQ(report.datagrams.dropped_refused, 6U);
  EXPECT_EQ(report.dropped(), 12U);
}

// Remembers for which pass each frame was prepared last.
struct PreparingIo : VirtualIo {
  std::vector<unsigned> prepared_for, sent_for;
  std::size_t position = 0;
  unsigned preparing = 0;

  TrackOutcome send(std::size_t bus, std::size_t first, std::size_t count) {
    const TrackOutcome outcome = VirtualIo::send(bus, first, count);
    for (std::size_t i = first; i < first + outcome.taken; ++i)
      EXPECT_EQ(prepared_for[i], sent_for[i]++) << i;
    return outcome;
  }
  void prepare(std::size_t, std::size_t end, unsigned pass) {
    if (pass != preparing) position = 0;
    preparing = pass;
    for (; position < end; ++position) {
      EXPECT_EQ(sent_for[position], pass) << "not before it has gone";
      prepared_for[position] = pass;
    }
  }
};

TEST(Player, EachFrameIsPreparedForItsNextPassAfterItHasGone) {
  const Timeline t = timeline_of({0, 5, 20, 21, 1'000, 1'020, 1'020, 5'000});
  for (const std::size_t room : {std::size_t{1}, std::size_t{3}, SIZE_MAX}) {
    PreparingIo io;
    io.latency = microseconds(30);
    io.room = room;
    io.prepared_for.resize(8);
    io.sent_for.resize(8);
    EXPECT_EQ(Player(t, {.passes = 5}, io).play({}).frames.sent, 40U);
    EXPECT_EQ(io.sent_for, std::vector<unsigned>(8, 5));
    EXPECT_EQ(io.prepared_for, std::vector<unsigned>(8, 4));  // none for a pass that does not come
  }
}

}  // namespace
}  // namespace pitwall::replay
