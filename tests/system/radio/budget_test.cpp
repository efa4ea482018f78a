// What leaves an end, counted datagram by datagram as the air gets it: in every window, whatever is
// asked of it, not more than the budget. Nothing has a way around it.
// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/budget_run.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/benchmarks/radio/offered_load.hpp"
#include "tests/system/radio/radio_setups.hpp"

namespace pitwall::radio {
namespace {

void expect_held(const BudgetVerdict& verdict) {
  std::printf("%s\n", to_string(verdict).c_str());
  EXPECT_LE(static_cast<double>(verdict.tenth.bytes), verdict.tenth_bytes_max) << verdict.what;
  EXPECT_LE(static_cast<double>(verdict.tenth.packets), verdict.tenth_packets_max) << verdict.what;
  EXPECT_LE(static_cast<double>(verdict.second.bytes), verdict.second_bytes_max) << verdict.what;
  EXPECT_TRUE(verdict.holds());
}

BudgetRun expect_held(const BudgetCell& cell) {
  const BudgetRun run = run_budget(cell);
  for (const BudgetVerdict& verdict : run.verdicts) expect_held(verdict);
  // The last restart may be only just over.
  EXPECT_TRUE(run.established || cell.trouble == Trouble::kRestarts);
  EXPECT_GT(run.arrivals, 100U);
  return run;
}

TEST(Budget, HoldsInEveryWindowWhateverIsOffered) {
  for (const double kbit_per_s : {64.0, 128.0, 256.0, 1'024.0}) {
    for (const double load : {0.0, 1.0, 3.0, 20.0}) {
      expect_held(BudgetCell{.kbit_per_s = kbit_per_s, .load = load});
    }
  }
}

TEST(Budget, HoldsInAStormOfCommands) {
  for (const double kbit_per_s : {64.0, 128.0, 256.0, 1'024.0}) {
    const BudgetRun run = expect_held(
        BudgetCell{.kbit_per_s = kbit_per_s, .load = 3.0, .trouble = Trouble::kCommands});
    EXPECT_GT(run.applied, 20U) << kbit_per_s;
  }
}

TEST(Budget, HoldsInAStormOfHandshakes) {
  for (const double kbit_per_s : {64.0, 128.0, 256.0, 1'024.0}) {
    const BudgetRun run = expect_held(
        BudgetCell{.kbit_per_s = kbit_per_s, .load = 3.0, .trouble = Trouble::kOpenings});
    EXPECT_GT(run.openings, 10'000U);
  }
}

TEST(Budget, HoldsWhileBothEndsRestart) {
  for (const double kbit_per_s : {64.0, 256.0}) {
    expect_held(BudgetCell{.kbit_per_s = kbit_per_s, .load = 3.0, .trouble = Trouble::kRestarts});
  }
}

TEST(Budget, HoldsOnEachOfTwoPaths) {
  expect_held(BudgetCell{.load = 3.0, .paths = 2});
  expect_held(BudgetCell{.load = 3.0, .trouble = Trouble::kRestarts, .paths = 2});
}

// A key exchange beside the living session; nothing of it is seen in the budget, and nothing stops.
TEST(Budget, HoldsWhileKeysChange) {
  link::LinkParams link = clean_link();
  link.loss = 0.1;
  VirtualRadio radio(setup_of(link));
  radio.run(telemetry::kRenewAfter - seconds(5));
  radio.record_departures(true);
  radio.reset_ages();
  OfferedLoad(kRate, 3.0).run(radio, seconds(15));
  expect_held(judge(radio.departures(true, 0), {}, "key change, down"));
  expect_held(judge(radio.departures(false, 0), {}, "key change, up"));
  EXPECT_GE(radio.car_report().association.renewals, 1U);
  EXPECT_EQ(radio.base_report().association.renewals, radio.car_report().association.renewals);
  EXPECT_EQ(radio.car_report().sessions, 1U);
  EXPECT_LE(radio.ages().worst(telemetry::Group::kMode), milliseconds(150));
}

}  // namespace
}  // namespace pitwall::radio
