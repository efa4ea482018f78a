// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/flow/link_stats.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <type_traits>
#include <vector>

#include "tests/support/allocation_guard.hpp"
#include "tests/support/draw.hpp"

namespace pitwall::telemetry {
namespace {

static_assert(std::is_trivially_copyable_v<LinkStats>);

constexpr std::uint8_t kFirst = 0b01, kBoth = 0b11;

struct PacketArrival {
  Instant at{};
  std::uint64_t sequence = 0;
  PathId path = 0;
};

Instant slot(std::uint64_t i) {
  return Instant{} + milliseconds(20) * static_cast<std::int64_t>(i);
}

void feed(LinkStats& stats, std::vector<PacketArrival> arrivals, std::uint8_t mask) {
  std::stable_sort(arrivals.begin(), arrivals.end(),
                   [](const PacketArrival& a, const PacketArrival& b) { return a.at < b.at; });
  for (const PacketArrival& a : arrivals) {
    stats.advance(a.at);
    stats.received(a.sequence, mask, a.path, 100, a.at);
  }
}

// QGroundControl's figure of 8-bit differences: a duplicate or a reordered packet reads as 255
// lost ones, "80 % loss" while all is fine.
TEST(LinkStats, EightyPercentLossWhileAllIsFine) {
  std::mt19937_64 random(1);
  const std::uint64_t start = (std::uint64_t{1} << 32) - 1'000;
  std::vector<PacketArrival> arrivals;
  const std::uint64_t count = 5'000;
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto late = milliseconds(static_cast<std::int64_t>(random() % 300));
    arrivals.push_back({slot(i) + late, start + i, 0});
    arrivals.push_back({slot(i) + milliseconds(7), start + i, 1});
    if (random() % 3 == 0) arrivals.push_back({slot(i) + late + milliseconds(90), start + i, 0});
  }
  LinkStats stats;
  feed(stats, arrivals, kBoth);
  stats.advance(slot(count + 100));
  for (PathId path = 0; path < 2; ++path) {
    const PathFigures f = stats.figures(path, slot(count + 10));
    EXPECT_EQ(f.lost, 0U);
    EXPECT_EQ(f.loss, 0.0);
    EXPECT_EQ(f.received, count);
    EXPECT_EQ(f.late, 0U);
  }
  EXPECT_GT(stats.figures(0, slot(count)).duplicates, count / 4);
  EXPECT_EQ(stats.both_lost(), 0.0);
}

TEST(LinkStats, CountsWhatWasLostOnEachPathAndOnBoth) {
  std::mt19937_64 random(2);
  const auto chance = [&] { return testing::draw_uniform(random); };
  std::vector<PacketArrival> arrivals;
  std::array<std::uint64_t, 2> lost{};
  std::uint64_t both = 0;
  const std::uint64_t count = 20'000;
  for (std::uint64_t i = 1; i <= count; ++i) {
    const bool ends = i == 1 || i == count;
    const bool first = !ends && chance() < 0.3, second = !ends && chance() < 0.1;
    lost[0] += first ? 1 : 0;
    lost[1] += second ? 1 : 0;
    both += first && second ? 1 : 0;
    if (!first) arrivals.push_back({slot(i), i, 0});
    if (!second) arrivals.push_back({slot(i) + milliseconds(3), i, 1});
  }
  LinkStats stats;
  feed(stats, arrivals, kBoth);
  stats.advance(slot(count) + seconds(2));
  for (PathId path = 0; path < 2; ++path) {
    const PathFigures f = stats.figures(path, slot(count));
    EXPECT_EQ(f.lost, lost[path]);
    EXPECT_EQ(f.received, count - lost[path]);
    EXPECT_NEAR(f.loss, path == 0 ? 0.3 : 0.1, 0.12);
    EXPECT_NEAR(f.rate_bytes_per_s, 5'000.0 * (path == 0 ? 0.7 : 0.9), 900.0);
    EXPECT_EQ(f.mean_bad, Duration{});
  }
  EXPECT_NEAR(stats.both_lost(), static_cast<double>(both) / count, 1e-9);
}

TEST(LinkStats, WhatWentByOnePathIsNoLossOfTheOther) {
  LinkStats stats;
  for (std::uint64_t i = 1; i <= 500; ++i) {
    stats.received(i, i % 3 == 0 ? kBoth : kFirst, 0, 80, slot(i));
    if (i % 3 == 0) stats.received(i, 0, 1, 80, slot(i) + milliseconds(1));
    stats.advance(slot(i));
  }
  stats.advance(slot(700));
  EXPECT_EQ(stats.figures(0, slot(700)).lost, 0U);
  EXPECT_EQ(stats.figures(1, slot(700)).lost, 0U);
  EXPECT_EQ(stats.figures(1, slot(700)).received, 166U);
  EXPECT_EQ(stats.both_lost(), 0.0);
}

TEST(LinkStats, WhatComesAfterItCountedAsLostIsTakenBack) {
  LinkStats stats;
  for (std::uint64_t i = 1; i <= 200; ++i) {
    if (i != 100) stats.received(i, kFirst, 0, 80, slot(i));
  }
  stats.advance(slot(149));
  EXPECT_EQ(stats.figures(0, slot(149)).lost, 0U);  // not a second yet
  stats.advance(slot(200));
  EXPECT_EQ(stats.figures(0, slot(200)).lost, 1U);
  stats.received(100, kFirst, 0, 80, slot(201));
  EXPECT_EQ(stats.figures(0, slot(201)).lost, 0U);
  EXPECT_EQ(stats.figures(0, slot(201)).late, 1U);
  stats.received(100, kFirst, 0, 80, slot(202));
  EXPECT_EQ(stats.figures(0, slot(202)).duplicates, 1U);
}

TEST(LinkStats, AnOutageOfMoreThanIsKeptIsCountedWhole) {
  for (const std::uint64_t gap : {1'000U, 1'023U, 1'024U, 1'025U, 5'000U, 100'000U}) {
    LinkStats stats;
    for (std::uint64_t i = 1; i <= 50; ++i) stats.received(i, kBoth, 0, 80, slot(i));
    for (std::uint64_t i = 51 + gap; i <= 200 + gap; ++i) {
      stats.received(i, kBoth, 0, 80, slot(i));
      stats.advance(slot(i));
    }
    stats.advance(slot(400 + gap));
    EXPECT_EQ(stats.figures(0, slot(400 + gap)).lost, gap);
    EXPECT_EQ(stats.figures(1, slot(400 + gap)).lost, 200 + gap);
    EXPECT_NEAR(stats.both_lost(), static_cast<double>(gap) / static_cast<double>(200 + gap), 1e-9);
  }
}

TEST(LinkStats, FitsTheFadesOfTheLink) {
  std::mt19937_64 random(5);
  const auto draw = [&](double mean) { return testing::draw_exponential(random, mean); };
  LinkStats stats;
  bool bad = false;
  double ends_s = draw(0.28);
  for (std::uint64_t i = 1; i <= 200'000; ++i) {
    while (slot(i) - Instant{} >= from_seconds(ends_s)) {
      bad = !bad;
      ends_s += draw(bad ? 0.12 : 0.28);
    }
    stats.advance(slot(i));
    if (!bad) stats.received(i, kFirst, 0, 80, slot(i) + milliseconds(15));
  }
  const PathFigures f = stats.figures(0, slot(200'000));
  EXPECT_NEAR(f.mean_bad.milliseconds(), 120.0, 15.0);
  EXPECT_NEAR(f.mean_good.milliseconds(), 280.0, 35.0);
}

TEST(LinkStats, DelaysAndJitter) {
  LinkStats stats;
  std::mt19937_64 random(6);
  std::vector<double> all_ms;
  for (int i = 0; i < 256; ++i) {
    const auto way = microseconds(15'000 + static_cast<std::int64_t>(random() % 20'000));
    stats.delay(0, way, Instant{});
    all_ms.push_back(way.milliseconds());
  }
  std::sort(all_ms.begin(), all_ms.end());
  const PathFigures f = stats.figures(0, Instant{});
  EXPECT_NEAR(f.delay_p50.milliseconds(), all_ms[127], 1e-6);
  EXPECT_NEAR(f.delay_p95.milliseconds(), all_ms[242], 1e-6);
  EXPECT_NEAR(f.delay_p99.milliseconds(), all_ms[252], 1e-6);
  EXPECT_NEAR(f.jitter.milliseconds(), 20.0 / 3.0, 2.5);  // mean distance of two uniform ones
  EXPECT_EQ(stats.figures(1, Instant{}).delay_p50, Duration{});
}

// A car that goes round at 60 m/s and hears nothing between 1000 m and 1120 m: two seconds. It
// tells its place in the packets themselves, so that nothing is told of the place while it is
// there.
TEST(LinkStats, KnowsWhereOnTheTrackItIsLost) {
  const double lap_m = 4'000.0, speed_mps = 60.0;
  LinkStats stats;
  for (std::uint64_t i = 1; i <= 50 * 400; ++i) {
    const double way_m = speed_mps * (slot(i) - Instant{}).seconds();
    const double station_m = std::fmod(way_m, lap_m);
    stats.advance(slot(i));
    if (station_m >= 1'000.0 && station_m < 1'120.0) continue;
    stats.received(i, kFirst, 0, 80, slot(i));
    stats.place(station_m, lap_m, slot(i));
  }
  for (std::size_t bin = 0; bin < kTrackBins; ++bin) {
    const double from_m = lap_m / kTrackBins * static_cast<double>(bin);
    const double to_m = from_m + lap_m / kTrackBins;
    const double overlap =
        std::max(0.0, std::min(to_m, 1'120.0) - std::max(from_m, 1'000.0)) / (to_m - from_m);
    EXPECT_NEAR(stats.loss_at(bin), overlap, 0.05) << bin;
  }
}

TEST(LinkStats, TakesNothingFromTheHeap) {
  if (!testing::kAllocationsCounted) GTEST_SKIP() << "AddressSanitizer has a heap of its own";
  LinkStats stats;
  const auto work = [&] {
    for (std::uint64_t i = 1; i < 3'000; i += i % 100 == 0 ? 30 : 1) {
      stats.received(i, kBoth, 0, 80, slot(i));
      stats.delay(0, milliseconds(15), slot(i));
      stats.place(static_cast<double>(i), 4'000.0, slot(i));
      stats.advance(slot(i));
      EXPECT_GE(stats.figures(0, slot(i)).loss, 0.0);
    }
  };
  EXPECT_EQ(testing::allocations_of(work), 0U);
}

TEST(LinkStats, NoPlaceIsUnset) {
  LinkStats stats;
  stats.place(10.0, 0.0, slot(1));
  stats.place(kUnset, 100.0, slot(1));
  for (std::uint64_t i = 1; i <= 200; ++i) stats.received(i, kFirst, 0, 80, slot(i));
  stats.advance(slot(300));
  for (std::size_t bin = 0; bin < kTrackBins; ++bin) EXPECT_TRUE(std::isnan(stats.loss_at(bin)));
}

TEST(LinkStats, ANewSessionBeginsAnewWithoutLoss) {
  LinkStats stats;
  for (std::uint64_t i = 1; i <= 300; ++i) {
    if (i % 7 != 0) stats.received(1'000'000 + i, kFirst, 0, 80, slot(i));
  }
  stats.advance(slot(300));
  const std::uint64_t lost = stats.figures(0, slot(300)).lost;
  stats.new_session();
  for (std::uint64_t i = 1; i <= 300; ++i) stats.received(i, kFirst, 0, 80, slot(300 + i));
  stats.advance(slot(700));
  EXPECT_EQ(stats.figures(0, slot(700)).lost, lost);
}

}  // namespace
}  // namespace pitwall::telemetry
