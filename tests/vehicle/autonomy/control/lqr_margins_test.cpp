// The margins of stability of the lateral law lqr_ff over the family of linear cars over which the
// law of a stop is judged, by the same bounds (margin_family.hpp).
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <vector>

#include "tests/vehicle/autonomy/control/lqr_loop.hpp"

namespace pitwall::control {
namespace {

using steering::testing::family;
using steering::testing::kStable;
using steering::testing::LoopCase;
using steering::testing::Margins;
using steering::testing::margins_of;
using steering::testing::spectral_radius;
using steering::testing::Worst;
using testing::lqr_loop_of;
using testing::LqrLoop;
using testing::recommended;

LqrGains designed(const LqrParams& params) { return design(params, recommended().bicycle).value(); }

Worst over(const LqrParams& params, std::vector<LoopCase> cars, bool learned) {
  const LqrGains gains = designed(params);
  Worst out;
  for (LoopCase& c : cars) {
    c.learned = learned;
    out.add(lqr_loop_of(gains, c));
  }
  return out;
}

// The whole family is judged once, for the bounds and for the page.
TEST(LqrMargins, TheWorstCarsHoldTheBoundsAndAreThoseOfThePage) {
  const LqrParams& law = recommended().lqr_ff;
  const Worst learned = over(law, family(), true), not_yet = over(law, family(), false);
  expect_margins_of_a_family(learned);
  expect_not_poor(not_yet);
  steering::testing::expect_on_the_page(
      {row_of("lqr_ff", learned), row_of("lqr_ff, nothing learned yet", not_yet),
       row_of("lqr_ff, our own car at 65 m/s", over(law, {LoopCase{}}, true))});
}

TEST(LqrMargins, OurOwnCarHasThoseOfATextbookAtEverySpeed) {
  for (const double speed_mps : {10.0, 15.0, 22.0, 30.0, 37.0, 45.0, 55.0, 65.0, 75.0}) {
    SCOPED_TRACE(speed_mps);
    expect_margins_of_a_car(over(recommended().lqr_ff, {{.speed_mps = speed_mps}}, true));
  }
}

// Where the gains are interpolated.
TEST(LqrMargins, NoCarOfTheFamilyIsPoorBetweenTheSpeedsOfTheDesign) {
  expect_not_poor(
      over(recommended().lqr_ff, family({12.0, 18.0, 26.0, 33.0, 41.0, 50.0, 60.0}), true));
}

// The tests above can fail: the weights of the fastest speeds are too much for the slower ones, and
// a car that is believed to steer without a delay is not stable.
TEST(LqrMargins, OtherWeightsHaveThemNot) {
  LqrParams stiff = recommended().lqr_ff;
  for (LqrWeights& w : stiff.weights) w = {.turn = 0.0, .angle = 200.0};
  EXPECT_GT(over(stiff, family(), true).unstable, 0U);
  LqrParams prompt = stiff;
  prompt.delay_s = 0.01, prompt.lag_s = 0.02;
  EXPECT_EQ(over(prompt, {LoopCase{}}, true).unstable, 1U);
}

// By the poles of the closed loop, which the frequency response does not ask.
TEST(LqrMargins, AtTheMarginTheClosedLoopCeasesToBeStable) {
  constexpr double kInside = 0.01;
  const LqrGains gains = designed(recommended().lqr_ff);
  const std::vector<LoopCase> cars = family();
  for (std::size_t i = 0; i < cars.size(); i += 47) {
    const LqrLoop loop = lqr_loop_of(gains, cars[i]);
    const Margins m = margins_of(loop);
    EXPECT_LT(spectral_radius(loop, m.gain_up * (1.0 - kInside)), kStable) << i;
    EXPECT_GT(spectral_radius(loop, m.gain_up * (1.0 + kInside)), 1.0) << i;
    EXPECT_LT(spectral_radius(loop, m.gain_down * (1.0 + kInside)), kStable) << i;
    EXPECT_GT(spectral_radius(loop, m.gain_down * (1.0 - kInside)), 1.0) << i;
  }
}

}  // namespace
}  // namespace pitwall::control
