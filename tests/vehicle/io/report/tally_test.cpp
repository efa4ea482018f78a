// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/report/tally.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "protocol/vocabulary/random.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall::io {
namespace {

TEST(StepTally, TheRecentMedianIsOfTheLastHundredSteps) {
  const auto tally = std::make_unique<StepTally>();
  EXPECT_TRUE(std::isnan(tally->recent_median_us()));
  tally->add(microseconds(7), {}, 0);
  EXPECT_DOUBLE_EQ(tally->recent_median_us(), 7.0);
  for (int i = 0; i < 500; ++i) tally->add(microseconds(3'000), {}, 0);
  for (int i = 0; i < 100; ++i) tally->add(microseconds(i), {}, 0);
  EXPECT_DOUBLE_EQ(tally->recent_median_us(), 50.0);
}

// Against the sorted list: never below the true quantile, and at most one bin above it.
TEST(StepTally, QuantilesAreThoseOfTheSortedListToOneMicrosecond) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random{seed};
    const std::size_t count = 1 + random.next() % 3000;
    const auto span_ns = 1 + random.next() % 3'900'000;
    const auto tally = std::make_unique<StepTally>();
    std::vector<double> sorted_us;
    for (std::size_t i = 0; i < count; ++i) {
      const auto ns = static_cast<std::int64_t>(random.next() % span_ns);
      tally->add(nanoseconds(ns), nanoseconds(static_cast<std::int64_t>(span_ns) - ns), 0);
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
    const double middle_us = sorted_us[(count - 1) / 2];  // of what is left of the span: mirrored
    if (count % 2 == 1) {
      EXPECT_NEAR(tally->late_quantile_us(0.5), static_cast<double>(span_ns) * 1e-3 - middle_us,
                  1.001);
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
  tally->add(seconds(3), {}, 299);
  tally->add(milliseconds(-5), {}, 0);  // a clock that went back
  EXPECT_EQ(tally->quantile_us(1.0), 4000.0);
  EXPECT_EQ(tally->quantile_us(0.5), 1.0);
  EXPECT_EQ(tally->max_us(), 3e6);
  EXPECT_EQ(tally->missed_deadlines(), 299u);
}

TEST(StepTally, TheRecentMaximumIsTakenOnce) {
  const auto tally = std::make_unique<StepTally>();
  tally->add(microseconds(70), {}, 1);
  tally->add(microseconds(30), {}, 2);
  EXPECT_EQ(tally->take_recent_max_us(), 70.0);
  EXPECT_EQ(tally->take_recent_max_us(), 0.0);
  tally->add(microseconds(20), {}, 0);
  EXPECT_EQ(tally->take_recent_max_us(), 20.0);
  EXPECT_EQ(tally->max_us(), 70.0);
  EXPECT_EQ(tally->missed_deadlines(), 3u);
}

// Every count has its own value, so that none can be taken for another.
world::BusHealth some_health() {
  world::BusHealth bus;
  bus.frames_applied = 16, bus.frames_lost = 17;
  bus.refused = {.unknown_id = 101,
                 .wrong_length = 102,
                 .remote_or_error = 103,
                 .stuck_counter = 104,
                 .jumped_counter = 105,
                 .wrong_checksum = 106,
                 .not_finite = 107,
                 .out_of_range = 108,
                 .implausible_slew = 109};
  bus.link = {.controller = world::ControllerState::kPassive,
              .lost_in_socket = 21,
              .lost_in_interface = 22,
              .error_frames = 23,
              .tx_drops = 24,
              .restarts = 25};
  EXPECT_TRUE(bus.messages.push({.id = 1303,
                                 .liveness = world::Liveness::kLate,
                                 .debt = 31,
                                 .lost = 32,
                                 .late = 39,
                                 .bad = 33,
                                 .mean_interval = microseconds(34),
                                 .last = {35}}));
  EXPECT_TRUE(bus.losses.push({.id = 1304,
                               .detector = world::LossDetector::kPeriod,
                               .frames = 41,
                               .due = {42},
                               .noticed = {43}}));
  bus.losses_unlisted = 5;
  return bus;
}

using Expected = std::vector<std::pair<const char*, std::int64_t>>;

void expect_counts(yaml::StrictMap map, const Expected& counts) {
  for (const auto& [key, value] : counts)
    EXPECT_EQ(map.integer(key, 0, std::numeric_limits<std::int64_t>::max()), value) << key;
}

void expect_bus(yaml::StrictMap& map) {
  expect_counts(map.map("refused_by_kind"), {{"unknown_id", 101},
                                             {"wrong_length", 102},
                                             {"remote_or_error", 103},
                                             {"stuck_counter", 104},
                                             {"jumped_counter", 105},
                                             {"wrong_checksum", 106},
                                             {"not_finite", 107},
                                             {"out_of_range", 108},
                                             {"implausible_slew", 109}});
  yaml::StrictMap identity = map.map("identity");
  EXPECT_EQ(identity.text("verdict"), "listening");
  EXPECT_NE(identity.text("sentence"), "");
  EXPECT_NE(identity.text("database").find("CAN1-INDY-V14"), std::string::npos);
  yaml::StrictMap link = map.map("link");
  EXPECT_EQ(link.text("controller"), "passive");
  expect_counts(link, {{"lost_in_socket", 21},
                       {"lost_in_interface", 22},
                       {"error_frames", 23},
                       {"tx_drops", 24},
                       {"restarts", 25}});
  std::vector<yaml::StrictMap> messages = map.maps("messages"), lost = map.maps("losses");
  EXPECT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages.at(0).text("liveness"), "late");
  expect_counts(messages.at(0), {{"id", 1303},
                                 {"debt", 31},
                                 {"lost", 32},
                                 {"late", 39},
                                 {"bad", 33},
                                 {"mean_interval_us", 34},
                                 {"last_ns", 35}});
  EXPECT_EQ(lost.size(), 1u);
  EXPECT_EQ(lost.at(0).text("by"), "period");
  expect_counts(lost.at(0), {{"id", 1304}, {"frames", 41}, {"due_ns", 42}, {"noticed_ns", 43}});
}

TEST(Summary, IsReadBackWithEveryKey) {
  const auto tally = std::make_unique<StepTally>();
  for (int i = 1; i <= 100; ++i) tally->add(microseconds(i), {}, i == 50 ? 6 : 0);
  FrameTotals frames;
  frames.received = 11, frames.sent = 12, frames.tx_drops = 13, frames.rx_dropped = 14;
  frames.gate_refusals = 15;
  frames.missed_shifts = 18;
  for (std::size_t i = 0; i < safety::kVerdicts; ++i) frames.gate_verdicts[i] = 1000 + i;
  const auto losses = std::make_unique<LossTally>();
  losses->add(some_health());
  const std::string text = summary_json(*tally, frames, some_health(), *losses,
                                        {.radio = R"({"sessions": 51})",
                                         .receivers = R"([{"bytes": 61}, {"bytes": 62}])",
                                         .recorder = R"({"records": 71})",
                                         .sensors = R"([{"samples": 81}])",
                                         .tracking = R"({"frames": 91})"});
  const auto document = yaml::load_text(text, "summary.json");  // JSON is YAML
  ASSERT_TRUE(document) << to_string(document.error()) << text;
  const auto all = yaml::read(*document, [](yaml::StrictMap& map) {
    expect_counts(map, {{"ticks", 100},
                        {"missed_deadlines", 6},
                        {"frames_received", 11},
                        {"frames_sent", 12},
                        {"tx_drops", 13},
                        {"rx_dropped", 14},
                        {"frames_applied", 16},
                        {"frames_lost", 17},
                        {"loss_reports", 6},
                        {"frames_refused", 945},
                        {"gate_refusals", 15},
                        {"missed_shifts", 18}});
    expect_bus(map);
    Expected verdicts;
    for (std::size_t i = 0; i < safety::kVerdicts; ++i)
      verdicts.emplace_back(safety::text_of(static_cast<safety::Verdict>(i)),
                            static_cast<std::int64_t>(1000 + i));
    expect_counts(map.map("gate_verdicts"), verdicts);
    expect_counts(map.map("radio"), {{"sessions", 51}});
    std::vector<yaml::StrictMap> receivers = map.maps("receivers");
    EXPECT_EQ(receivers.size(), 2U);
    for (std::size_t unit = 0; unit < receivers.size(); ++unit)
      expect_counts(receivers[unit], {{"bytes", 61 + static_cast<std::int64_t>(unit)}});
    expect_counts(map.map("recorder"), {{"records", 71}});
    std::vector<yaml::StrictMap> sensors = map.maps("sensors");
    EXPECT_EQ(sensors.size(), 1U);
    for (const yaml::StrictMap& sensor : sensors) expect_counts(sensor, {{"samples", 81}});
    expect_counts(map.map("tracking"), {{"frames", 91}});
    EXPECT_NEAR(map.number("step_p50_us", 0, 1e9), 51.0, 1.0);
    EXPECT_NEAR(map.number("step_p99_us", 0, 1e9), 100.0, 1.0);
    EXPECT_EQ(map.number("step_max_us", 0, 1e9), 100.0);
    EXPECT_EQ(map.number("tick_late_p50_us", 0, 1e9), 1.0);
    EXPECT_EQ(map.number("tick_late_p99_us", 0, 1e9), 1.0);
    return true;
  });  // and no key beyond these
  EXPECT_TRUE(all) << (all ? "" : to_string(all.error()));
}

TEST(LossTally, CountsAllAndListsTheFirst) {
  const auto tally = std::make_unique<LossTally>();
  std::uint64_t noticed = 0;
  for (std::uint32_t tick = 0; tick < 100; ++tick) {
    world::BusHealth bus;
    for (std::uint32_t i = 0; i < tick % 64; ++i) {
      ASSERT_TRUE(bus.losses.push({.id = static_cast<std::uint32_t>(noticed)}));
      ++noticed;
    }
    bus.losses_unlisted = tick;  // since the start
    tally->add(bus);
    EXPECT_EQ(tally->reports(), noticed + tick);
    EXPECT_EQ(tally->listed().size(), std::min<std::uint64_t>(noticed, LossTally::kListed));
  }
  for (std::size_t i = 0; i < tally->listed().size(); ++i) ASSERT_EQ(tally->listed()[i].id, i);
}

TEST(Summary, OfACarThatNeverStepsIsReadable) {
  const auto tally = std::make_unique<StepTally>();
  EXPECT_TRUE(yaml::load_text(summary_json(*tally, {}, {}, {}), "summary.json"));
}

}  // namespace
}  // namespace pitwall::io
