// Which frames never came: what the gateway says of every message and of every loss.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "protocol/can/signal.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/tick.hpp"
#include "tests/vehicle/gateway/traffic.hpp"
#include "vehicle/gateway/inbound.hpp"

namespace pitwall::gateway {
namespace {

using namespace testing;
using can::MessageRow;
using can::ReceivedFrame;
using world::LossDetector;
using world::LossReport;

constexpr Duration kLimit = milliseconds(100);

// Every message of the car in its period on a 1 ms grid, each delayed as on a real bus.
class CarBus {
 public:
  explicit CarBus(std::uint64_t seed) : random_{seed} {}

  // (id, index) of frames that never arrive.
  std::map<std::pair<std::uint32_t, std::int64_t>, Instant> left_out;

  std::vector<ReceivedFrame> frames(Instant from, Instant until) {
    std::vector<ReceivedFrame> out;
    for (Instant at = from; at < until; at += milliseconds(1))
      for (std::size_t i = 0; i < av21::kMessages.size(); ++i)
        if (av21::kMessages[i].direction == can::Direction::kFromCar) send(i, at, out);
    std::sort(out.begin(), out.end(),
              [](const ReceivedFrame& a, const ReceivedFrame& b) { return a.at < b.at; });
    return out;
  }

 private:
  void send(std::size_t i, Instant at, std::vector<ReceivedFrame>& out) {
    const MessageRow& row = av21::kMessages[i];
    const Duration phase =
        milliseconds(static_cast<std::int64_t>(i) % (row.period / milliseconds(1)));
    const Duration since = at - Instant{} - phase;
    if (since < Duration{} || since.ns % row.period.ns != 0) return;
    const std::int64_t index = since / row.period;
    if (left_out.contains({row.id, index})) {
      left_out[{row.id, index}] = at;
      return;
    }
    can::Frame frame = empty_frame(row);
    if (row.id >= av21::TireTempFl1::kId && row.id <= av21::TireTempRr4::kId)
      std::fill_n(frame.data.begin(), row.length, std::uint8_t{5});  // 28.5 degrees
    if (row.has_counter) {
      const auto counter = static_cast<std::uint64_t>(index) & can::mask_of(row.counter_bits);
      can::store_intel(frame.data, can::load_intel(frame.data) | counter << row.counter_start);
    }
    out.push_back({frame, at + microseconds(static_cast<std::int64_t>(random_.below(900)))});
  }

  Random random_;
};

struct Received {
  std::vector<LossReport> reports;
  InboundOutput last;
  InboundState state;
};

Received listen(CarBus& bus, Duration length, Instant silent_from = {INT64_MAX}) {
  Received received;
  const InboundParams params;
  for (Instant now = Instant{} + kTick; now - Instant{} <= length; now += kTick) {
    const auto frames =
        now > silent_from ? std::vector<ReceivedFrame>{} : bus.frames(now - kTick, now);
    received.last = decode(params, received.state, frames, now);
    received.reports.insert(received.reports.end(), received.last.bus.losses.begin(),
                            received.last.bus.losses.end());
  }
  return received;
}

TEST(Losses, NoneOnAHealthyBus) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    CarBus bus{seed};
    const Received received = listen(bus, seconds(20));
    EXPECT_TRUE(received.reports.empty()) << "seed " << seed << " id " << received.reports[0].id;
    EXPECT_EQ(received.last.bus.frames_lost, 0u);
    EXPECT_EQ(received.last.bus.refused.total(), 0u);
  }
}

TEST(Losses, EveryRowTellsHowItsMessageIs) {
  CarBus bus{1};
  const Received received = listen(bus, seconds(20));
  std::size_t rows = 0;
  for (const MessageRow& row : av21::kMessages) {
    if (row.direction != can::Direction::kFromCar) continue;
    const auto found =
        std::find_if(received.last.bus.messages.begin(), received.last.bus.messages.end(),
                     [&row](const world::MessageHealth& health) { return health.id == row.id; });
    ASSERT_NE(found, received.last.bus.messages.end()) << row.name;
    EXPECT_EQ(found->liveness, world::Liveness::kAlive) << row.name;
    EXPECT_EQ(found->debt, 0) << row.name;
    EXPECT_EQ(found->lost + found->bad, 0u) << row.name;
    EXPECT_NEAR(found->mean_interval.seconds(), row.period.seconds(), 1e-3) << row.name;
    EXPECT_LE(Instant{} + seconds(20) - found->last, row.period + milliseconds(1)) << row.name;
    ++rows;
  }
  EXPECT_EQ(received.last.bus.messages.size(), rows);
}

TEST(Losses, EachSingleLossIsReportedOnceWithItsIdInTime) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CarBus bus{seed};
    Random random{seed};
    for (const MessageRow& row : av21::kMessages) {
      if (row.direction != can::Direction::kFromCar) continue;
      const std::int64_t count = seconds(20) / row.period;
      for (std::int64_t at = 3; at + 3 < count; at += 4 + count / 10)
        bus.left_out[{row.id, at + static_cast<std::int64_t>(random.below(3))}] = {};
    }
    const Received received = listen(bus, seconds(20));
    EXPECT_EQ(received.reports.size(), bus.left_out.size());
    EXPECT_EQ(received.last.bus.frames_lost, bus.left_out.size());
    for (const auto& [key, due] : bus.left_out) {
      const auto fits = [&, id = key.first, sent = due](const LossReport& r) {
        return r.id == id && r.frames == 1 && r.due - sent < milliseconds(2) &&
               sent - r.due < milliseconds(2) && r.noticed - sent <= kLimit;
      };
      EXPECT_EQ(std::count_if(received.reports.begin(), received.reports.end(), fits), 1)
          << "seed " << seed << " id " << key.first << " index " << key.second;
    }
  }
}

TEST(Losses, TheLastFrameOfAllIsReportedThoughNothingFollows) {
  CarBus bus{1};
  const Instant silent = Instant{} + seconds(5);
  const Received received = listen(bus, seconds(6), silent);
  for (const MessageRow& row : av21::kMessages) {
    if (row.direction != can::Direction::kFromCar) continue;
    const auto first =
        std::find_if(received.reports.begin(), received.reports.end(),
                     [&row](const LossReport& report) { return report.id == row.id; });
    if (row.period + can::tolerance_of(row) > seconds(1) - row.period)
      continue;  // not due by the end
    ASSERT_NE(first, received.reports.end()) << row.name;
    EXPECT_EQ(first->detector, LossDetector::kPeriod) << row.name;
    EXPECT_GE(first->due, silent) << row.name;
    EXPECT_LE(first->noticed - first->due, kLimit) << row.name;
  }
}

TEST(Losses, ARaceControlHeartbeatThatStandsStillOrJumpsIsNeverRefused) {
  Random random{3};
  const InboundParams params;
  InboundState state;
  InboundOutput out;
  for (std::int64_t i = 0; i < 400; ++i) {
    const auto beat = static_cast<std::uint8_t>(i % 3 == 0 ? 5 : random.below(16));
    const ReceivedFrame frame{summary({.heartbeat = beat, .track = 1}), at_ms(500 * i)};
    out = decode(params, state, {&frame, 1}, at_ms(500 * i));
  }
  EXPECT_EQ(out.bus.refused.total(), 0u);
  EXPECT_EQ(out.bus.frames_applied, 400u);
  EXPECT_EQ(out.bus.frames_lost, 0u);
}

TEST(Losses, WhatTheInterfaceLosesIsReportedWhenItRises) {
  const InboundParams params;
  InboundState state;
  world::LinkObservation link;
  std::uint64_t socket = 0, interface = 0;
  for (std::int64_t tick = 0; tick < 50; ++tick) {
    if (tick % 7 == 3) link.lost_in_socket += static_cast<std::uint64_t>(tick);
    if (tick % 5 == 2) link.lost_in_interface += 2;
    InboundOutput out = decode(params, state, {}, at_ms(10 * tick));
    observe_link(state, out.bus, link, at_ms(10 * tick));
    EXPECT_EQ(out.bus.link.lost_in_socket, link.lost_in_socket);
    EXPECT_EQ(out.bus.losses.size(), (tick % 7 == 3 ? 1u : 0u) + (tick % 5 == 2 ? 1u : 0u)) << tick;
    for (const LossReport& report : out.bus.losses) {
      EXPECT_EQ(report.id, 0u);
      EXPECT_EQ(report.noticed, at_ms(10 * tick));
      const bool in_socket = report.detector == LossDetector::kSocketQueue;
      EXPECT_TRUE(in_socket || report.detector == LossDetector::kInterface);
      (in_socket ? socket : interface) += report.frames;
    }
  }
  EXPECT_EQ(socket, link.lost_in_socket);
  EXPECT_EQ(interface, link.lost_in_interface);
}

TEST(Losses, WhatDoesNotFitTheListOfATickIsCounted) {
  CarBus bus{1};
  const InboundParams params;
  InboundState state;
  const auto frames = bus.frames(Instant{}, Instant{} + seconds(3));
  decode(params, state, frames, Instant{} + seconds(3));
  // A fast message comes back again and again after short silences, all in one tick.
  std::vector<ReceivedFrame> gaps;
  for (std::int64_t i = 0; i < 100; ++i) gaps.push_back({wheels(0.0), at_ms(3000 + 10 * i)});
  InboundOutput out;
  const std::size_t taken =
      ::pitwall::testing::allocations_of([&] { out = decode(params, state, gaps, at_ms(3990)); });
  if (::pitwall::testing::kAllocationsCounted) {
    EXPECT_EQ(taken, 0u);
  }
  EXPECT_TRUE(out.bus.losses.full());
  EXPECT_GE(out.bus.losses.size() + out.bus.losses_unlisted, 99u);
  const world::LinkObservation link{.lost_in_socket = 1};
  const std::uint64_t unlisted = out.bus.losses_unlisted;
  observe_link(state, out.bus, link, at_ms(3990));
  EXPECT_EQ(out.bus.losses_unlisted, unlisted + 1);
  EXPECT_EQ(decode(params, state, {}, at_ms(3991)).bus.losses_unlisted, unlisted + 1);
}

}  // namespace
}  // namespace pitwall::gateway
