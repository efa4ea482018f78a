// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/tally.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "protocol/yaml/strict_map.hpp"

namespace pitwall::io {
namespace {

// splitmix64: small, seeded, the same everywhere.
std::uint64_t next(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9E3779B97F4A7C15ULL);
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31U);
}

// Against the sorted list: never below the true quantile, and at most one bin above it.
TEST(StepTally, QuantilesAreThoseOfTheSortedListToOneMicrosecond) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::uint64_t state = seed;
    const std::size_t count = 1 + next(state) % 3000;
    const auto span_ns = 1 + next(state) % 3'900'000;
    const auto tally = std::make_unique<StepTally>();
    std::vector<double> sorted_us;
    for (std::size_t i = 0; i < count; ++i) {
      const auto ns = static_cast<std::int64_t>(next(state) % span_ns);
      tally->add(nanoseconds(ns), 0);
      sorted_us.push_back(static_cast<double>(ns) * 1e-3);
    }
    std::sort(sorted_us.begin(), sorted_us.end());
    for (const double q : {0.001, 0.01, 0.25, 0.5, 0.9, 0.99, 0.999, 1.0}) {
      const auto rank =
          static_cast<std::size_t>(std::max(1.0, std::ceil(q * static_cast<double>(count))));
      const double exact_us = sorted_us[rank - 1];
      EXPECT_GE(tally->quantile_us(q), exact_us) << "seed " << seed << " q " << q;
      EXPECT_LE(tally->quantile_us(q), exact_us + 1.0) << "seed " << seed << " q " << q;
    }
    EXPECT_EQ(tally->max_us(), sorted_us.back());
    EXPECT_EQ(tally->steps(), count);
  }
}

TEST(StepTally, NothingCountedIsZero) {
  const auto tally = std::make_unique<StepTally>();
  for (const double q : {0.0, 0.5, 1.0}) EXPECT_EQ(tally->quantile_us(q), 0.0);
  EXPECT_EQ(tally->max_us(), 0.0);
  EXPECT_EQ(tally->steps(), 0u);
  EXPECT_EQ(tally->take_recent_max_us(), 0.0);
}

TEST(StepTally, StepsBeyondTheHistogramCountAsItsEndAndKeepTheirMaximum) {
  const auto tally = std::make_unique<StepTally>();
  tally->add(seconds(3), 299);
  tally->add(milliseconds(-5), 0);  // a clock that went back
  EXPECT_EQ(tally->quantile_us(1.0), 4000.0);
  EXPECT_EQ(tally->quantile_us(0.5), 1.0);
  EXPECT_EQ(tally->max_us(), 3e6);
  EXPECT_EQ(tally->missed_deadlines(), 299u);
}

TEST(StepTally, TheRecentMaximumIsTakenOnce) {
  const auto tally = std::make_unique<StepTally>();
  tally->add(microseconds(70), 1);
  tally->add(microseconds(30), 2);
  EXPECT_EQ(tally->take_recent_max_us(), 70.0);
  EXPECT_EQ(tally->take_recent_max_us(), 0.0);
  tally->add(microseconds(20), 0);
  EXPECT_EQ(tally->take_recent_max_us(), 20.0);
  EXPECT_EQ(tally->max_us(), 70.0);
  EXPECT_EQ(tally->missed_deadlines(), 3u);
}

TEST(Summary, IsReadBackWithEveryKey) {
  const auto tally = std::make_unique<StepTally>();
  for (int i = 1; i <= 100; ++i) tally->add(microseconds(i), i == 50 ? 6 : 0);
  FrameTotals frames;
  frames.received = 11, frames.sent = 12, frames.tx_drops = 13, frames.rx_dropped = 14;
  frames.refused = {.unknown_id = 101,
                    .wrong_length = 102,
                    .remote_or_error = 103,
                    .stuck_counter = 104,
                    .jumped_counter = 105,
                    .not_finite = 106,
                    .out_of_range = 107,
                    .implausible_slew = 108};
  frames.gate_refusals = 15;
  for (std::size_t i = 0; i < safety::kVerdicts; ++i) frames.gate_verdicts[i] = 1000 + i;
  const std::string text = summary_json(*tally, frames);
  const auto document = yaml::load_text(text, "summary.json");  // JSON is YAML
  ASSERT_TRUE(document) << to_string(document.error()) << text;
  const auto all = yaml::read(*document, [](yaml::StrictMap& map) {
    const auto is = [](yaml::StrictMap& in, const char* key, std::int64_t value) {
      EXPECT_EQ(in.integer(key, 0, std::numeric_limits<std::int64_t>::max()), value) << key;
    };
    is(map, "ticks", 100);
    is(map, "missed_deadlines", 6);
    is(map, "frames_received", 11);
    is(map, "frames_sent", 12);
    is(map, "tx_drops", 13);
    is(map, "rx_dropped", 14);
    is(map, "frames_refused", 836);
    is(map, "gate_refusals", 15);
    yaml::StrictMap kinds = map.map("refused_by_kind");
    is(kinds, "unknown_id", 101);
    is(kinds, "wrong_length", 102);
    is(kinds, "remote_or_error", 103);
    is(kinds, "stuck_counter", 104);
    is(kinds, "jumped_counter", 105);
    is(kinds, "not_finite", 106);
    is(kinds, "out_of_range", 107);
    is(kinds, "implausible_slew", 108);
    yaml::StrictMap verdicts = map.map("gate_verdicts");
    for (std::size_t i = 0; i < safety::kVerdicts; ++i)
      is(verdicts, safety::text_of(static_cast<safety::Verdict>(i)),
         static_cast<std::int64_t>(1000 + i));
    EXPECT_NEAR(map.number("step_p50_us", 0, 1e9), 51.0, 1.0);
    EXPECT_NEAR(map.number("step_p99_us", 0, 1e9), 100.0, 1.0);
    EXPECT_EQ(map.number("step_max_us", 0, 1e9), 100.0);
    return true;
  });  // and no key beyond these
  EXPECT_TRUE(all) << (all ? "" : to_string(all.error()));
}

TEST(Summary, OfACarThatNeverStepsIsReadable) {
  const auto tally = std::make_unique<StepTally>();
  EXPECT_TRUE(yaml::load_text(summary_json(*tally, {}), "summary.json"));
}

}  // namespace
}  // namespace pitwall::io
