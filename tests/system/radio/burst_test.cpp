// Fades of tenths of a second: nobody can hear while nothing passes, so ages are held against those
// of an oracle that sends 500 times a second over the very same fades.
// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/burst_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "tests/benchmarks/radio/offered_load.hpp"
#include "tests/system/radio/radio_setups.hpp"

namespace pitwall::radio {
namespace {

using telemetry::Class;
using telemetry::Direction;
using telemetry::GroupRow;
using telemetry::kGroupTable;

BurstRun reported(const BurstCase& c) {
  const BurstRun run = run_burst(c);
  std::printf("%s\n", to_string(c, run).c_str());
  EXPECT_GT(run.oracle.p99, kWay);
  EXPECT_LT(run.oracle.p99, run.of(Class::kSafety).p99) << "nobody is better than the oracle";
  return run;
}

class Burst : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(Burst, AgesAreThoseOfTheOracleAndASlotOrTwo) {
  EXPECT_TRUE(reported({.seed = GetParam()}).holds());
}

TEST_P(Burst, TwoRadiosAreAsGoodAsTheirOracle) {
  const BurstRun run = reported({.paths = 2, .seed = GetParam()});
  EXPECT_TRUE(run.holds());
  EXPECT_LE(run.of(Class::kSafety).p99, milliseconds(200));
}

TEST_P(Burst, BulkOfThreeTimesTheRateChangesNothing) {
  EXPECT_TRUE(reported({.load = 3.0, .seed = GetParam()}).holds());
}

// Loss alone is no congestion.
TEST_P(Burst, TheRateIsNeverTakenBack) {
  EXPECT_EQ(reported({.loss = 0.5, .load = 3.0, .seed = GetParam()}).rate_factor, 1.0);
}

// Half and more of the time nothing passes: the gaps between fades are as short as a slot.
TEST(BurstOfAnyKind, SafetyFollowsTheOracle) {
  for (const double loss : {0.1, 0.5, 0.7}) {
    const BurstRun run = reported({.loss = loss, .load = 1.0, .seed = 4, .length = seconds(120)});
    EXPECT_LE(run.of(Class::kSafety).p99, run.oracle.p99 + milliseconds(loss < 0.6 ? 65 : 100));
  }
  for (const auto fade : {milliseconds(50), milliseconds(300)}) {
    const BurstRun run = reported({.fade = fade, .load = 1.0, .seed = 5, .length = seconds(120)});
    EXPECT_LE(run.of(Class::kSafety).p99, run.oracle.p99 + milliseconds(65));
  }
}

// Two seconds of nothing each lap. How long after its end has the base samples that were taken
// after its end? Of a slow group the last one before its end does as well: it may have been on the
// air just then, and is not due again for long.
struct Return {
  Duration fast{}, all{};  // worst of all returns
};

void watch_return(VirtualRadio& radio, OfferedLoad& offered, Instant back, Return& worst) {
  std::array<bool, telemetry::kGroups> fresh{};
  for (int ms = 1; ms <= 1'000; ++ms) {
    offered.run(radio, milliseconds(1));
    for (const GroupRow& row : kGroupTable) {
      if (row.direction != Direction::kDown || fresh[telemetry::index_of(row.group)]) continue;
      const bool fast = row.priority <= Class::kMotion;
      const auto sample = radio.sample_at_base(row.group);
      if (sample && *sample >= back - (fast ? Duration{} : milliseconds(50))) {
        fresh[telemetry::index_of(row.group)] = true;
        continue;
      }
      Duration& of = fast ? worst.fast : worst.all;
      of = std::max(of, milliseconds(ms));
    }
  }
}

Return worst_return(double load, std::uint64_t seed) {
  link::LinkParams link = clean_link();
  // Each return meets the slots at another moment.
  const Duration length = seconds(2);
  const Duration every = milliseconds(8'137 + 13 * static_cast<std::int64_t>(seed));
  link.blackouts.push_back({Instant{} + seconds(6), length, every});
  RadioSetup setup = setup_of(link);
  setup.seed = seed;
  VirtualRadio radio(setup);
  OfferedLoad offered(kRate, load);
  Return worst;
  for (Instant back = Instant{} + seconds(8); back < Instant{} + seconds(120); back += every) {
    offered.run(radio, back - radio.now());
    watch_return(radio, offered, back, worst);
  }
  return worst;
}

TEST_P(Burst, AfterABlackoutAllIsFreshAtOnce) {
  for (const double load : {0.0, 3.0}) {
    const Return worst = worst_return(load, GetParam());
    std::printf("back after a blackout, load %.0fx: fast %.0f ms, all %.0f ms\n", load,
                worst.fast.milliseconds(), worst.all.milliseconds());
    EXPECT_LE(worst.fast, milliseconds(25) + kWay);
    EXPECT_LE(worst.all, milliseconds(150));
    EXPECT_GE(worst.fast, kWay);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Burst, ::testing::Values(1, 2, 3));

}  // namespace
}  // namespace pitwall::radio
