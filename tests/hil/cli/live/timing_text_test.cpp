// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/live/timing_text.hpp"

#include <gtest/gtest.h>

namespace pitwall::cli {
namespace {

TEST(TimingText, SaysHowLateTheBenchWasAndWhatTheHostTook) {
  bench::LiveResult live;
  bench::RealTime& time = live.run.real_time.emplace();
  time.wake_late_p50_us = 12.0;
  time.caught_up_wakes = 34;
  time.behind_max = milliseconds(56);
  live.reports = 99;
  const std::string text = timing_text(live);
  EXPECT_NE(text.find("p50 12 us"), std::string::npos) << text;
  EXPECT_NE(text.find("34 wake-ups caught up, at most 56 ms behind; 99 reports"), std::string::npos)
      << text;
  EXPECT_TRUE(text.ends_with("\n"));
  EXPECT_TRUE(text.ends_with(reports_text(live))) << "for each car alone";

  EXPECT_EQ(stolen_text(time), "") << "nobody counted it";
  time.stolen_ms = 0.0;
  EXPECT_EQ(stolen_text(time), "");
  time.stolen_ms = 1230.0;
  EXPECT_NE(stolen_text(time).find("took 1230 ms"), std::string::npos);
}

TEST(TimingText, SaysForWhomBenchTimeStood) {
  bench::RealTime time;
  EXPECT_EQ(waits_text(time), "time by the wall clock\n");
  transport::ClockWaits& waits = time.waits.emplace();
  EXPECT_EQ(waits_text(time), "bench time stood 0 times for the machine, 0.00 s in all\n");
  waits.total = milliseconds(1'230);
  EXPECT_EQ(waits_text(time), "bench time, which another keeps, stood for 1.23 s\n");
  waits = {.count = 3,
           .total = milliseconds(2'500),
           .longest = milliseconds(740),
           .longest_at = Instant{} + milliseconds(8'120),
           .longest_for = "pitwall-vehicle"};
  EXPECT_EQ(waits_text(time),
            "bench time stood 3 times for the machine, 2.50 s in all, at the longest 740 ms at "
            "8.12 s for pitwall-vehicle\n");
  waits.longest_for.clear();
  EXPECT_NE(waits_text(time).find("for the bench\n"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::cli
