// A launch from standstill is where wrong stamps first show: a car that stands is at its place at
// any time. Nothing is wrong here, so nothing may be reckoned for long, and nobody coasts.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "hil/bench/loading.hpp"
#include "tests/system/localization/scored_run.hpp"

namespace pitwall::bench {
namespace {

constexpr double kUnderWay_s = 9.0, kRedAgain_s = 28.0;  // of launch_and_stop: armed, and red again

struct Launch {
  Instant position_at{};  // when the newest one that was taken in was true
  double oldest_position_s = 0.0;
  std::size_t reckoning = 0, coasting = 0;  // ticks
  std::size_t refused = 0, taken = 0;       // positions and velocities
  double speed_mps = 0.0;
};

void note(const localization::Verdict& v, Instant now, Launch& launch) {
  const bool position = v.source == localization::Source::kPosition;
  if (!position && v.source != localization::Source::kVelocity) return;
  if (v.gate == localization::Gate::kOutlier) ++launch.refused;
  if (v.gate != localization::Gate::kAccepted) return;
  ++launch.taken;
  if (position) launch.position_at = now - from_seconds(v.age_s);
}

void note(const pipeline::Outputs& out, Instant now, Launch& launch) {
  for (const localization::Verdict& v : out.located) note(v, now, launch);
  if ((now - Instant{}).seconds() < kUnderWay_s) return;
  launch.oldest_position_s =
      std::max(launch.oldest_position_s, (now - launch.position_at).seconds());
  if (out.ego.validity != world::Validity::kGood) ++launch.reckoning;
  if (out.chosen.mode == world::Mode::kCoast) ++launch.coasting;
  launch.speed_mps = std::max(launch.speed_mps, out.ego.vx_mps);
}

TEST(Launch, NobodyCoastsAndNoPositionIsRefused) {
  const std::string root = PITWALL_SOURCE_DIR;
  const auto read = load(root + "/hil/scenarios/launch_and_stop.yaml", root);
  ASSERT_TRUE(read) << to_string(read.error());
  std::size_t refused = 0, taken = 0;
  for (std::uint64_t seed = 1; seed <= std::max<std::uint64_t>(12, seeds(12)); ++seed) {
    scenario::Scenario s = read->scenario;
    s.seed = seed;
    s.duration = from_seconds(kRedAgain_s);
    Launch launch;
    LockstepOptions options;
    options.watch = [&](const pipeline::Outputs& out, const Rig&, Instant now) {
      note(out, now, launch);
    };
    const auto result = run_lockstep(s, read->setup, options);
    ASSERT_TRUE(result) << to_string(result.error());
    EXPECT_GT(launch.speed_mps, 30.0) << seed;
    EXPECT_EQ(launch.coasting, 0U) << seed;
    EXPECT_EQ(launch.reckoning, 0U) << seed;
    EXPECT_LE(launch.oldest_position_s, 0.3) << seed;
    refused += launch.refused;
    taken += launch.taken;
  }
  std::printf("%zu of %zu positions and velocities refused\n", refused, refused + taken);
  EXPECT_LE(refused, taken / 10'000) << "the gates are quantiles of once in 100,000";
}

}  // namespace
}  // namespace pitwall::bench
