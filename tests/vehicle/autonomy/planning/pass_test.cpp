// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/pass.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "protocol/vocabulary/random.hpp"
#include "tests/support/reversals.hpp"
#include "tests/vehicle/autonomy/planning/race_rig.hpp"
#include "vehicle/autonomy/planning/paper_race.hpp"

namespace pitwall::planning {
namespace {

using enum PassPhase;

constexpr Duration kTick = milliseconds(50);
constexpr double kRound_mps = 60.0;

struct Machine {
  PassParams params = testing::pass_params();
  PassState state;
  Instant now{};
  PassWay ways[2] = {{.beside_m = 0.0, .gained_m = 0.0}, {.beside_m = 6.0, .gained_m = 60.0}};

  double tick(double gap_m, bool may_pass, double rival_mps = kRound_mps, bool known = true,
              double rival_n_m = 3.0) {
    now += kTick;
    Rival rival;
    if (known)
      rival = {.known = true,
               .id = 1,
               .gap_m = gap_m,
               .n_m = rival_n_m,
               .speed_mps = rival_mps,
               .drift_mps = 0.0,
               .at = now,
               .measured_at = now};
    const PassInputs in{.rival = rival,
                        .base_mps = kRound_mps,
                        .most_mps = 100.0,
                        .may_pass = may_pass,
                        .may_close = true,
                        .ways = ways,
                        .line_n_m = state.line == 0 ? 3.0 : -3.0,
                        .speed_mps = kRound_mps,
                        .has_merged = true};
    state = params.law == PassLaw::kPaper ? advance_paper(params, state, in, 2, now)
                                          : advance(params, state, in, now);
    return pass_speed_mps(params, state, in);
  }
};

// Box and Muller.
double gaussian(Random& random) {
  const double turn_rad = 2.0 * std::numbers::pi * random.uniform();
  return std::sqrt(-2.0 * std::log(1.0 - random.uniform())) * std::cos(turn_rad);
}

// An hour side by side, with noise of 1 m rms on the gap: so the paper lost its last pass.
std::size_t reversals_in_an_hour(PassLaw law, double correlation_s, bool may_pass) {
  Machine machine;
  machine.params.law = law;
  Random random{17};
  const double keep = std::exp(-0.05 / correlation_s), add = std::sqrt(1.0 - keep * keep);
  double noise_m = gaussian(random);
  for (int i = 0; i < 40; ++i) machine.tick(-25.0 + i * 0.625, may_pass);  // up to its side
  pitwall::testing::Reversals reversals;
  for (int i = 0; i < 72'000; ++i) {
    noise_m = keep * noise_m + add * gaussian(random);
    reversals.take(machine.tick(noise_m, may_pass));
  }
  return reversals.count();
}

TEST(Pass, AnHourSideBySideReversesNoSpeed) {
  for (const double correlation_s : {0.05, 0.5, 2.0}) {
    EXPECT_EQ(reversals_in_an_hour(PassLaw::kCommitted, correlation_s, true), 0U) << correlation_s;
    EXPECT_EQ(reversals_in_an_hour(PassLaw::kCommitted, correlation_s, false), 0U) << correlation_s;
    EXPECT_GT(reversals_in_an_hour(PassLaw::kPaper, correlation_s, true), 100U) << correlation_s;
  }
}

TEST(Pass, OnlyTheListedTransitionsHappenWhateverHappens) {
  const std::set<std::pair<PassPhase, PassPhase>> listed{
      {kFree, kTrail}, {kTrail, kPass},  {kTrail, kFree},  {kPass, kAhead}, {kPass, kYield},
      {kAhead, kFree}, {kAhead, kYield}, {kYield, kTrail}, {kYield, kFree}};
  std::set<std::pair<PassPhase, PassPhase>> met;
  Random random{5};
  for (int history = 0; history < 400; ++history) {
    Machine machine;
    double gap_m = -60.0 + 120.0 * random.uniform(), rate_mps = 0.0, n_m = 3.0;
    bool may_pass = false, known = true;
    for (int i = 0; i < 2'000; ++i) {
      if (random.uniform() < 0.01) rate_mps = 20.0 * (random.uniform() - 0.5);
      if (random.uniform() < 0.005) may_pass = !may_pass;
      if (random.uniform() < 0.005) known = !known;
      if (random.uniform() < 0.005) n_m = -4.0 + 8.0 * random.uniform();
      machine.ways[1].beside_m = std::abs(n_m + 3.0);
      gap_m = std::clamp(gap_m + rate_mps * 0.05, -140.0, 75.0);
      const PassPhase before = machine.state.phase;
      const Instant since = machine.state.since;
      const double speed_mps = machine.tick(gap_m, may_pass, kRound_mps, known, n_m);
      const PassPhase after = machine.state.phase;
      ASSERT_TRUE(std::isfinite(speed_mps) && speed_mps >= 0.0);
      if (before == after) continue;
      EXPECT_TRUE(listed.contains({before, after}))
          << static_cast<int>(before) << " -> " << static_cast<int>(after);
      met.insert({before, after});
      if (before == kTrail && after == kPass) {
        EXPECT_GE((machine.now - since).seconds(), machine.params.dwell_s);
      }
    }
  }
  EXPECT_EQ(met, listed);
}

TEST(Pass, TheSpeedOfAPassNeverFallsWhileItLasts) {
  Machine machine;
  for (int i = 0; i < 20; ++i) machine.tick(-25.0, true);
  ASSERT_EQ(machine.state.phase, kPass);
  double last_mps = 0.0;
  for (int i = 0; i < 400; ++i) {
    const double mps = machine.tick(-25.0 + 0.1 * i, true, kRound_mps + 2.0 * std::sin(0.1 * i));
    if (machine.state.phase != kPass) break;
    EXPECT_GE(mps, last_mps);
    last_mps = mps;
  }
  EXPECT_NEAR(last_mps, kRound_mps + 2.0 + machine.params.pass_extra_mps, 0.1);
}

TEST(Pass, WhyNoPassBeginsIsSaid) {
  const auto bar = [](auto change) {
    Machine machine;
    change(machine);
    for (int i = 0; i < 40; ++i) machine.tick(-25.0, true);
    EXPECT_EQ(machine.state.phase, kTrail);
    return machine.state.bar;
  };
  EXPECT_EQ(bar([](Machine& m) { m.ways[1].beside_m = 3.4; }), PassBar::kNoLine);
  EXPECT_EQ(bar([](Machine& m) { m.ways[1].gained_m = 32.0; }), PassBar::kTooSlow);
  Machine unseen;
  for (int i = 0; i < 40; ++i) unseen.tick(-25.0, false);
  EXPECT_EQ(unseen.state.bar, PassBar::kNotAllowed);
}

TEST(Pass, ACarInTheWayIsNeverApproachedFasterThanItsBrakesAllow) {
  const PassParams p = testing::pass_params();
  for (double ahead_m = 0.0; ahead_m < 200.0; ahead_m += 3.0)
    for (const double car_mps : {0.0, 10.0, 40.0}) {
      const double mps = follow_mps(p, p.brake_mps2, ahead_m, car_mps, false);
      const double room_m = std::max(ahead_m - kLeastGap_m, 0.0);
      EXPECT_LE(mps * mps - car_mps * car_mps, 2.0 * p.brake_mps2 * room_m + 1e-9);
      EXPECT_LE(follow_mps(p, p.brake_mps2, ahead_m, car_mps, true), mps);
    }
}

}  // namespace
}  // namespace pitwall::planning
