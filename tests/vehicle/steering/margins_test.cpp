// The margins of stability of the steering law over a family of linear cars, and the table of them
// in docs/safe_stop.md.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "protocol/vocabulary/units.hpp"
#include "tests/vehicle/steering/margin_family.hpp"

namespace pitwall::steering {
namespace {

using testing::expect_margins_of_a_car;
using testing::expect_margins_of_a_family;
using testing::expect_not_poor;
using testing::family;
using testing::kStable;
using testing::Loop;
using testing::loop_of;
using testing::LoopCase;
using testing::Margins;
using testing::margins_of;
using testing::row_of;
using testing::spectral_radius;
using testing::Worst;

std::string text_of(const LoopCase& c) {
  std::ostringstream out;
  out << c.speed_mps << ' ' << c.understeer << ' ' << c.friction << ' ' << c.front_share << ' '
      << c.rear_share << ' ' << c.delay_s << ' ' << c.lag_s << ' ' << c.learned;
  return out.str();
}

Worst over_family(const Params& params, bool learned) {
  Worst out;
  for (LoopCase c : family()) {
    c.learned = learned;
    out.add(loop_of(params, c));
  }
  return out;
}

Worst of_own_car(const Params& params) {
  Worst out;
  out.add(loop_of(params, {}));
  return out;
}

const Worst& this_law() {
  static const Worst worst = over_family({}, true);
  return worst;
}

const Worst& this_law_unlearned() {
  static const Worst worst = over_family({}, false);
  return worst;
}

const Worst& law_before() {
  static const Worst worst = over_family(testing::stiff(), true);
  return worst;
}

TEST(Margins, TheFamilyHasAsManyCarsAsThePageSays) { EXPECT_EQ(family().size(), 276U); }

TEST(Margins, TheWorstCarOfTheFamilyHasThem) { expect_margins_of_a_family(this_law()); }

TEST(Margins, WhileNothingIsLearnedTheWorstCarIsNotPoor) { expect_not_poor(this_law_unlearned()); }

TEST(Margins, OurOwnCarAtSpeedHasThoseOfATextbook) { expect_margins_of_a_car(of_own_car({})); }

// The tests above can fail.
TEST(Margins, TheLawBeforeHadThemNot) {
  EXPECT_GT(law_before().unstable, 0U);
  EXPECT_GT(of_own_car(testing::stiff()).margins.sensitivity, 2.5);
}

// By the poles of the closed loop, which the frequency response does not ask.
TEST(Margins, AtTheMarginTheClosedLoopCeasesToBeStable) {
  constexpr double kInside = 0.01;
  const std::vector<LoopCase> cars = family();
  for (std::size_t i = 0; i < cars.size(); i += 23) {
    const Loop loop = loop_of({}, cars[i]);
    const Margins m = margins_of(loop);
    EXPECT_LT(spectral_radius(loop, m.gain_up * (1.0 - kInside)), kStable) << text_of(cars[i]);
    EXPECT_GT(spectral_radius(loop, m.gain_up * (1.0 + kInside)), 1.0) << text_of(cars[i]);
    EXPECT_LT(spectral_radius(loop, m.gain_down * (1.0 + kInside)), kStable) << text_of(cars[i]);
    EXPECT_GT(spectral_radius(loop, m.gain_down * (1.0 - kInside)), 1.0) << text_of(cars[i]);
    const double ticks = m.delay_s / kTick.seconds();
    EXPECT_LT(spectral_radius(loop, 1.0, static_cast<std::size_t>(ticks)), kStable)
        << text_of(cars[i]);
    EXPECT_GT(spectral_radius(loop, 1.0, static_cast<std::size_t>(ticks) + 1), 1.0)
        << text_of(cars[i]);
  }
}

TEST(Margins, TheLawIsLinearNearAStraight) {
  for (const LoopCase& c : family()) {
    const testing::LawSystem one = law_of({}, c, 1e-4), other = law_of({}, c, 1e-5);
    for (std::size_t k = 0; k < 5; ++k) {
      for (std::size_t i = 0; i < 5; ++i) ASSERT_NEAR(one.a[k][i], other.a[k][i], 1e-9);
      for (std::size_t i = 0; i < testing::kMeasured; ++i)
        ASSERT_NEAR(one.b[k][i], other.b[k][i], 1e-9);
    }
  }
}

// The equations of path_steering.hpp and the car, written again in margins_oracle.py with SciPy.
TEST(Margins, SciPyFindsTheSame) {
  const Params p;
  std::vector<LoopCase> cars{LoopCase{}};
  for (std::size_t i = 5; i < family().size(); i += 41) {
    cars.push_back(family()[i]);
    cars.back().learned = i % 2 == 0;
  }
  std::ostringstream question;
  question << testing::kMass_kg << ' ' << testing::kInertia_kg_m2 << ' ' << testing::kFront_m << ' '
           << testing::kRear_m << ' ' << testing::kRearSlope_n_per_rad << ' '
           << testing::kFrictionOfSlopes << ' ' << testing::kRelaxation_m << ' '
           << testing::kComputerAndBus_s << '\n'
           << p.bicycle.wheelbase_m << ' ' << p.bicycle.understeer_rad_per_mps2 << ' '
           << p.bandwidth_rad_per_s << ' ' << p.damping << ' ' << p.lead_s << ' ' << p.gain_share
           << ' ' << p.observer_s << ' ' << p.observer_share << ' ' << p.trim_per_s << ' '
           << p.learning.lag_s << '\n';
  for (const LoopCase& c : cars) question << text_of(c) << '\n';
  const std::string asked = ::testing::TempDir() + "margins.in",
                    reported = ::testing::TempDir() + "margins.out";
  std::ofstream(asked) << question.str();
  const std::string command = "/usr/bin/python3 '" PITWALL_SOURCE_DIR
                              "/tests/vehicle/steering/margins_oracle.py' < '" +
                              asked + "' > '" + reported + "'";
  ASSERT_EQ(std::system(command.c_str()), 0)  // NOLINT: a test
      << "does /usr/bin/python3 have SciPy (python3-scipy)?";
  std::ifstream answer(reported);
  for (const LoopCase& c : cars) {
    Margins theirs;
    answer >> theirs.phase_rad >> theirs.gain_up >> theirs.gain_down >> theirs.delay_s >>
        theirs.sensitivity;
    ASSERT_TRUE(answer) << text_of(c);
    const Margins ours = margins_of(loop_of(p, c));
    EXPECT_NEAR(ours.phase_rad, theirs.phase_rad, 1e-4) << text_of(c);
    EXPECT_NEAR(ours.gain_up, theirs.gain_up, 1e-3) << text_of(c);
    EXPECT_NEAR(ours.gain_down, theirs.gain_down, 1e-4) << text_of(c);
    EXPECT_NEAR(ours.delay_s, theirs.delay_s, 1e-4) << text_of(c);
    EXPECT_NEAR(ours.sensitivity, theirs.sensitivity, 1e-3) << text_of(c);
  }
}

TEST(Margins, AreThoseOfThePage) {
  testing::expect_on_the_page(
      {row_of("this one", this_law()),
       row_of("this one, nothing learned yet", this_law_unlearned()),
       row_of("this one, our own car at 65 m/s", of_own_car({})),
       row_of("the one before", law_before()),
       row_of("the one before, our own car at 65 m/s", of_own_car(testing::stiff()))});
}

}  // namespace
}  // namespace pitwall::steering
