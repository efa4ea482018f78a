// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/gateway/loss_judge.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace pitwall::load {
namespace {

constexpr Instant kStart{5'000'000'000};

// A perfect bus and a perfect receiver; tests then spoil one of them.
struct PerfectRun {
  Traffic traffic{{.length = seconds(5), .omissions = 60, .seed = 2}};
  Arrivals arrivals = Arrivals(traffic.streams().size());
  std::vector<Instant> omitted_at;
  std::vector<can::LossReport> reports;

  PerfectRun() {
    std::vector<can::Frame> frames;
    for (Duration at{}; at < traffic.length(); at = at + kBatch) {
      frames.clear();
      traffic.frames_due(at, frames);
      for (const can::Frame& frame : frames)
        arrivals[*traffic.stream_of(frame.id)].push_back(kStart + at);
    }
    for (const Omission& omission : traffic.omissions()) {
      omitted_at.push_back(kStart + omission.due);
      reports.push_back({.id = traffic.streams()[omission.stream].row.id,
                         .frames = 1,
                         .due = kStart + omission.due,
                         .noticed = kStart + omission.due + milliseconds(90)});
    }
  }
  LossJudgement judged(bool of_car_only = false) const {
    return judge_losses(traffic, {.omitted_at = omitted_at,
                                  .reports = reports,
                                  .arrivals = arrivals,
                                  .of_car_only = of_car_only});
  }
  // A message that was never left out.
  std::size_t whole_stream() const {
    for (std::size_t i = 0; i < traffic.streams().size(); ++i) {
      const auto& omissions = traffic.omissions();
      if (std::none_of(omissions.begin(), omissions.end(),
                       [i](const Omission& o) { return o.stream == i; }))
        return i;
    }
    return 0;
  }
};

TEST(LossJudge, AllReportedInTimeHolds) {
  const LossJudgement judged = PerfectRun{}.judged();
  EXPECT_EQ(judged.omitted, 60u);
  EXPECT_EQ(judged.reported, 60u);
  EXPECT_EQ(judged.in_time, 60u);
  EXPECT_EQ(judged.missed + judged.twice + judged.false_reports + judged.late_on_bus, 0u);
  EXPECT_EQ(judged.worst, milliseconds(90));
  EXPECT_TRUE(judged.errors.empty());
}

TEST(LossJudge, EachReportThatIsMissingIsMissed) {
  for (std::size_t gone = 0; gone < 60; ++gone) {
    PerfectRun run;
    run.reports.erase(run.reports.begin() + static_cast<std::ptrdiff_t>(gone));
    const LossJudgement judged = run.judged();
    EXPECT_EQ(judged.missed, 1u) << gone;
    EXPECT_EQ(judged.reported, 59u);
  }
}

// Each omission once: the frame before it comes later and later until the gap around it is one that
// frames without a loss may have. A counter tells the loss all the same.
TEST(LossJudge, AnOmissionThatNoGapBetraysIsHiddenUnlessACounterTells) {
  std::size_t hidden = 0, announced = 0;
  for (std::size_t gone = 0; gone < 60; ++gone) {
    PerfectRun run;
    const std::size_t stream = run.traffic.omissions()[gone].stream;
    const can::MessageRow& row = run.traffic.streams()[stream].row;
    std::vector<Instant>& arrived = run.arrivals[stream];
    const auto next = std::lower_bound(arrived.begin(), arrived.end(), run.omitted_at[gone]);
    if (next == arrived.begin() || next == arrived.end()) continue;
    run.reports.erase(run.reports.begin() + static_cast<std::ptrdiff_t>(gone));
    const Instant latest = *next - row.period - can::tolerance_of(row);
    *(next - 1) = latest - milliseconds(1);
    EXPECT_EQ(run.judged().missed, 1u) << gone;
    *(next - 1) = latest;
    const LossJudgement judged = run.judged();
    EXPECT_EQ(judged.missed, row.has_counter ? 1u : 0u) << gone;
    EXPECT_EQ(judged.hidden, row.has_counter ? 0u : 1u) << gone;
    EXPECT_EQ(judged.omitted + judged.hidden, 60u);
    ++(row.has_counter ? announced : hidden);
  }
  EXPECT_GT(hidden, 10u);
  EXPECT_GT(announced, 10u);
}

TEST(LossJudge, ASecondReportOfTheSameFrameIsTwice) {
  for (std::size_t again = 0; again < 60; ++again) {
    PerfectRun run;
    run.reports.push_back(run.reports[again]);
    EXPECT_EQ(run.judged().twice, 1u) << again;
  }
}

TEST(LossJudge, AReportOfAFrameThatCameIsFalseAndOfOneThatCameLateIsNot) {
  PerfectRun run;
  const std::size_t stream = run.whole_stream();
  const can::MessageRow& row = run.traffic.streams()[stream].row;
  std::vector<Instant>& arrived = run.arrivals[stream];
  ASSERT_GT(arrived.size(), 4u);
  run.reports.push_back({.id = row.id, .frames = 1, .due = arrived[2], .noticed = arrived[3]});
  EXPECT_EQ(run.judged().false_reports, 1u);
  EXPECT_EQ(run.judged().errors.size(), 1u);
  arrived[2] += can::tolerance_of(row) + milliseconds(1);
  EXPECT_EQ(run.judged().false_reports, 0u);
  EXPECT_EQ(run.judged().late_on_bus, 1u);
}

TEST(LossJudge, BeyondTheLimitIsReportedButNotInTime) {
  PerfectRun run;
  run.reports[7].noticed = run.omitted_at[7] + kReportLimit + nanoseconds(1);
  const LossJudgement judged = run.judged();
  EXPECT_EQ(judged.reported, 60u);
  EXPECT_EQ(judged.in_time, 59u);
  EXPECT_EQ(judged.worst, kReportLimit + nanoseconds(1));
}

TEST(LossJudge, SilenceAfterTheEndIsNoFalseReport) {
  PerfectRun run;
  for (std::size_t i = 0; i < run.traffic.streams().size(); ++i) {
    const can::MessageRow& row = run.traffic.streams()[i].row;
    const Instant due = kStart + run.traffic.last_due(i) + row.period;
    run.reports.push_back({.id = row.id, .frames = 2, .due = due, .noticed = due + row.period});
  }
  const LossJudgement judged = run.judged();
  EXPECT_EQ(judged.after_end, run.traffic.streams().size());
  EXPECT_EQ(judged.twice + judged.false_reports, 0u);
}

TEST(LossJudge, TheCarIsJudgedByItsOwnMessagesOnly) {
  PerfectRun run;
  std::erase_if(run.reports, [&run](const can::LossReport& report) {
    return !run.traffic.streams()[*run.traffic.stream_of(report.id)].of_car;
  });
  const LossJudgement judged = run.judged(true);
  EXPECT_EQ(judged.omitted, run.reports.size());
  EXPECT_EQ(judged.reported, run.reports.size());
  EXPECT_GT(judged.omitted, 10u);
  run.reports.push_back({.id = kNumberedId, .frames = 1});
  run.reports.push_back({.id = 0x7FF, .frames = 1});
  EXPECT_EQ(run.judged(true).false_reports, 2u);
}

}  // namespace
}  // namespace pitwall::load
