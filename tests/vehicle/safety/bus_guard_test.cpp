// The laws of the guard over random links and random parameters, and its story once told straight.
// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/bus_guard.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "tests/support/tick.hpp"
#include "tests/vehicle/safety/situation.hpp"

namespace pitwall::safety {
namespace {

using world::ControllerState;
using world::LinkObservation;

constexpr Instant kStart{seconds(1).ns};

const LinkObservation kHealthy{.controller = ControllerState::kActive};
const LinkObservation kBusOff{.controller = ControllerState::kBusOff};

LinkObservation stalled(Duration since) {
  return {.controller = ControllerState::kPassive, .tx_stalled = since};
}

BusGuardParams random_params(Random& random) {
  return {.restarts = static_cast<std::uint8_t>(random.below(kRestartsMax + 1)),
          .window = milliseconds(static_cast<std::int64_t>(1'000 + random.below(5'000))),
          .pause = milliseconds(static_cast<std::int64_t>(10 + random.below(990))),
          .stall_max = milliseconds(static_cast<std::int64_t>(20 + random.below(980)))};
}

// Stays as it is for a while, then changes: every kind of link.
struct RandomLink {
  Random& random;
  LinkObservation now{};
  LinkObservation next() {
    now.tx_stalled = now.tx_stalled > Duration{} ? now.tx_stalled + kTick : Duration{};
    if (random.one_in(15)) now.controller = static_cast<ControllerState>(random.below(6));
    if (random.one_in(40)) now.tx_stalled = random.one_in(2) ? kTick : Duration{};
    return now;
  }
};

bool is_down(const BusGuardParams& params, const LinkObservation& link) {
  return link.controller == ControllerState::kBusOff || link.controller == ControllerState::kDown ||
         link.tx_stalled >= params.stall_max;
}

struct Step {
  Instant now;
  bool down, reset;
  BusGuardOutput out;
};

std::vector<Step> drive(std::uint64_t seed, BusGuardParams& params) {
  Random random{seed};
  params = random_params(random);
  RandomLink link{random};
  BusGuardState state;
  std::vector<Step> steps;
  bool reset = false;
  for (Instant now = kStart; now < kStart + seconds(30); now += kTick) {
    const LinkObservation seen = link.next();
    if (random.one_in(50)) reset = !reset;
    const auto out = guard(params, state, seen, reset, now);
    steps.push_back({now, is_down(params, seen), reset, out});
  }
  return steps;
}

TEST(BusGuard, NeverMoreRestartsThanAllowedInAnyWindow) {
  std::size_t restarts = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    BusGuardParams params;
    std::vector<Instant> at;
    for (const Step& step : drive(seed, params))
      if (step.out.restart_now) at.push_back(step.now);
    restarts += at.size();
    for (std::size_t i = params.restarts; i < at.size(); ++i)
      ASSERT_GE(at[i] - at[i - params.restarts], params.window) << "seed " << seed;
    if (params.restarts == 0) {
      ASSERT_TRUE(at.empty()) << "seed " << seed;
    }
  }
  EXPECT_GT(restarts, 500u);  // or nothing was tested
}

TEST(BusGuard, RestartsOnlyWhatIsDownNeverAfterFailureAndNotInHaste) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    BusGuardParams params;
    Instant down_since{}, last{};
    bool was_down = false;
    for (const Step& step : drive(seed, params)) {
      if (step.down && !was_down) down_since = step.now;
      was_down = step.down;
      if (!step.out.restart_now) continue;
      ASSERT_TRUE(step.down) << "seed " << seed;
      ASSERT_FALSE(step.out.failed) << "seed " << seed;
      ASSERT_GE(step.now - std::max(down_since, last), params.pause) << "seed " << seed;
      last = step.now;
    }
  }
}

TEST(BusGuard, TheLatchFallsOnlyOnARisingResetOfAHealthyBus) {
  std::size_t latched = 0, released = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    BusGuardParams params;
    bool failed = false, reset = false;
    for (const Step& step : drive(seed, params)) {
      const bool edge = step.reset && !reset;
      if (failed && !step.out.failed) {
        ASSERT_TRUE(edge && !step.down) << "seed " << seed;
        ++released;
      }
      if (failed && edge && !step.down) {
        ASSERT_FALSE(step.out.failed) << "seed " << seed;
      }
      if (!failed && step.out.failed) {
        ASSERT_TRUE(step.down) << "seed " << seed;
        ++latched;
      }
      failed = step.out.failed;
      reset = step.reset;
    }
  }
  EXPECT_GT(latched, 50u);
  EXPECT_GT(released, 50u);
}

TEST(BusGuard, WhateverStaysDownEndsInTheLatchInTime) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Random random{seed};
    const BusGuardParams params = random_params(random);
    BusGuardState state;
    const Duration bound = params.pause * (params.restarts + 1) + params.stall_max + 9 * kTick;
    Instant now = kStart;
    Duration stall{};
    const bool by_stall = random.one_in(2);
    bool failed = false;
    std::size_t restarts = 0;
    for (; now - kStart <= bound && !failed; now += kTick) {
      stall = stall + kTick;
      const auto out = guard(params, state, by_stall ? stalled(stall) : kBusOff, false, now);
      failed = out.failed;
      restarts += out.restart_now ? 1 : 0;
    }
    ASSERT_TRUE(failed) << "seed " << seed;
    ASSERT_EQ(restarts, params.restarts) << "seed " << seed;
  }
}

TEST(BusGuard, AHealthyBusIsLeftAlone) {
  const BusGuardParams params;
  BusGuardState state;
  for (Instant now = kStart; now < kStart + seconds(100); now += kTick)
    for (const ControllerState healthy : {ControllerState::kUnknown, ControllerState::kActive,
                                          ControllerState::kWarning, ControllerState::kPassive}) {
      const auto out = guard(
          params, state,
          {.controller = healthy, .tx_drops = 7, .tx_stalled = params.stall_max - nanoseconds(1)},
          false, now);
      ASSERT_FALSE(out.restart_now || out.failed);
    }
}

TEST(BusGuard, TheSameInputsGiveTheSameOutputs) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    BusGuardParams a, b;
    const auto first = drive(seed, a), second = drive(seed, b);
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
      ASSERT_EQ(first[i].out.restart_now, second[i].out.restart_now);
      ASSERT_EQ(first[i].out.failed, second[i].out.failed);
    }
  }
}

// GIVEN three restarts that helped WHEN the controller goes bus-off a fourth time in ten seconds
// THEN it has failed at once, and stays so until somebody resets it while it is well.
TEST(BusGuard, TheFourthBusOffOfTenSecondsIsTheLast) {
  const BusGuardParams params{.restarts = 3};
  BusGuardState state;
  Instant now = kStart;
  const auto tick = [&](const LinkObservation& link, bool reset = false) {
    now += kTick;
    return guard(params, state, link, reset, now);
  };
  for (int i = 0; i < 3; ++i) {
    int ticks = 0;
    while (!tick(kBusOff).restart_now) ASSERT_LT(++ticks, 20);
    EXPECT_EQ(ticks, params.pause / kTick);
    for (int k = 0; k < 100; ++k) ASSERT_FALSE(tick(kHealthy).failed);
  }
  EXPECT_TRUE(tick(kBusOff).failed);
  EXPECT_TRUE(tick(kBusOff, true).failed);   // a reset does not help a bus that is off
  EXPECT_TRUE(tick(kHealthy, true).failed);  // nor does a button that is still held
  EXPECT_TRUE(tick(kHealthy).failed);
  EXPECT_FALSE(tick(kHealthy, true).failed);
  EXPECT_TRUE(tick(kBusOff).failed);  // the restarts are still spent
  EXPECT_EQ(state.restarts_total, 3u);
  now += params.window;
  EXPECT_FALSE(tick(kHealthy).restart_now);
  EXPECT_FALSE(tick(kHealthy, true).failed);
  EXPECT_FALSE(tick(kBusOff).failed);  // and given back by time
}

}  // namespace
}  // namespace pitwall::safety
