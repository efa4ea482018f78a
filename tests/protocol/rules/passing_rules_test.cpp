// SPDX-License-Identifier: Apache-2.0
#include "protocol/rules/passing_rules.hpp"

#include <gtest/gtest.h>

namespace pitwall::rules {
namespace {

constexpr double kCar_m = 4.9;

class AtEveryLead : public testing::TestWithParam<bool> {
 protected:
  template <class Check>
  void for_each(Check check) const {
    for (double lead_m = -200.0; lead_m <= 200.0; lead_m += 0.1) {
      const Situation attacker{.role = Role::kAttacker,
                               .pass_allowed = GetParam(),
                               .lead_m = lead_m,
                               .length_m = kCar_m};
      Situation defender = attacker;
      defender.role = Role::kDefender;
      check(attacker, rights_of(rules_, attacker), rights_of(rules_, defender));
    }
  }
  PassingRules rules_;
};

TEST_P(AtEveryLead, ExactlyOneCarHasTheRightOfWayAndMustTakeTheInside) {
  for_each([](const Situation& now, const Rights& attacker, const Rights& defender) {
    EXPECT_NE(attacker.has_right_of_way, defender.has_right_of_way) << now.lead_m;
    EXPECT_NE(attacker.must_take_inside, defender.must_take_inside) << now.lead_m;
  });
}

TEST_P(AtEveryLead, WhatACarMustDoItMayDo) {
  for_each([](const Situation& now, const Rights& attacker, const Rights& defender) {
    for (const Rights& rights : {attacker, defender})
      EXPECT_TRUE(rights.may_take_inside || !rights.must_take_inside) << now.lead_m;
  });
}

TEST_P(AtEveryLead, TheAttackerKeepsOffTheInsideFromTailToThirtyMetresAhead) {
  for_each([](const Situation& now, const Rights& attacker, const Rights&) {
    const bool behind = now.lead_m <= -kCar_m;
    const bool clear = GetParam() && now.lead_m - kCar_m >= 30.0;
    EXPECT_EQ(attacker.may_take_inside, behind || clear) << now.lead_m;
  });
}

TEST_P(AtEveryLead, OnlyWavingGreenLetsTheAttackerDrawLevel) {
  for_each([](const Situation&, const Rights& attacker, const Rights&) {
    EXPECT_EQ(attacker.may_draw_level, GetParam());
  });
}

INSTANTIATE_TEST_SUITE_P(Flags, AtEveryLead, testing::Bool());

TEST(PassingRules, AnUnknownLeadPermitsNothingToTheAttacker) {
  const PassingRules rules;
  const Situation now{
      .role = Role::kAttacker, .pass_allowed = true, .lead_m = kUnset, .length_m = kCar_m};
  EXPECT_FALSE(rights_of(rules, now).may_take_inside);
  EXPECT_FALSE(rights_of(rules, now).has_right_of_way);
  EXPECT_FALSE(is_behind(now));
}

}  // namespace
}  // namespace pitwall::rules
