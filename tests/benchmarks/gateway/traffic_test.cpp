// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/gateway/traffic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "protocol/can/av21.hpp"
#include "protocol/can/message_monitor.hpp"

namespace pitwall::load {
namespace {

// All batches: for each identifier the times at which it is sent.
std::map<std::uint32_t, std::vector<Duration>> times_of(Traffic& traffic,
                                                        std::vector<can::Frame>* all = nullptr) {
  std::map<std::uint32_t, std::vector<Duration>> times;
  std::vector<can::Frame> frames;
  for (Duration at{}; at < traffic.length(); at = at + kBatch) {
    frames.clear();
    traffic.frames_due(at, frames);
    for (const can::Frame& frame : frames) times[frame.id].push_back(at);
    if (all) all->insert(all->end(), frames.begin(), frames.end());
  }
  return times;
}

TEST(Traffic, IsThreeSaturatedBusesOfWhichOneIsTheCars) {
  for (const std::int64_t length_s : {5, 20}) {
    Traffic traffic{{.length = seconds(length_s)}};
    EXPECT_GE(traffic.sent(), 27'000u * static_cast<std::uint64_t>(length_s));
    EXPECT_LE(traffic.sent(), 28'000u * static_cast<std::uint64_t>(length_s));
    std::uint64_t sent = 0, of_car = 0;
    for (const auto& [id, times] : times_of(traffic)) {
      sent += times.size();
      const auto stream = traffic.stream_of(id);
      ASSERT_TRUE(stream) << id;
      EXPECT_EQ(traffic.sent(*stream), times.size()) << id;
      if (traffic.streams()[*stream].of_car) of_car += times.size();
    }
    EXPECT_EQ(sent, traffic.sent());
    EXPECT_EQ(of_car, traffic.sent_of_car());
  }
}

TEST(Traffic, IsOneSaturatedBusWhereTheForeignPeriodIsThreeTimesAsLong) {
  const Traffic traffic{{.length = seconds(5), .foreign_period = milliseconds(30)}};
  EXPECT_GE(traffic.sent(), 5 * 9'000u);
  EXPECT_LE(traffic.sent(), 5 * 10'000u);
  EXPECT_EQ(traffic.sent_of_car(), Traffic{{.length = seconds(5)}}.sent_of_car());
}

TEST(Traffic, HoldsEveryMessageOfTheCarAndNoIdentifierOfItsComputer) {
  const Traffic traffic{{.length = seconds(5)}};
  for (const can::MessageRow& row : can::av21::kMessages) {
    const auto stream = traffic.stream_of(row.id);
    if (row.direction == can::Direction::kToCar) {
      EXPECT_FALSE(stream) << row.name;
    } else {
      ASSERT_TRUE(stream) << row.name;
      EXPECT_TRUE(traffic.streams()[*stream].of_car);
      EXPECT_EQ(traffic.streams()[*stream].row.period, row.period);
    }
  }
}

TEST(Traffic, EveryMessageKeepsItsPeriodButWhereOneWasLeftOut) {
  Traffic traffic{{.length = seconds(20), .omissions = 300, .seed = 5}};
  ASSERT_EQ(traffic.omissions().size(), 300u);
  std::map<std::uint32_t, std::set<std::int64_t>> gaps;
  for (const Omission& omission : traffic.omissions())
    gaps[traffic.streams()[omission.stream].row.id].insert(omission.due.ns);
  for (const auto& [id, times] : times_of(traffic)) {
    const Duration period = traffic.streams()[*traffic.stream_of(id)].row.period;
    for (std::size_t i = 1; i < times.size(); ++i) {
      const bool left_out = gaps[id].contains((times[i - 1] + period).ns);
      EXPECT_EQ(times[i] - times[i - 1], left_out ? 2 * period : period) << id;
    }
  }
}

TEST(Traffic, TheLastFrameOfTheRunIsLeftOutAndTheLastOfTwoMessagesOfTheCar) {
  const Traffic traffic{{.length = seconds(5), .omissions = 3}};
  Duration last{};
  for (std::size_t i = 0; i < traffic.streams().size(); ++i)
    last = std::max(last, traffic.last_due(i));
  bool of_run = false, counted = false, plain = false;
  for (const Omission& omission : traffic.omissions()) {
    const Stream& stream = traffic.streams()[omission.stream];
    EXPECT_EQ(omission.due, traffic.last_due(omission.stream));
    of_run |= omission.due == last;
    counted |= stream.of_car && stream.row.has_counter;
    plain |= stream.of_car && !stream.row.has_counter;
  }
  EXPECT_TRUE(of_run && counted && plain);
}

TEST(Traffic, TheSameNumbersGiveTheSameFrames) {
  const TrafficPlan plan{.length = seconds(5), .omissions = 100, .seed = 9};
  Traffic a{plan}, b{plan};
  std::vector<can::Frame> of_a, of_b;
  times_of(a, &of_a);
  times_of(b, &of_b);
  EXPECT_EQ(of_a, of_b);
  TrafficPlan other = plan;
  other.seed = 10;
  Traffic c{other};
  std::vector<can::Frame> of_c;
  times_of(c, &of_c);
  EXPECT_NE(of_a, of_c);
}

TEST(Traffic, RunningNumbersHaveNoGap) {
  Traffic traffic{{.length = seconds(5), .omissions = 200}};
  std::vector<can::Frame> frames;
  times_of(traffic, &frames);
  std::uint32_t next = 0;
  for (const can::Frame& frame : frames) {
    if (is_numbered(frame.id)) {
      ASSERT_EQ(number_of(frame), next++);
    }
  }
  EXPECT_GT(next, 25'000u * 5);
}

// The counters are those of a sender whose frames were lost on their way.
TEST(Traffic, ItsCountersTellOfEveryOmissionToTheMonitor) {
  Traffic traffic{{.length = seconds(10), .omissions = 200}};
  std::vector<can::MessageMonitor> monitors(traffic.streams().size());
  can::LossLog log;
  std::size_t reported = 0;
  std::vector<can::Frame> frames;
  for (Duration at{}; at < traffic.length(); at = at + kBatch) {
    frames.clear();
    traffic.frames_due(at, frames);
    for (const can::Frame& frame : frames) {
      const std::size_t i = *traffic.stream_of(frame.id);
      EXPECT_EQ(can::judge(traffic.streams()[i].row, {}, monitors[i], {frame, Instant{} + at}, log),
                can::FrameVerdict::kGood);
    }
    reported += log.count;
    log.clear();
  }
  const auto followed =
      std::count_if(traffic.omissions().begin(), traffic.omissions().end(),
                    [&](const Omission& o) { return o.due < traffic.last_due(o.stream); });
  EXPECT_GT(followed, 150);
  EXPECT_EQ(reported, static_cast<std::size_t>(followed));
}

}  // namespace
}  // namespace pitwall::load
