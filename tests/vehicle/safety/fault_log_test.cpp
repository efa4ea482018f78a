// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/fault_log.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "tests/vehicle/safety/situation.hpp"

namespace pitwall::safety {
namespace {

TEST(FaultLog, TheRingKeepsTheNewestInOrderAndCountsAll) {
  FaultLog log;
  std::vector<FaultEntry> shadow;
  EXPECT_EQ(log.size(), 0u);
  for (int i = 0; i < 300; ++i) {
    const FaultEntry entry{Instant{} + milliseconds(i),
                           static_cast<Cause>(1 + static_cast<std::size_t>(i) % (kCauses - 1)),
                           static_cast<double>(i)};
    log.record(entry, i >= 10);
    shadow.push_back(entry);
    ASSERT_EQ(log.total, shadow.size());
    ASSERT_EQ(log.size(), std::min(shadow.size(), kFaultEntries));
    for (std::size_t k = 0; k < log.size(); ++k)
      ASSERT_EQ(log.entry(k).value, shadow[shadow.size() - log.size() + k].value);
    ASSERT_EQ(log.first.value == 10.0, i >= 10) << "the first that stopped the car stays";
  }
  log.forget_first();
  EXPECT_EQ(log.first.cause, Cause::kNone);
  EXPECT_EQ(log.total, 300u);
}

TEST(FaultLog, EveryCauseHasItsOwnTextAndAReaction) {
  std::set<std::string> texts;
  for (const CauseRow& row : kCauseTable) {
    texts.insert(row.text);
    EXPECT_EQ(row.reaction == Reaction::kNone, row.cause == Cause::kNone) << row.text;
    if (row.reaction == Reaction::kEmergencyStop) {
      EXPECT_NE(row.arms, Arms::kAnyway) << row.text;
    }
    EXPECT_EQ(std::string{text_of(row.cause)}, row.text);
  }
  EXPECT_EQ(texts.size(), kCauses);
}

TEST(FaultLog, TheFiveRulesOfThePaperAreCausesOfTheirOwnWithADeadline) {
  std::set<Cause> rules;
  for (const CauseRow& row : kCauseTable) {
    if (!row.of_the_paper) continue;
    rules.insert(row.cause);
    EXPECT_EQ(row.reaction, Reaction::kControlledStop) << row.text;
    EXPECT_LE(row.deadline, milliseconds(1'300)) << row.text;
  }
  EXPECT_EQ(rules,
            (std::set{Cause::kGnssRateLost, Cause::kGnssUnitDisconnected, Cause::kGnssSolutionLost,
                      Cause::kGnssRtkLost, Cause::kLocalizationUncertain}));
}

TEST(CauseSet, BehavesAsASetAndNamesTheFirst) {
  testing::Random random{3};
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
  for (const Reaction least : {Reaction::kTell, Reaction::kCoast, Reaction::kEmergencyStop})
    for (const CauseRow& row : kCauseTable)
      EXPECT_EQ(each.at_least(least).has(row.cause), row.reaction >= least) << row.text;
  CauseSet none;
  none.add(Cause::kNone);
  EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace pitwall::safety
