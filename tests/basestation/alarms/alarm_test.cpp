// SPDX-License-Identifier: Apache-2.0
#include "basestation/alarms/alarm.hpp"

#include <gtest/gtest.h>

#include <random>

namespace pitwall::alarms {
namespace {

using enum State;

// One alarm, a value that is looked at every 10 ms.
struct Bench {
  AlarmRow row{.key = "test",
               .text = "t",
               .response = "r",
               .priority = Priority::kHigh,
               .field = 0,
               .side = Side::kAbove,
               .limit = 10.0,
               .deadband = 2.0,
               .on_delay = milliseconds(100),
               .off_delay = milliseconds(500),
               .latched = false,
               .silent_in = {}};
  Alarm alarm;
  Instant now{seconds(50).ns};
  double value = 0.0;
  bool usable = true, suppressed = false;
  int announced = 0;

  State run(Duration length) {
    for (const Instant end = now + length; now < end;) {
      now += milliseconds(10);
      const AlarmSetting setting{row.priority, row.limit, row.deadband, row.on_delay,
                                 row.off_delay};
      announced += alarm.update(row, setting, {value, usable}, suppressed, now) ? 1 : 0;
    }
    return alarm.state();
  }
  State run(Duration length, double to) {
    value = to;
    return run(length);
  }
};

TEST(Alarm, ComesIsSeenGoes) {
  Bench bench;
  EXPECT_EQ(bench.run(seconds(1), 11), kUnack);
  EXPECT_TRUE(bench.alarm.acknowledge());
  EXPECT_EQ(bench.alarm.state(), kAcked);
  EXPECT_EQ(bench.run(seconds(1), 0), kNormal);
}

TEST(Alarm, WhatWasNotSeenStays) {
  Bench bench;
  bench.run(seconds(1), 11);
  EXPECT_EQ(bench.run(seconds(100), 0), kReturnedUnack);
  EXPECT_TRUE(bench.alarm.acknowledge());
  EXPECT_EQ(bench.alarm.state(), kNormal);
}

TEST(Alarm, DelaysCountFromTheCrossing) {
  Bench bench;
  EXPECT_EQ(bench.run(milliseconds(100), 11), kNormal);  // the crossing is in the first look
  EXPECT_EQ(bench.run(milliseconds(10)), kUnack);
  EXPECT_EQ(bench.run(milliseconds(500), 0), kUnack);
  EXPECT_EQ(bench.run(milliseconds(10)), kReturnedUnack);
}

TEST(Alarm, ShorterThanTheOnDelayIsNone) {
  Bench bench;
  for (int i = 0; i < 50; ++i) {
    bench.run(milliseconds(100), 11);
    EXPECT_EQ(bench.run(milliseconds(20), 0), kNormal);
  }
}

TEST(Alarm, ItGoesOnlyBelowTheDeadband) {
  Bench bench;
  bench.run(seconds(1), 11);
  EXPECT_EQ(bench.run(seconds(5), 8.5), kUnack);
  EXPECT_EQ(bench.run(seconds(1), 7.9), kReturnedUnack);
  EXPECT_EQ(bench.run(seconds(5), 10.0), kReturnedUnack);  // at the limit: not above it
  EXPECT_EQ(bench.announced, 1);
}

TEST(Alarm, ALatchedOneWaitsForItsReset) {
  Bench bench;
  bench.row.latched = true;
  bench.run(seconds(1), 11);
  EXPECT_FALSE(bench.alarm.reset());
  EXPECT_EQ(bench.run(seconds(1), 0), kReturnedUnack);
  EXPECT_FALSE(bench.alarm.reset());  // nobody has seen it
  EXPECT_TRUE(bench.alarm.acknowledge());
  EXPECT_EQ(bench.alarm.state(), kLatched);
  EXPECT_EQ(bench.run(seconds(100)), kLatched);
  EXPECT_EQ(bench.run(seconds(1), 11), kUnack);  // anew
  bench.alarm.acknowledge();
  EXPECT_EQ(bench.run(seconds(1), 0), kLatched);
  EXPECT_TRUE(bench.alarm.reset());
  EXPECT_EQ(bench.alarm.state(), kNormal);
}

TEST(Alarm, ShelfThatIsOverIsUnseenByHandIsSeen) {
  Bench bench;
  bench.run(seconds(1), 11);
  ASSERT_TRUE(bench.alarm.acknowledge());
  ASSERT_TRUE(bench.alarm.shelve(bench.now + seconds(60)));
  EXPECT_EQ(bench.run(seconds(59)), kShelved);
  EXPECT_FALSE(bench.alarm.acknowledge());
  EXPECT_EQ(bench.run(seconds(2)), kUnack);  // though it was acknowledged before
  ASSERT_TRUE(bench.alarm.shelve(bench.now + seconds(60)));
  ASSERT_TRUE(bench.alarm.unshelve());
  EXPECT_EQ(bench.alarm.state(), kAcked);
}

TEST(Alarm, ComesAndGoesOnTheShelf) {
  Bench bench;
  bench.run(seconds(1), 11);
  bench.alarm.acknowledge();
  bench.alarm.shelve(bench.now + seconds(60));
  bench.run(seconds(5), 0);
  bench.run(seconds(5), 11);
  bench.run(seconds(30), 0);
  EXPECT_EQ(bench.alarm.state(), kShelved);
  EXPECT_EQ(bench.run(seconds(30)), kReturnedUnack);  // nobody has seen the second
}

TEST(Alarm, AStaleValueChangesNothing) {
  Bench bench;
  bench.usable = false;
  EXPECT_EQ(bench.run(seconds(10), 11), kNormal);
  bench.usable = true;
  bench.run(seconds(1));
  bench.usable = false;
  EXPECT_EQ(bench.run(seconds(10), 0), kUnack);
  bench.usable = true;
  EXPECT_EQ(bench.run(milliseconds(510)), kReturnedUnack);
}

TEST(Alarm, SuppressionHidesAndGivesBack) {
  Bench bench;
  bench.suppressed = true;
  EXPECT_EQ(bench.run(seconds(10), 11), kNormal);
  bench.suppressed = false;
  EXPECT_EQ(bench.run(milliseconds(100)), kNormal);  // its delay begins now
  EXPECT_EQ(bench.run(milliseconds(20)), kUnack);
  bench.suppressed = true;
  EXPECT_EQ(bench.run(seconds(1), 0), kSuppressed);
  EXPECT_FALSE(bench.alarm.acknowledge());  // not what the operator sees
  bench.suppressed = false;
  EXPECT_EQ(bench.run(seconds(1)), kReturnedUnack);
}

TEST(Alarm, ADelayThatRanWhenSuppressionBeganDoesNotRunThroughIt) {
  for (const bool by_suppression : {true, false}) {
    Bench bench;
    EXPECT_EQ(bench.run(milliseconds(50), 11), kNormal);  // half of its on-delay
    (by_suppression ? bench.suppressed : bench.usable) = by_suppression;
    EXPECT_EQ(bench.run(seconds(10)), kNormal);
    bench.suppressed = false;
    bench.usable = true;
    EXPECT_EQ(bench.run(milliseconds(100)), kNormal) << "its delay begins anew";
    EXPECT_EQ(bench.run(milliseconds(20)), kUnack);
  }
}

TEST(Alarm, ChatterIsFoldedAndCounted) {
  Bench bench;
  bench.row.off_delay = {};
  for (int i = 0; i < 20; ++i) {
    bench.run(milliseconds(500), 11);
    bench.run(milliseconds(500), 0);
  }
  EXPECT_EQ(bench.announced, 3);
  EXPECT_TRUE(bench.alarm.folded());
  EXPECT_EQ(bench.alarm.count(), 20U);
  EXPECT_EQ(bench.alarm.state(), kUnack);
  EXPECT_EQ(bench.run(seconds(9)), kUnack);
  EXPECT_EQ(bench.run(seconds(2)), kReturnedUnack);
  EXPECT_FALSE(bench.alarm.folded());
}

TEST(Alarm, SlowComingsAreNoChatter) {
  Bench bench;
  bench.row.off_delay = {};
  for (int i = 0; i < 10; ++i) {
    bench.run(seconds(3), 11);
    bench.run(seconds(3), 0);
    EXPECT_FALSE(bench.alarm.folded());
  }
  EXPECT_EQ(bench.announced, 10);
}

TEST(Alarm, ABoundBelowIsTheMirrorImage) {
  Bench bench;
  bench.row.side = Side::kBelow;
  EXPECT_EQ(bench.run(seconds(5), 10.0), kNormal);  // at the limit: not below it
  EXPECT_EQ(bench.run(seconds(1), 9.9), kUnack);
  EXPECT_EQ(bench.run(seconds(5), 11.9), kUnack);
  EXPECT_EQ(bench.run(seconds(1), 12.1), kReturnedUnack);
}

TEST(Alarm, TheDeadbandHoldsAnAlarmAndMakesNone) {
  Bench bench;
  bench.row.on_delay = bench.row.off_delay = {};
  EXPECT_EQ(bench.run(seconds(1), 9.0), kNormal);
  EXPECT_EQ(bench.run(seconds(1), 11.0), kUnack);
  EXPECT_EQ(bench.run(seconds(1), 9.0), kUnack);
  EXPECT_EQ(bench.announced, 1);
}

TEST(Alarm, TellsSinceWhenItIsAndItsNewestValue) {
  Bench bench;
  bench.run(milliseconds(100), 11);
  EXPECT_EQ(bench.run(milliseconds(10), 12), kUnack);
  const Instant came = bench.now;
  bench.run(seconds(1), 13);
  EXPECT_EQ(bench.alarm.since(), came);
  EXPECT_EQ(bench.alarm.value(), 13.0);
  bench.usable = false;
  bench.run(seconds(1), 14);
  EXPECT_EQ(bench.alarm.value(), 13.0);
}

// However it becomes normal, its comings are counted from there.
TEST(Alarm, ComingsAreCountedSinceItWasNormal) {
  const auto count_after = [](auto&& back_to_normal, bool latched) {
    Bench bench;
    bench.row.latched = latched;
    bench.run(seconds(1), 11);
    EXPECT_EQ(bench.alarm.count(), 1U);
    bench.run(milliseconds(100), 0);  // shorter than its off-delay: the same coming
    bench.run(seconds(1), 11);
    EXPECT_EQ(bench.alarm.count(), 1U);
    bench.run(seconds(1), 0);
    bench.run(seconds(1), 11);
    EXPECT_EQ(bench.alarm.count(), 2U);
    back_to_normal(bench);
    EXPECT_EQ(bench.alarm.state(), kNormal);
    EXPECT_EQ(bench.alarm.count(), 0U);
    bench.run(seconds(1), 11);
    return bench.alarm.count();
  };
  const auto seen_then_gone = [](Bench& b) { b.alarm.acknowledge(), b.run(seconds(1), 0); };
  const auto gone_then_seen = [](Bench& b) { b.run(seconds(1), 0), b.alarm.acknowledge(); };
  const auto by_hand_off_the_shelf = [](Bench& b) {
    b.alarm.shelve(b.now + seconds(60)), b.run(seconds(1), 0), b.alarm.unshelve();
  };
  const auto by_reset = [](Bench& b) {
    b.run(seconds(1), 0), b.alarm.acknowledge();
    EXPECT_EQ(b.alarm.count(), 2U) << "latched is not normal";
    b.alarm.reset();
  };
  EXPECT_EQ(count_after(seen_then_gone, false), 1U);
  EXPECT_EQ(count_after(gone_then_seen, false), 1U);
  EXPECT_EQ(count_after(by_hand_off_the_shelf, false), 1U);
  EXPECT_EQ(count_after(by_reset, true), 1U);
}

TEST(Alarm, AShelfEndsAtItsTimeAndOnlyAShelvedOneIsTakenDown) {
  Bench bench;
  EXPECT_FALSE(bench.alarm.unshelve());
  bench.run(seconds(1), 11);
  EXPECT_FALSE(bench.alarm.unshelve());
  EXPECT_EQ(bench.alarm.state(), kUnack) << "what is not on the shelf is not seen by it";
  ASSERT_TRUE(bench.alarm.shelve(bench.now + seconds(60)));
  EXPECT_EQ(bench.run(seconds(60) - milliseconds(10)), kShelved);
  EXPECT_EQ(bench.run(milliseconds(10)), kUnack);
}

TEST(Alarm, ThreeComingsWithinTheWindowAreChatter) {
  Bench bench;
  bench.row.off_delay = {};
  for (int i = 0; i < 3; ++i) {  // the third ten seconds after the first
    EXPECT_FALSE(bench.alarm.folded());
    bench.run(milliseconds(2'500), 11);
    if (i < 2) bench.run(milliseconds(2'500), 0);
  }
  EXPECT_TRUE(bench.alarm.folded());
}

TEST(Alarm, EveryStateHasItsName) {
  const std::string_view names[]{"normal",  "unack",   "acked",     "rtn_unack",
                                 "latched", "shelved", "suppressed"};
  for (std::size_t i = 0; i < std::size(names); ++i)
    EXPECT_EQ(text_of(static_cast<State>(i)), names[i]);
}

// Any order of values, acts, situations and silences: what nobody has seen is never lost, and each
// state is one that the diagram has.
TEST(Alarm, NoPathLosesWhatNobodyHasSeen) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random{seed};
    const auto draw = [&](int below) {
      return static_cast<int>(random() % static_cast<unsigned>(below));
    };
    Bench bench;
    bench.row.latched = draw(2) == 0;
    bench.row.on_delay = milliseconds(50 * draw(4));
    bench.row.off_delay = milliseconds(200 * draw(4));
    bool outstanding = false;  // came, and nobody has acknowledged it or unshelved it by hand
    for (int i = 0; i < 400; ++i) {
      const int announced_before = bench.announced;
      const State before = bench.alarm.state();
      switch (draw(8)) {
        case 0:
          if (bench.alarm.acknowledge()) outstanding = false;
          break;
        case 1:
          if (bench.alarm.shelve(bench.now + milliseconds(100 * (1 + draw(50))))) {
            EXPECT_NE(before, kNormal);
          }
          break;
        case 2:
          if (bench.alarm.unshelve()) outstanding = false;
          break;
        case 3:
          EXPECT_EQ(bench.alarm.reset(), before == kLatched);
          break;
        case 4:
          bench.suppressed = !bench.suppressed;
          break;
        case 5:
          bench.usable = !bench.usable;
          break;
        default:
          bench.value = draw(16);
      }
      bench.run(milliseconds(10 * (1 + draw(60))));
      outstanding = outstanding || bench.announced > announced_before;
      const State after = bench.alarm.state();
      ASSERT_TRUE(!outstanding || bench.alarm.unacknowledged()) << "seed " << seed << " act " << i;
      if (outstanding) {
        ASSERT_TRUE(after == kUnack || after == kReturnedUnack || after == kShelved ||
                    after == kSuppressed)
            << "seed " << seed << " act " << i;
      }
      ASSERT_TRUE(after != kLatched || bench.row.latched);
    }
  }
}

}  // namespace
}  // namespace pitwall::alarms
