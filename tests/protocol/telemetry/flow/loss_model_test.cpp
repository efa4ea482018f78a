// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/flow/loss_model.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/draw.hpp"

namespace pitwall::telemetry {
namespace {

// Packets each 20 ms through exponential times in two states, as Gilbert and Elliott have it.
LossModel model_of(double good_s, double bad_s, double loss_good, int packets, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto draw = [&](double mean) { return testing::draw_exponential(random, mean); };
  LossModel model;
  bool bad = false;
  double state_ends_s = draw(good_s);
  for (int i = 0; i < packets; ++i) {
    while (i * 0.02 >= state_ends_s) {
      bad = !bad;
      state_ends_s += draw(bad ? bad_s : good_s);
    }
    model.note(bad || testing::draw_uniform(random) < loss_good);
  }
  return model;
}

TEST(LossModel, FindsTheTimesOfTheProcessThatMadeTheLoss) {
  struct Case {
    double good_s, bad_s, loss_good;
  };
  for (const Case& c : {Case{0.28, 0.12, 0.0}, Case{0.30, 0.12, 0.02}, Case{0.12, 0.12, 0.02},
                        Case{0.70, 0.30, 0.02}, Case{0.117, 0.05, 0.02}, Case{9.0, 1.0, 0.05}}) {
    const LossModel model = model_of(c.good_s, c.bad_s, c.loss_good, 400'000, 11);
    const auto fit = model.fit(milliseconds(20));
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->mean_bad.seconds(), c.bad_s, 0.12 * c.bad_s) << c.good_s;
    EXPECT_NEAR(fit->mean_good.seconds(), c.good_s, 0.12 * c.good_s) << c.bad_s;
  }
}

TEST(LossModel, SaysNothingWhereThereAreNoBursts) {
  for (const double loss : {0.0, 0.02, 0.3, 0.5, 1.0}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      EXPECT_FALSE(model_of(1e9, 1.0, loss, 50'000, seed).fit(milliseconds(20))) << loss;
    }
  }
}

TEST(LossModel, ALongOutageCountsAsManySingleOnes) {
  LossModel at_once, one_by_one;
  for (int round = 0; round < 50; ++round) {
    for (int i = 0; i < 20; ++i) at_once.note(i == 3), one_by_one.note(i == 3);
    at_once.note_lost(500);
    for (int i = 0; i < 500; ++i) one_by_one.note(true);
  }
  const auto a = at_once.fit(milliseconds(20)), b = one_by_one.fit(milliseconds(20));
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->mean_bad, b->mean_bad);
  EXPECT_EQ(a->mean_good, b->mean_good);
}

}  // namespace
}  // namespace pitwall::telemetry
