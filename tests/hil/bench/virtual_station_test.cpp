// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/virtual_station.hpp"

#include <gtest/gtest.h>

namespace pitwall::bench {
namespace {

using faults::BenchFault;
using faults::BenchFaultKind;

constexpr Instant at_ms(std::int64_t ms) { return {milliseconds(ms).ns}; }

// Runs to the instant in ticks of the car; true while the car heard within a second.
struct Air {
  VirtualStation base;
  std::int64_t ms = 0;

  bool run_to(std::int64_t end_ms, bool car_runs = true) {
    for (; ms <= end_ms; ms += 10) base.step(at_ms(ms), car_runs);
    return base.alive_at() && at_ms(end_ms) - *base.alive_at() < seconds(1);
  }
};

Air with(BenchFaultKind kind) {
  return {
      VirtualStation{{BenchFault{.kind = kind, .start = at_ms(5'000), .duration = seconds(5)}}}};
}

TEST(VirtualStation, IsHeardAtOnceAndTenTimesASecond) {
  Air air{VirtualStation{{}}};
  EXPECT_FALSE(air.base.alive_at());
  EXPECT_TRUE(air.run_to(0));
  air.run_to(10'000);
  EXPECT_EQ(air.base.heartbeats().accepted, 101U);
  EXPECT_EQ(air.base.heartbeats().refused_total(), 0U);
}

TEST(VirtualStation, EveryFaultSilencesItForItsTimeAndNoLonger) {
  for (const auto kind : {BenchFaultKind::kBaseKilled, BenchFaultKind::kBasePaused,
                          BenchFaultKind::kBaseStationSilent, BenchFaultKind::kRadioDown}) {
    Air air = with(kind);
    EXPECT_TRUE(air.run_to(4'990));
    EXPECT_FALSE(air.run_to(9'900)) << faults::row_of(kind).name;
    EXPECT_GE(*air.base.alive_at(), at_ms(4'850));
    EXPECT_LT(*air.base.alive_at(), at_ms(5'000)) << faults::row_of(kind).name;
    EXPECT_TRUE(air.run_to(10'110)) << "back within a heartbeat";
    const bool restarted = kind == BenchFaultKind::kBaseKilled;
    EXPECT_EQ(air.base.heartbeats().runs, restarted ? 2U : 1U) << faults::row_of(kind).name;
  }
}

TEST(VirtualStation, ACarThatBeginsAnewHasHeardNothing) {
  Air air{VirtualStation{{}}};
  air.run_to(1'000);
  air.run_to(2'000, false);
  air.base.restart_car();
  EXPECT_FALSE(air.base.alive_at());
  EXPECT_TRUE(air.run_to(2'200));
}

TEST(VirtualStation, TakesItsFaultsFromBothListsOfAPlan) {
  FaultPlan plan;
  plan.models = {{.kind = BenchFaultKind::kRadioDown}, {.kind = BenchFaultKind::kLowGrip}};
  plan.processes = {{.kind = BenchFaultKind::kBaseKilled},
                    {.kind = BenchFaultKind::kComputerKilled}};
  EXPECT_EQ(base_faults(plan).size(), 2U);
}

}  // namespace
}  // namespace pitwall::bench
