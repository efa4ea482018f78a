// The player on a rim of virtual time: every law of the schedule, without a clock or a bus.
// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/player.hpp"

#include <gtest/gtest.h>

#include <random>

namespace pitwall::replay {
namespace {

struct Sent {
  std::size_t bus;
  std::uint32_t id;
  Instant at;
};

// Wakes up late by what `latency` says; takes at most `room` frames per call.
struct VirtualRim {
  Instant time{};
  Duration latency{};
  Duration call{};
  std::size_t room = SIZE_MAX;
  std::size_t stop_after = SIZE_MAX;
  std::vector<Sent> sent{};

  Instant now() { return time; }
  void wait_until(Instant deadline) { time = std::max(time, deadline) + latency; }
  std::size_t send(std::size_t bus, std::span<const can::Frame> frames) {
    time += call;
    const std::size_t n = std::min(room, frames.size());
    for (std::size_t i = 0; i < n; ++i) sent.push_back({bus, frames[i].id, time});
    return n;
  }
  bool stopped() { return sent.size() >= stop_after; }
};

Timeline timeline_of(const std::vector<std::int64_t>& due_us) {
  Timeline t;
  t.buses.push_back({.interface = "a", .frames = {}, .due = {}});
  for (std::size_t i = 0; i < due_us.size(); ++i) {
    can::Frame f;
    f.id = static_cast<std::uint32_t>(i);
    t.buses[0].frames.push_back(f);
    t.buses[0].due.push_back(microseconds(due_us[i]));
  }
  t.frames = due_us.size();
  t.pass = t.buses[0].due.back() + milliseconds(1);
  return t;
}

TEST(Player, EveryFrameOnceInOrderNeverEarlierThanAGroup) {
  std::mt19937_64 random(31);
  for (int round = 0; round < 100; ++round) {
    std::vector<std::int64_t> due_us{0};
    for (int i = 0; i < 300; ++i)
      due_us.push_back(due_us.back() + static_cast<std::int64_t>(random() % 400));
    const Timeline t = timeline_of(due_us);
    VirtualRim rim{.latency = microseconds(static_cast<std::int64_t>(random() % 300)),
                   .call = microseconds(static_cast<std::int64_t>(random() % 30))};
    const Instant start{seconds(5).ns};
    const auto report = Player(t, {.passes = 3}, rim).play(start);
    ASSERT_EQ(rim.sent.size(), 3 * due_us.size());
    ASSERT_EQ(report.sent, rim.sent.size());
    for (std::size_t i = 0; i < rim.sent.size(); ++i) {
      const std::size_t k = i % due_us.size();
      const auto pass = static_cast<std::int64_t>(i / due_us.size());
      const Instant due = start + t.pass * pass + t.buses[0].due[k];
      ASSERT_EQ(rim.sent[i].id, k);
      ASSERT_GE(rim.sent[i].at, due - kGroup);
    }
  }
}

TEST(Player, FramesOfOneGroupAreOneCall) {
  const Timeline t = timeline_of({0, 5, 20, 21, 1'000, 1'020});
  VirtualRim rim;
  EXPECT_EQ(Player(t, {}, rim).play({}).calls, 3U);  // 0 5 20 | 21 | 1000 1020
}

TEST(Player, LatenessIsMeasuredFromTheScheduleAndDoesNotAddUp) {
  std::vector<std::int64_t> due_us;
  for (std::int64_t i = 0; i < 1'000; ++i) due_us.push_back(i * 1'000);
  const Timeline t = timeline_of(due_us);
  VirtualRim rim{.latency = microseconds(70)};
  const auto report = Player(t, {}, rim).play({});
  EXPECT_EQ(report.lateness.count(), 1'000U);
  EXPECT_EQ(report.lateness.latest(), microseconds(70));
  EXPECT_EQ(report.lateness.earliest(), microseconds(70));
  EXPECT_EQ(report.lateness.quantile(0.5), microseconds(71));  // upper edge of its cell
}

TEST(Player, AFullQueueIsRetriedInOrder) {
  const Timeline t = timeline_of({0, 1, 2, 3, 4, 5, 6, 7});
  VirtualRim rim{.room = 3};
  const auto report = Player(t, {}, rim).play({});
  ASSERT_EQ(rim.sent.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(rim.sent[i].id, i);
  EXPECT_EQ(report.retries, 2U);
  EXPECT_EQ(report.dropped, 0U);
}

TEST(Player, ABusThatTakesNothingEndsInDropsNotInAHang) {
  const Timeline t = timeline_of({0, 1, 2});
  VirtualRim rim{.room = 0};
  const auto report = Player(t, {}, rim).play({});
  EXPECT_EQ(report.sent, 0U);
  EXPECT_EQ(report.dropped, 3U);
  EXPECT_LE(report.retries, 3U * (kMaxRetry / kRetryPause + 1));
}

TEST(Player, LatePolicyDecides) {
  const Timeline t = timeline_of({0, 1'000, 2'000});
  VirtualRim catching{.latency = milliseconds(500)};
  EXPECT_EQ(Player(t, {}, catching).play({}).sent, 3U);
  VirtualRim aborting{.latency = milliseconds(500)};
  const auto report = Player(t, {.late = LatePolicy::kAbort}, aborting).play({});
  EXPECT_TRUE(report.aborted);
  EXPECT_EQ(report.sent, 0U);
}

TEST(Player, AStopEndsItBetweenFrames) {
  const Timeline t = timeline_of({0, 1'000, 2'000, 3'000});
  VirtualRim rim{.stop_after = 2};
  const auto report = Player(t, {.passes = 100}, rim).play({});
  EXPECT_TRUE(report.stopped);
  EXPECT_EQ(report.sent, 2U);
}

TEST(Player, TwoBusesShareOneClock) {
  Timeline t = timeline_of({0, 1'000, 2'000});
  Timeline other = timeline_of({500, 1'005, 9'000});
  t.buses.push_back(other.buses[0]);
  VirtualRim rim;
  const auto report = Player(t, {}, rim).play({});
  EXPECT_EQ(report.sent, 6U);
  EXPECT_TRUE(std::is_sorted(rim.sent.begin(), rim.sent.end(),
                             [](const Sent& a, const Sent& b) { return a.at < b.at; }));
  EXPECT_EQ(rim.sent.back().at, Instant{} + microseconds(9'000));
}

TEST(LatenessHistogram, QuantilesAreThoseOfTheSortedSamples) {
  std::mt19937_64 random(41);
  LatenessHistogram histogram;
  std::vector<std::int64_t> samples_ns;
  for (int i = 0; i < 5'000; ++i) {
    samples_ns.push_back(static_cast<std::int64_t>(random() % 15'000'000) - 20'000);
    histogram.add({samples_ns.back()}, 1);
  }
  std::sort(samples_ns.begin(), samples_ns.end());
  for (const double share : {0.01, 0.5, 0.9, 0.99, 1.0}) {
    const auto index =
        static_cast<std::size_t>(std::ceil(share * static_cast<double>(samples_ns.size()))) - 1;
    const std::int64_t exact_ns = std::max<std::int64_t>(samples_ns[index], 0);
    EXPECT_GT(histogram.quantile(share).ns, exact_ns);
    EXPECT_LE(histogram.quantile(share).ns, exact_ns + 1'000);
  }
  histogram.add(seconds(3), 100'000);  // beyond the last cell: the maximum stands for it
  EXPECT_EQ(histogram.quantile(0.9), seconds(3));
}

}  // namespace
}  // namespace pitwall::replay
