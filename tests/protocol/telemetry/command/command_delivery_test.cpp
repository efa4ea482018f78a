// Gate: a hundred thousand commands over air that loses half, each with one definite outcome.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "tests/protocol/telemetry/command/two_ends.hpp"

namespace pitwall::telemetry::testing {
namespace {

struct Tally {
  int issued = 0, without_fate = 0, twice = 0, late = 0, liars = 0, out_of_order = 0;
  std::array<int, kOutcomes> fates{};
  std::vector<double> known_after_ms;

  double quantile_ms(double q) {
    std::sort(known_after_ms.begin(), known_after_ms.end());
    return known_after_ms[static_cast<std::size_t>(q *
                                                   static_cast<double>(known_after_ms.size() - 1))];
  }
  int of(Outcome outcome) const { return fates[static_cast<std::size_t>(outcome)]; }
};

void settle(TwoEnds& rig, Tally& tally) {
  for (auto it = rig.histories.begin(); it != rig.histories.end();) {
    const auto& [id, history] = *it;
    const CommandProgress* progress = rig.transmitter.progress(id);
    if (progress == nullptr || !progress->outcome) {
      ++it;
      continue;
    }
    const bool applied = history.applied > 0;
    const Duration ttl = row_of(history.command.type).time_to_live;
    tally.twice += history.applied > 1;
    tally.late += applied && *history.applied_at - history.issued > ttl;
    tally.liars += applied != (progress->outcome == Outcome::kApplied);
    ++tally.fates[static_cast<std::size_t>(*progress->outcome)];
    if (history.known)
      tally.known_after_ms.push_back((*history.known - history.issued).milliseconds());
    it = rig.histories.erase(it);
  }
}

// `commands` of random types at random moments, and time until the last has its outcome.
Tally issue_many(TwoEnds& rig, int commands, int every_ms) {
  std::mt19937 random(rig.channel.seed);
  Tally tally;
  while (tally.issued < commands) {
    rig.tick();
    rig.now += kTickTime;
    if (random() % static_cast<unsigned>(every_ms) == 0) {
      const auto type = static_cast<CommandType>(random() % kCommandTypes);
      tally.issued += rig.issue(type, 1.0) ? 1 : 0;
    }
    if (rig.now.ns % seconds(1).ns == 0) settle(rig, tally);
  }
  for (int s = 0; s < 60 && rig.transmitter.open() > 0; ++s) rig.run(seconds(1));
  settle(rig, tally);
  tally.without_fate = static_cast<int>(rig.histories.size());
  tally.out_of_order = rig.out_of_order;
  return tally;
}

void expect_lawful(const Tally& tally) {
  EXPECT_EQ(tally.without_fate, 0);
  EXPECT_EQ(tally.twice, 0);
  EXPECT_EQ(tally.late, 0);
  EXPECT_EQ(tally.liars, 0) << "the base was told something else than what happened";
  EXPECT_EQ(tally.out_of_order, 0);
}

TEST(CommandDelivery, HundredThousandAtHalfLostEachWithOneFate) {
  TwoEnds rig({.fading = {.loss = 0.5}, .clock_bound = milliseconds(10), .seed = 11});
  Tally tally = issue_many(rig, 100'000, 25);
  expect_lawful(tally);
  EXPECT_LE(tally.quantile_ms(0.99), 160.0);
  EXPECT_GT(tally.of(Outcome::kApplied), 60'000);
  EXPECT_EQ(tally.of(Outcome::kApplied) + tally.of(Outcome::kSuperseded), tally.issued);
}

TEST(CommandDelivery, TwoRadiosHalveTheWait) {
  TwoEnds rig({.fading = {.loss = 0.5}, .radios = 2, .seed = 12});
  Tally tally = issue_many(rig, 20'000, 25);
  expect_lawful(tally);
  EXPECT_LE(tally.quantile_ms(0.99), 100.0);
}

TEST(CommandDelivery, FadesOfATenthOfASecond) {
  const Fading fading{.loss = 0.5, .mean_fade = milliseconds(120), .loss_between = 0.02};
  TwoEnds one({.fading = fading, .seed = 13});
  Tally tally = issue_many(one, 40'000, 25);
  expect_lawful(tally);
  EXPECT_LE(tally.quantile_ms(0.99), 600.0);
  TwoEnds two({.fading = fading, .radios = 2, .seed = 14});
  tally = issue_many(two, 40'000, 25);
  expect_lawful(tally);
  EXPECT_LE(tally.quantile_ms(0.99), 270.0);
}

// Seconds in a queue, doubles, any order: most come too late, and none of those acts.
TEST(CommandDelivery, LateDoubledAndShuffled) {
  TwoEnds rig({.fading = {.loss = 0.9},
               .delay_min = milliseconds(5),
               .delay_max = seconds(4),
               .twice = 0.5,
               .clock_bound = milliseconds(300),
               .seed = 15});
  rig.once = false;
  Tally tally = issue_many(rig, 10'000, 40);
  expect_lawful(tally);
  EXPECT_GT(tally.of(Outcome::kApplied), 500);
  EXPECT_GT(tally.of(Outcome::kExpired), 200);
  EXPECT_GT(tally.of(Outcome::kSuperseded), 200);
}

// A packet with room for a few records only, and always more to command than that: receipts must
// not wait behind commands, nor new results behind old ones for which no receipt came.
TEST(CommandDelivery, AStormInSmallPacketsNeverStandsStill) {
  TwoEnds rig({.fading = {.loss = 0.1}, .seed = 16});
  rig.room = 160;
  int issued = 0;
  for (int second = 0; second < 30; ++second) {
    const int before = issued;
    for (int ms = 0; ms < 1'000; ++ms) {
      for (int i = 0; i < 3; ++i) issued += rig.issue(CommandType::kRaceLine, ms % 30) ? 1 : 0;
      rig.run(milliseconds(1));
    }
    EXPECT_GE(issued - before, 20) << "nothing moves in second " << second;
  }
  Tally tally;
  for (int s = 0; s < 10 && rig.transmitter.open() > 0; ++s) rig.run(seconds(1));
  settle(rig, tally);
  EXPECT_EQ(rig.transmitter.open(), 0U);
  EXPECT_EQ(tally.twice + tally.late + tally.liars + rig.out_of_order, 0);
}

}  // namespace
}  // namespace pitwall::telemetry::testing
