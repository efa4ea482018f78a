// SPDX-License-Identifier: Apache-2.0
#include "hil/report/tables.hpp"

#include <gtest/gtest.h>

#include "tests/hil/report/some_run.hpp"

namespace pitwall::report {
namespace {

TEST(Header, SaysThatItIsASimulation) {
  const std::string html = header(run_of({}));
  EXPECT_EQ(count(html, "SIMULATION"), 1u);
  for (const char* fact : {"some_run", "lockstep", ">7<", "10.0 s", "av21.dbc V14"})
    EXPECT_GE(count(html, fact), 1u) << fact;
  EXPECT_EQ(count(html, run_of({}).digest), 1u);
}

TEST(Banner, IsOneOfThree) {
  EXPECT_EQ(count(banner(run_of({})), "banner pass"), 1u);
  const std::string failed = banner(run_of({.with_failure = true}));
  EXPECT_EQ(count(failed, "banner fail"), 1u);
  EXPECT_EQ(count(failed, "1 of 2 expectations held"), 1u);
  const std::string cut = banner(run_of({.close = false}));
  EXPECT_EQ(count(cut, "banner infrastructure"), 1u);
  EXPECT_EQ(count(cut, "truncated"), 1u);
}

TEST(Banner, ShowsWhatTheResultRemarks) {
  RunData run = run_of({});
  run.result = ResultFigures{};
  run.result->refused_to_arm = "another bus";
  run.result->remarks = {"the log has a gap"};
  EXPECT_EQ(count(banner(run), "another bus"), 1u);
  EXPECT_EQ(count(banner(run), "the log has a gap"), 1u);
}

TEST(Verdicts, EachHasItsRow) {
  const std::string html = verdict_table(run_of({.with_failure = true}));
  EXPECT_EQ(count(html, "class=\"held\""), 1u);
  EXPECT_EQ(count(html, "class=\"broken\""), 1u);
  EXPECT_EQ(count(html, "<td>-0.75</td><td>6.50 s</td>"), 1u);
  EXPECT_EQ(count(verdict_table(RunData{}), "data-absent=\"verdicts\""), 1u);
}

TEST(Figures, WithoutAResultItSaysSo) {
  RunData run = run_of({});
  EXPECT_EQ(count(figures_table(run), "data-absent=\"result\""), 1u);
  add_result(run, result_of(run), "run.json");
  EXPECT_EQ(count(figures_table(run), "data-absent"), 0u);
  EXPECT_EQ(count(figures_table(run), "<dd>1001</dd>"), 1u);
}

TEST(Messages, HaveTheirTimingAndAHistogram) {
  const std::string html = message_table(run_of({}));
  EXPECT_EQ(count(html, "<svg class=\"small\""), 1u);
  EXPECT_EQ(count(html, "wheel_speed_report"), 1u);
  EXPECT_EQ(count(html, "not that of the run"), 1u) << "the log is of another database";
  EXPECT_EQ(count(message_table(run_of({.with_frames = false})), "data-absent"), 1u);
}

TEST(RealTime, IsForALiveRunThatMeasuredIt) {
  EXPECT_EQ(count(real_time_charts(run_of({})), "virtual"), 1u);
  RunData live = run_of({.mode = "live"});
  EXPECT_EQ(count(real_time_charts(live), "data-absent=\"wake\""), 1u);
  live.result = ResultFigures{};
  bench::RealTime& times = live.result->real_time.emplace();
  times.wake_late_p50_us = 61.0;
  times.wake_late = {5, 0, 900};
  const std::string html = real_time_charts(live);
  EXPECT_EQ(count(html, "data-plot=\"wake\""), 1u);
  EXPECT_EQ(count(html, "class=\"mark\""), 2u) << "two bins hold something";
  EXPECT_EQ(count(html, "61 us (p50)"), 1u);
  EXPECT_EQ(count(html, "The host"), 0u);
  EXPECT_EQ(count(html, "Time was that of the wall clock."), 1u);
  times.waits = {.count = 2,
                 .total = milliseconds(90),
                 .longest = milliseconds(70),
                 .longest_at = Instant{} + seconds(3),
                 .longest_for = "<car>"};
  EXPECT_EQ(count(real_time_charts(live),
                  "stood 2 times for the machine, 0.09 s in all, at the longest 70 ms at 3.00 s "
                  "for &lt;car&gt;."),
            1u);
  times.stolen_ms = 1230.0;
  EXPECT_EQ(count(real_time_charts(live), "took 1230 ms of its processors' time"), 1u);
}

TEST(Events, AreListedAndTheRestIsCounted) {
  RunData run = run_of({});
  EXPECT_EQ(count(event_table(run), "<td class=\"word\">green</td>"), 1u);
  run.events.resize(450, run.events.front());
  EXPECT_EQ(count(event_table(run), "<td class=\"word\">green</td>"), 400u);
  EXPECT_EQ(count(event_table(run), "50 more"), 1u);
  EXPECT_EQ(count(event_table(RunData{}), "data-absent=\"events\""), 1u);
}

TEST(Losses, AreListed) {
  EXPECT_EQ(count(loss_table(run_of({})), "<td>5.000</td><td>1300</td><td>2</td><td>4.900</td>"),
            1u);
  EXPECT_EQ(count(loss_table(RunData{}), "data-absent=\"losses\""), 1u);
}

}  // namespace
}  // namespace pitwall::report
