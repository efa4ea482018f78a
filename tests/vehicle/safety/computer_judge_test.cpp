// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/computer_judge.hpp"

#include <gtest/gtest.h>

namespace pitwall::safety {
namespace {

struct Computer {
  ComputerParams params;
  ComputerState state;
  world::ComputerHealth health;
  Instant now = Instant{} + seconds(1);

  ComputerVerdict after(Duration gap) {
    now += gap;
    return judge_computer(params, state, health, now);
  }
};

TEST(ComputerJudge, AGapOfMoreThanTwoTicksIsMissed) {
  Computer c;
  EXPECT_FALSE(c.after({}).missed) << "the first tick follows none";
  for (const std::int64_t us : {100, 10'000, 20'000, 25'000})
    EXPECT_FALSE(c.after(microseconds(us)).missed) << us;
  EXPECT_TRUE(c.after(milliseconds(25) + nanoseconds(1)).missed);
  EXPECT_FALSE(c.after(milliseconds(10)).missed);
}

TEST(ComputerJudge, OneSleepIsForgivenWhateverItsLengthUpToASecond) {
  for (const std::int64_t ms : {50, 200, 500, 1000}) {
    Computer c;
    c.after({});
    const ComputerVerdict v = c.after(milliseconds(ms));
    EXPECT_TRUE(v.missed);
    EXPECT_EQ(v.gap, milliseconds(ms));
    EXPECT_FALSE(v.late) << ms;
  }
  Computer c;
  c.after({});
  EXPECT_TRUE(c.after(milliseconds(1001)).late);
}

TEST(ComputerJudge, WhoRunsLessThanHalfOfTheTimeIsLateInTheEnd) {
  for (const std::int64_t asleep_ms : {30, 40, 49, 51, 60, 80}) {
    Computer c;
    c.after({});
    bool late = false;
    for (int period = 0; period < 600; ++period) {  // a minute
      late = c.after(milliseconds(asleep_ms)).late || late;
      for (std::int64_t left = 100 - asleep_ms; left > 0; left -= 10)
        late = c.after(milliseconds(std::min<std::int64_t>(left, 10))).late || late;
    }
    EXPECT_EQ(late, asleep_ms > 50) << asleep_ms;
  }
}

TEST(ComputerJudge, WhatTheRimKnowsIsJudgedAtItsLimitAndWhatItDoesNotIsNot) {
  Computer c;
  const ComputerVerdict unknown = c.after(milliseconds(10));
  EXPECT_FALSE(unknown.busy || unknown.full || unknown.hot);
  c.health = {c.params.processor_warn, c.params.memory_max_mib, c.params.temperature_max_c};
  const ComputerVerdict at = c.after(milliseconds(10));
  EXPECT_FALSE(at.busy || at.full || at.hot);
  c.health = {1.0, c.params.memory_max_mib + 1.0, c.params.temperature_max_c + 0.1};
  const ComputerVerdict above = c.after(milliseconds(10));
  EXPECT_TRUE(above.busy && above.full && above.hot);
}

}  // namespace
}  // namespace pitwall::safety
