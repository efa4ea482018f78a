// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/flow/path_budget.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <type_traits>
#include <vector>

#include "protocol/telemetry/packet/header.hpp"
#include "protocol/telemetry/session/association.hpp"
#include "tests/support/draw.hpp"

namespace pitwall::telemetry {
namespace {

static_assert(std::is_trivially_copyable_v<PathBudget>);
static_assert(PathBudget::kLeastLargest >= kMaxExchangeSize);

struct Departure {
  Instant at{};
  std::size_t bytes = 0;  // on the wire
};

// Most bytes and packets of any closed window of this length, begun at each millisecond and at
// each departure. Counted from the departures alone.
struct Worst {
  std::size_t bytes = 0, packets = 0;
};

Worst worst_of_starts(const std::vector<Departure>& departures, const std::vector<Instant>& starts,
                      Duration length) {
  Worst worst;
  std::size_t first = 0, end = 0, bytes = 0;
  for (const Instant start : starts) {
    while (end < departures.size() && departures[end].at <= start + length) {
      bytes += departures[end++].bytes;
    }
    while (first < end && departures[first].at < start) bytes -= departures[first++].bytes;
    worst.bytes = std::max(worst.bytes, bytes);
    worst.packets = std::max(worst.packets, end - first);
  }
  return worst;
}

Worst worst_window(const std::vector<Departure>& departures, Duration length) {
  std::vector<Instant> starts;
  const Instant last = departures.back().at;
  for (Instant t = departures.front().at - length; t <= last; t += milliseconds(1)) {
    starts.push_back(t);
  }
  for (const Departure& d : departures) starts.push_back(d.at);
  std::sort(starts.begin(), starts.end());
  return worst_of_starts(departures, starts, length);
}

PathBudget fresh(const BudgetParams& params) {
  auto budget = PathBudget::make(params);
  if (!budget) ADD_FAILURE() << to_string(budget.error());
  return *budget;
}

// Full, as one is that was not used for long.
PathBudget made(const BudgetParams& params) {
  const PathBudget budget = fresh(params);
  EXPECT_EQ(budget.room_for_safety(Instant{} - seconds(50)), 0U);
  return budget;
}

// Somebody who sends what he likes whenever there is room, now and then after a pause.
class RandomSender {
 public:
  explicit RandomSender(std::uint64_t seed) : random_(seed) {}

  std::vector<Departure> run(PathBudget& budget, Duration length) {
    std::vector<Departure> departures;
    const int greed = static_cast<int>(random_() % 4);
    Instant now{static_cast<std::int64_t>(random_() % 1'000'000'000'000)};
    for (const Instant end = now + length; now < end; now += pause()) {
      if (random_() % 200 == 0) {
        budget.scale(testing::draw_uniform(random_, 0.05, 1.0), now);
      }
      const std::size_t safety = greed == 1 ? 0 : random_() % 120;
      const std::size_t room =
          safety == 0 ? budget.room_for_all(now) : budget.room_beside(safety, now);
      if (room == 0 || room < safety) continue;
      const std::size_t payload =
          greed < 2 ? room : std::max<std::size_t>({safety, 1, random_() % (room + 1)});
      EXPECT_LE(payload, budget.largest_payload());
      budget.spend(payload, safety, now);
      departures.push_back({now, payload + kIpUdpOverhead});
    }
    return departures;
  }

 private:
  Duration pause() {
    if (random_() % 500 == 0) return milliseconds(static_cast<std::int64_t>(random_() % 2'000));
    return microseconds(static_cast<std::int64_t>(random_() % 3'000));
  }

  std::mt19937_64 random_;
};

TEST(PathBudget, HoldsInEveryWindowWhoeverSends) {
  for (const double kbit_per_s : {64.0, 128.0, 256.0, 1'024.0}) {
    for (const double packets_per_s : {37.0, 99.9, 100.0, 1'000.0}) {
      for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        BudgetParams params{.bytes_per_s = kbit_per_s * 125, .packets_per_s = packets_per_s};
        if (seed % 3 == 0) params.largest_payload = 700;
        PathBudget budget = made(params);
        const auto departures = RandomSender(seed).run(budget, seconds(40));
        ASSERT_GT(departures.size(), 100U);
        const auto largest = static_cast<double>(budget.largest_payload() + kIpUdpOverhead);

        const Worst tenth = worst_window(departures, milliseconds(100));
        EXPECT_LE(static_cast<double>(tenth.bytes), params.bytes_per_s * 0.1 + largest);
        EXPECT_LE(static_cast<double>(tenth.packets), packets_per_s * 0.1 + 1);
        const Worst second = worst_window(departures, seconds(1));
        EXPECT_LE(static_cast<double>(second.bytes), params.bytes_per_s)
            << kbit_per_s << " kbit/s, seed " << seed;
      }
    }
  }
}

// A loop of 10 ms that wakes up to 4 ms late, of a budget of 100 packets per second: each poll may
// send, and the law still holds.
TEST(PathBudget, AJitteringLoopLosesNoPacket) {
  std::mt19937_64 random(3);
  PathBudget budget = made({});
  std::vector<Departure> departures;
  for (int i = 0; i < 2'000; ++i) {
    const Instant now = Instant{} + milliseconds(10 * i) +
                        microseconds(static_cast<std::int64_t>(random() % 4'000));
    ASSERT_GE(budget.room_for_all(now), 100U) << i;
    budget.spend(100, 0, now);
    departures.push_back({now, 100 + kIpUdpOverhead});
  }
  EXPECT_LE(worst_window(departures, milliseconds(100)).packets, 11U);
}

// An end that restarts again and again spends no more than one that does not.
TEST(PathBudget, ARestartIsNoWayAroundIt) {
  std::mt19937_64 random(5);
  const BudgetParams params;
  std::vector<Departure> departures;
  PathBudget budget = fresh(params);
  for (int ms = 0; ms < 60'000; ++ms) {
    const Instant now = Instant{} + milliseconds(ms);
    if (random() % 150 == 0) budget = fresh(params);
    const std::size_t room = budget.room_beside(50, now);
    if (room < 50) continue;
    budget.spend(room, 50, now);
    departures.push_back({now, room + kIpUdpOverhead});
  }
  ASSERT_GT(departures.size(), 3'000U);
  const auto largest = static_cast<double>(budget.largest_payload() + kIpUdpOverhead);
  const Worst tenth = worst_window(departures, milliseconds(100));
  EXPECT_LE(static_cast<double>(tenth.bytes), params.bytes_per_s * 0.1 + largest);
  EXPECT_LE(tenth.packets, 11U);
  EXPECT_LE(static_cast<double>(worst_window(departures, seconds(1)).bytes), params.bytes_per_s);
}

TEST(PathBudget, UsesNearlyAllOfTheRate) {
  for (const double kbit_per_s : {64.0, 256.0, 1'024.0}) {
    PathBudget budget = made({.bytes_per_s = kbit_per_s * 125, .packets_per_s = 200});
    for (Instant now{}; now < Instant{} + seconds(20); now += milliseconds(1)) {
      const std::size_t room = budget.room_for_all(now);
      if (room >= budget.largest_payload() / 2) budget.spend(room, 0, now);
    }
    EXPECT_GT(static_cast<double>(budget.counters().bytes), 0.93 * 20 * kbit_per_s * 125)
        << kbit_per_s;
  }
}

// Others take all that they are given at every millisecond; safety still finds its share in each
// slot, whatever rate control has left of the rest.
TEST(PathBudget, OthersNeverTouchTheShareOfSafety) {
  for (const double factor : {1.0, 0.5, 0.001}) {
    for (const double kbit_per_s : {64.0, 256.0}) {
      const BudgetParams params{.bytes_per_s = kbit_per_s * 125, .packets_per_s = 10'000};
      PathBudget budget = made(params);
      budget.scale(factor, Instant{});
      const std::size_t slot = static_cast<std::size_t>(params.safety_bytes_per_s * 0.02);
      for (int ms = 0; ms < 20'000; ++ms) {
        const Instant now = Instant{} + milliseconds(ms);
        if (ms % 20 == 0) {
          ASSERT_GE(budget.room_for_safety(now), slot - kIpUdpOverhead) << ms;
          budget.spend(slot - kIpUdpOverhead, slot - kIpUdpOverhead, now);
        } else if (const std::size_t room = budget.room_for_all(now); room > 0) {
          budget.spend(room, 0, now);
        }
      }
      EXPECT_EQ(budget.counters().safety_bytes, slot * 1'000);
    }
  }
}

TEST(PathBudget, SafetyBorrowsFromTheRest) {
  PathBudget budget = made({});
  EXPECT_EQ(budget.room_for_safety(Instant{}), budget.largest_payload());
  EXPECT_LT(budget.room_for_all(Instant{}), budget.largest_payload());
  EXPECT_GT(budget.room_beside(60, Instant{}), budget.room_for_all(Instant{}));
  EXPECT_EQ(budget.room_beside(0, Instant{}), budget.room_for_all(Instant{}));
}

TEST(PathBudget, KeyExchangeAlwaysFitsBesideTheShare) {
  for (const double kbit_per_s : {64.0, 128.0, 256.0, 1'024.0}) {
    PathBudget budget = made({.bytes_per_s = kbit_per_s * 125});
    EXPECT_GE(budget.room_for_all(Instant{}), kMaxExchangeSize) << kbit_per_s;
  }
}

TEST(PathBudget, RefusesWhatContradictsItself) {
  EXPECT_FALSE(PathBudget::make({.bytes_per_s = 0}));
  EXPECT_FALSE(PathBudget::make({.bytes_per_s = kUnset}));
  EXPECT_FALSE(PathBudget::make({.packets_per_s = 0.5}));
  EXPECT_FALSE(PathBudget::make({.packets_per_s = kUnset}));
  EXPECT_FALSE(PathBudget::make({.safety_bytes_per_s = 0}));
  EXPECT_FALSE(PathBudget::make({.bytes_per_s = 4'000}));
  EXPECT_FALSE(PathBudget::make({.bytes_per_s = 4'500}));  // the share and a packet do not fit
  EXPECT_FALSE(PathBudget::make({.largest_payload = 100}));
  EXPECT_FALSE(PathBudget::make({.largest_payload = kMaxDatagram + 1}));
  EXPECT_EQ(made({.largest_payload = kMaxDatagram}).largest_payload(), kMaxDatagram);
}

TEST(PathBudgetDeathTest, NothingGoesBeyondTheRoom) {
  PathBudget budget = made({});
  const std::size_t room = budget.room_for_all(Instant{});
  EXPECT_DEATH(budget.spend(room + 1, 0, Instant{}), "CHECK");
  budget.spend(room, 0, Instant{});
  EXPECT_DEATH(budget.spend(1, 0, Instant{} + milliseconds(1)), "CHECK");
}

}  // namespace
}  // namespace pitwall::telemetry
