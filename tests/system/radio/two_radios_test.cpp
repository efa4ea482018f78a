// Two radios, one of which is killed at random every two seconds.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/system/radio/radio_setups.hpp"

namespace pitwall::radio {
namespace {

using telemetry::Group;
using telemetry::PathId;

constexpr Duration kKillEvery = seconds(2);

// Runs with one radio dead at any time, another one chosen every two seconds.
void run_with_kills(VirtualRadio& radio, Duration length, std::uint32_t seed) {
  std::mt19937 dice(seed);
  for (Duration t{}; t < length; t = t + kKillEvery) {
    const bool dead = (dice() & 1U) != 0;
    radio.cut(0, dead, dead);
    radio.cut(1, !dead, !dead);
    radio.run(kKillEvery);
  }
}

TEST(TwoRadios, KillingOneCostsNothing) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    RadioSetup setup = setup_of(clean_link(), 2);
    setup.seed = seed;
    VirtualRadio whole(setup), killed(setup);
    for (VirtualRadio* radio : {&whole, &killed}) {
      radio->run(seconds(2));
      radio->reset_ages();
    }
    whole.run(seconds(60));
    run_with_kills(killed, seconds(60), static_cast<std::uint32_t>(seed));
    for (const Group group : {Group::kMode, Group::kFlags, Group::kEgo}) {
      // A packet has a byte or two more or less of the records of a path that is dead.
      EXPECT_LE(killed.ages().worst(group), whole.ages().worst(group) + milliseconds(1)) << seed;
    }
    EXPECT_EQ(killed.content_errors().all(), 0u);
    EXPECT_GT(killed.base_report().association.duplicates, 0u);
  }
}

TEST(TwoRadios, TheBetterPathOnlyStillHasSafetyOnBoth) {
  RadioSetup setup = setup_of(clean_link(), 2);
  setup.policy = telemetry::PathPolicy::kBest;
  VirtualRadio killed(setup), single(setup_of(clean_link()));
  for (VirtualRadio* radio : {&single, &killed}) {
    radio->run(seconds(2));
    radio->reset_ages();
  }
  single.run(seconds(60));
  run_with_kills(killed, seconds(60), 5);
  // As if it were one radio that nobody kills, but for the byte or two of a second path's records.
  EXPECT_LE(killed.ages().worst(Group::kMode), single.ages().worst(Group::kMode) + milliseconds(1));
  EXPECT_EQ(killed.content_errors().all(), 0u);
}

TEST(TwoRadios, BothLostSaysHowIndependentTheyAre) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    VirtualRadio radio(fading(0.3, milliseconds(120), seed, 2));
    std::uint64_t sent = 0, copies = 0;
    radio.tap([&](bool down, PathId path, std::span<const std::uint8_t> bytes) {
      const bool data = telemetry::parse_header(bytes)->kind == telemetry::Kind::kSealed;
      if (down && data) ++(path == 0 ? sent : copies);
      return true;
    });
    radio.run(seconds(300));
    ASSERT_EQ(sent, copies);  // everything went on both
    const double truth = 1.0 - static_cast<double>(radio.arrivals()) / static_cast<double>(sent);
    EXPECT_NEAR(radio.base_report().both_lost, truth, 0.05 * truth + 0.002) << seed;
    for (const PathId path : {PathId{0}, PathId{1}}) {
      EXPECT_NEAR(radio.base_report().paths[path].received.loss, 0.3, 0.35) << seed;
    }
  }
}

}  // namespace
}  // namespace pitwall::radio
