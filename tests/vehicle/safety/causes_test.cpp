// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/causes.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/vehicle/safety/situation.hpp"

namespace pitwall::safety {
namespace {

TEST(Causes, EveryCauseHasItsOwnTextAndAReaction) {
  std::set<std::string> texts;
  for (const CauseRow& row : kCauseTable) {
    texts.insert(row.text);
    EXPECT_EQ(row.reaction == Reaction::kNone, row.cause == Cause::kNone) << row.text;
    if (row.reaction == Reaction::kEmergencyStop) {
      EXPECT_NE(row.arms, ArmingEffect::kAllows) << row.text;
    }
    EXPECT_EQ(std::string{text_of(row.cause)}, row.text);
  }
  EXPECT_EQ(texts.size(), kCauses);
}

TEST(Causes, TheFiveRulesOfThePaperAreCausesOfTheirOwnWithADeadline) {
  std::set<Cause> rules;
  for (const CauseRow& row : kCauseTable) {
    if (!row.listed_in_paper) continue;
    rules.insert(row.cause);
    EXPECT_EQ(row.reaction, Reaction::kControlledStop) << row.text;
    EXPECT_LE(row.deadline, milliseconds(1'300)) << row.text;
  }
  EXPECT_EQ(rules,
            (std::set{Cause::kGnssRateLost, Cause::kGnssUnitDisconnected, Cause::kGnssSolutionLost,
                      Cause::kGnssRtkLost, Cause::kLocalizationUncertain}));
}

TEST(CauseSet, BehavesAsASetAndNamesTheFirst) {
  Random random{3};
  for (int run = 0; run < 2000; ++run) {
    std::set<Cause> a, b;
    CauseSet set_a, set_b;
    for (std::uint64_t n = random.below(6); n > 0; --n) {
      const auto cause = static_cast<Cause>(1 + random.below(kCauses - 1));
      a.insert(cause);
      set_a.add(cause);
    }
    for (std::uint64_t n = random.below(6); n > 0; --n) {
      const auto cause = static_cast<Cause>(1 + random.below(kCauses - 1));
      b.insert(cause);
      set_b.add(cause);
    }
    EXPECT_EQ(set_a.empty(), a.empty());
    EXPECT_EQ(set_a.first(), a.empty() ? Cause::kNone : *a.begin());
    for (std::size_t i = 1; i < kCauses; ++i) {
      const auto cause = static_cast<Cause>(i);
      EXPECT_EQ(set_a.has(cause), a.contains(cause));
      EXPECT_EQ(set_a.without(set_b).has(cause), a.contains(cause) && !b.contains(cause));
    }
  }
  CauseSet each;
  for (std::size_t i = 1; i < kCauses; ++i) each.add(static_cast<Cause>(i));
  for (const Reaction least : {Reaction::kNotify, Reaction::kCoast, Reaction::kEmergencyStop})
    for (const CauseRow& row : kCauseTable)
      EXPECT_EQ(each.at_least(least).has(row.cause), row.reaction >= least) << row.text;
  CauseSet none;
  none.add(Cause::kNone);
  EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace pitwall::safety
