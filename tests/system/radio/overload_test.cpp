// Age of the state at the base, however much more bulk is offered than the link carries.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "protocol/telemetry/packet/header.hpp"
#include "tests/benchmarks/radio/budget_run.hpp"
#include "tests/benchmarks/radio/burst_run.hpp"
#include "tests/benchmarks/radio/offered_load.hpp"
#include "tests/benchmarks/radio/virtual_radio.hpp"
#include "tests/system/radio/radio_setups.hpp"

namespace pitwall::radio {
namespace {

using telemetry::Class;
using telemetry::Direction;
using telemetry::GroupRow;
using telemetry::kGroupTable;

void print(const char* what, double multiple, const AgeQuantiles& ages) {
  std::printf("%-8s offered %4.1fx: p50 %3.0f, p99 %3.0f, p99.9 %3.0f ms\n", what, multiple,
              ages.p50.milliseconds(), ages.p99.milliseconds(), ages.p999.milliseconds());
}

Duration worst_of(const VirtualRadio& radio, Class priority) {
  Duration worst{};
  for (const GroupRow& row : kGroupTable) {
    if (row.direction != Direction::kDown || row.priority != priority) continue;
    EXPECT_GT(radio.ages().looks(row.group), 0U) << row.name;
    worst = std::max(worst, radio.ages().worst(row.group));
  }
  return worst;
}

class Overload : public ::testing::TestWithParam<double> {};

TEST_P(Overload, SafetyStaysYoung) {
  VirtualRadio radio(setup_of(clean_link()));
  OfferedLoad load(kRate, GetParam());
  load.run(radio, seconds(5));
  radio.reset_ages();
  load.run(radio, seconds(120));

  const AgeQuantiles safety = ages_of(radio, Class::kSafety),
                     motion = ages_of(radio, Class::kMotion);
  print("safety", GetParam(), safety);
  print("motion", GetParam(), motion);
  print("health", GetParam(), ages_of(radio, Class::kHealth));
  EXPECT_LE(safety.p50, milliseconds(40));
  EXPECT_LE(safety.p99, milliseconds(60));
  EXPECT_LE(worst_of(radio, Class::kSafety), milliseconds(80));
  EXPECT_LE(motion.p99, milliseconds(80));
  // What safety leaves, bulk has.
  const auto down = radio.car_report().paths[0];
  const double used = static_cast<double>(down.spent.bytes) / (kRate * 125.0);
  std::printf("used of the rate: %.3f\n", used);
  EXPECT_GT(used, GetParam() >= 1.0 ? 0.94 : 0.2);
  EXPECT_LE(used, 1.0);
  EXPECT_EQ(down.rate_factor, 1.0);
  EXPECT_EQ(radio.content_errors().too_young, 0U);
  EXPECT_EQ(radio.content_errors().never_sampled, 0U);
}

// Bytes of bulk per second that came to the base, each piece counted once.
double bulk_rate(const VirtualRadio& radio, const telemetry::BulkCounters& before,
                 Duration length) {
  const telemetry::BulkCounters now = radio.base_report().bulk;
  const auto pieces = static_cast<double>(now.pieces - now.repeated) -
                      static_cast<double>(before.pieces - before.repeated);
  return pieces * telemetry::kBulkPiece / length.seconds();
}

struct StateRun {
  AgeQuantiles state, safety;
  double bulk_rate = 0.0;
};

StateRun run_state(const RadioSetup& setup, double multiple, const char* what) {
  constexpr Duration kLength = seconds(120);
  VirtualRadio radio(setup);
  OfferedLoad load(setup.budget_down[0].bytes_per_s, multiple);
  load.run(radio, seconds(5));
  radio.reset_ages();
  radio.record_departures(true);
  const telemetry::BulkCounters before = radio.base_report().bulk;
  load.run(radio, kLength);
  const StateRun run{state_ages_of(radio), ages_of(radio, Class::kSafety),
                     bulk_rate(radio, before, kLength)};
  print(what, multiple, run.state);
  print("safety", multiple, run.safety);
  std::printf("bulk: %.0f bytes per second\n", run.bulk_rate);
  for (telemetry::PathId path = 0; path < setup.paths; ++path) {
    EXPECT_TRUE(judge(radio.departures(true, path), setup.budget_down[path], what).holds());
  }
  EXPECT_EQ(radio.content_errors().all(), 0U);
  return run;
}

// 256 kbit/s. All hundred signals together; bulk still has a third of the rate.
TEST_P(Overload, TheWholeStateStaysYoung) {
  for (const std::uint8_t paths : {std::uint8_t{1}, std::uint8_t{2}}) {
    const StateRun run = run_state(setup_of(clean_link(), paths), GetParam(), "state");
    EXPECT_LE(run.state.p50, milliseconds(120));
    EXPECT_LE(run.state.p99, milliseconds(200));
    EXPECT_LE(run.safety.p50, milliseconds(40));
    EXPECT_LE(run.safety.p99, milliseconds(60));
    if (GetParam() >= 1.0) {
      EXPECT_GE(run.bulk_rate, kRate / 3.0);
    }
  }
}

// One packet in ten is lost: the same bounds.
TEST(OverloadOfALossyLink, TheWholeStateStaysYoung) {
  const StateRun run = run_state(lossy(0.1, 1), 3.0, "lossy");
  EXPECT_LE(run.state.p50, milliseconds(120));
  EXPECT_LE(run.state.p99, milliseconds(200));
}

RadioSetup setup_at(double kbit_per_s) {
  const double rate = kbit_per_s * 125.0;
  RadioSetup setup = setup_of(clean_link(rate));
  for (auto& budget : setup.budget_down) budget.bytes_per_s = rate;
  for (auto& budget : setup.budget_up) budget.bytes_per_s = rate;
  return setup;
}

TEST(OverloadOfAnyLink, BulkHasAThirdOfAWideLink) {
  for (const double kbit_per_s : {256.0, 512.0, 1'024.0}) {
    const StateRun run = run_state(setup_at(kbit_per_s), 3.0, "state");
    EXPECT_GE(run.bulk_rate, kbit_per_s * 125.0 / 3.0) << kbit_per_s;
    EXPECT_LE(run.state.p99, milliseconds(200)) << kbit_per_s;
  }
}

// Half of 128 kbit/s is less than safety and motion take: slow groups go at half of their target
// age and not before, as if there were no other groups.
TEST(OverloadOfAnyLink, ANarrowLinkKeepsTheTargetAges) {
  constexpr Duration kLength = seconds(60);
  for (const double kbit_per_s : {64.0, 128.0}) {
    VirtualRadio radio(setup_at(kbit_per_s));
    OfferedLoad load(kbit_per_s * 125.0, 3.0);
    load.run(radio, seconds(5));
    const telemetry::LinkReport before = radio.car_report();
    load.run(radio, kLength);
    const telemetry::LinkReport after = radio.car_report();
    for (const GroupRow& row : kGroupTable) {
      if (row.direction != Direction::kDown || row.priority <= Class::kMotion) continue;
      const std::size_t g = telemetry::index_of(row.group);
      const std::uint64_t sent = after.groups[g].chosen - before.groups[g].chosen;
      EXPECT_LE(sent, static_cast<std::uint64_t>(2 * kLength.ns / row.target_age.ns) + 1)
          << row.name << ' ' << kbit_per_s;
      EXPECT_GT(sent, 10U) << row.name << ' ' << kbit_per_s;
    }
  }
}

// On any link: a slot to wait, the largest packet before it and its own on the air, and the way.
TEST(OverloadOfAnyLink, SafetyWaitsForTwoPacketsAtMost) {
  for (const double kbit_per_s : {64.0, 128.0, 512.0, 1'024.0}) {
    const double rate = kbit_per_s * 125.0;
    const RadioSetup setup = setup_at(kbit_per_s);
    VirtualRadio radio(setup);
    OfferedLoad load(rate, 3.0);
    load.run(radio, seconds(5));
    radio.reset_ages();
    load.run(radio, seconds(60));
    const auto budget = telemetry::PathBudget::make(setup.budget_down[0]);
    const auto largest = static_cast<double>(budget->largest_payload() + telemetry::kIpUdpOverhead);
    const AgeQuantiles safety = ages_of(radio, Class::kSafety);
    std::printf("%4.0f kbit/s ", kbit_per_s);
    print("safety", 3.0, safety);
    std::printf("%4.0f kbit/s ", kbit_per_s);
    print("motion", 3.0, ages_of(radio, Class::kMotion));
    EXPECT_LE(safety.p99,
              milliseconds(20) + from_seconds(2.0 * largest / rate) + kWay + milliseconds(10));
  }
}

INSTANTIATE_TEST_SUITE_P(Offered, Overload, ::testing::Values(0.0, 1.0, 3.0, 20.0));

}  // namespace
}  // namespace pitwall::radio
