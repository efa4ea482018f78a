// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/bench_clock/clock_page.hpp"

#include <gtest/gtest.h>

#include <random>

namespace pitwall::transport {
namespace {

// As a keeper would: time stood from `from_ns` to `to_ns` of the wall clock.
void pause(ClockPage& page, std::int64_t from_ns, std::int64_t to_ns) {
  const std::uint64_t made = page.pauses_made.load();
  page.pauses[made % ClockPage::kPauses].from_ns = from_ns;
  page.pauses[made % ClockPage::kPauses].to_ns = to_ns;
  page.pauses_made = made + 1;
  page.lost_ns += to_ns - from_ns;
}

TEST(ClockPage, IsTheWallClockBeforeABenchComes) {
  const ClockPage page;
  for (const std::int64_t wall_ns : {0L, 1L, 123'456'789L})
    EXPECT_EQ(bench_now(page, [&] { return Instant{wall_ns}; }), Instant{wall_ns});
}

TEST(ClockPage, StandsAtItsHorizonAndGoesOnFromThere) {
  ClockPage page;
  page.horizon_ns = 1'000;
  const auto at = [&](std::int64_t wall_ns) {
    return bench_now(page, [&] { return Instant{wall_ns}; }).ns;
  };
  EXPECT_EQ(at(999), 999);
  EXPECT_EQ(at(1'000), 1'000);
  EXPECT_EQ(at(5'000), 1'000);
  pause(page, 1'000, 5'000);
  page.horizon_ns = 3'000;
  EXPECT_EQ(at(5'000), 1'000) << "no jump where it goes on";
  EXPECT_EQ(at(5'500), 1'500);
}

// The law, against a second reckoning of the same history: bench time of a wall instant is the
// wall time that has passed outside of pauses.
TEST(ClockPage, AStampLiesWhereTimeWasWhenItWasMade) {
  std::mt19937_64 random{7};
  for (int history = 0; history < 200; ++history) {
    ClockPage page;
    page.horizon_ns = INT64_MAX;
    std::vector<std::pair<std::int64_t, std::int64_t>> pauses;
    std::int64_t wall_ns = 0;
    for (int i = 0; i < 20; ++i) {
      const auto runs = static_cast<std::int64_t>(random() % 1'000 + 1);
      const auto stands = static_cast<std::int64_t>(random() % 1'000 + 1);
      pauses.emplace_back(wall_ns + runs, wall_ns + runs + stands);
      pause(page, pauses.back().first, pauses.back().second);
      wall_ns += runs + stands;
    }
    for (int look = 0; look < 50; ++look) {
      const auto stamp = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(wall_ns));
      std::int64_t passed = 0;
      for (std::int64_t ns = 0; ns < stamp; ++ns) {
        bool stood = false;
        for (const auto& [from, to] : pauses) stood = stood || (ns >= from && ns < to);
        if (!stood) ++passed;
      }
      ASSERT_EQ(bench_time_of(page, Instant{stamp}).ns, passed) << "stamp " << stamp;
    }
  }
}

TEST(ClockPage, AStampOfAStandIsItsHorizon) {
  ClockPage page;
  page.horizon_ns = 1'000;
  EXPECT_EQ(bench_time_of(page, Instant{900}), Instant{900});
  EXPECT_EQ(bench_time_of(page, Instant{4'000}), Instant{1'000});
}

}  // namespace
}  // namespace pitwall::transport
