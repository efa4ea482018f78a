// SPDX-License-Identifier: Apache-2.0
// No false alarm: a car that nothing is wrong with, at speed, over every corner of a lap.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "hil/bench/loading.hpp"
#include "hil/bench/lockstep/lockstep.hpp"
#include "vehicle/safety/causes.hpp"
#include "vehicle/safety/watchdog.hpp"

namespace pitwall::bench {
namespace {

constexpr Instant kRolls = Instant{} + seconds(14);  // green

TEST(Nominal, NothingIsFoundNothingIsSeenAndTheCarDrives) {
  const std::string root = PITWALL_SOURCE_DIR;
  auto loaded = load(root + "/hil/scenarios/nominal.yaml", root);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  loaded->scenario.duration = seconds(75);
  loaded->scenario.expect.clear();
  safety::CauseSet causes;
  world::MonitorSet seen;
  Instant first_cause{}, first_seen{};
  double fastest_mps = 0.0;
  int elsewhere = 0;
  safety::Health worst = safety::Health::kGood;
  const auto watch = [&](const pipeline::Outputs& out, const Rig&, Instant now) {
    if (now < kRolls) return;
    if (causes.empty() && !out.chosen.causes.empty()) first_cause = now;
    if (seen.empty() && !out.seen.empty()) first_seen = now;
    for (const safety::CauseRow& row : safety::kCauseTable)
      if (out.chosen.causes.has(row.cause)) causes.add(row.cause);
    seen.add(out.seen);
    elsewhere += out.chosen.mode != world::Mode::kDriving;
    fastest_mps = std::max(fastest_mps, out.chosen.speed_mps);
    if (now > kRolls + seconds(2))
      for (const safety::StreamRow& row : out.watchdog.rows) worst = std::max(worst, row.health);
  };
  const auto run = run_lockstep(loaded->scenario, loaded->setup, {.watch = watch});
  ASSERT_TRUE(run) << to_string(run.error());
  EXPECT_EQ(causes.bits(), 0u) << safety::text_of(causes.first()) << " at "
                               << (first_cause - Instant{}).seconds();
  EXPECT_EQ(seen.bits, 0u) << "at " << (first_seen - Instant{}).seconds();
  EXPECT_LE(elsewhere, 5);
  EXPECT_EQ(worst, safety::Health::kGood);
  EXPECT_GT(fastest_mps, 60.0);
}

}  // namespace
}  // namespace pitwall::bench
