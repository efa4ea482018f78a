// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/radio_channel.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/instants.hpp"

namespace pitwall::bench {
namespace {

using faults::BenchFault;
using faults::BenchFaultKind;
using Bytes = std::vector<std::uint8_t>;

BenchFault fault(BenchFaultKind kind, std::int64_t from_ms, std::int64_t for_ms, double value = 0) {
  return {.kind = kind, .start = at_ms(from_ms), .duration = milliseconds(for_ms), .value = value};
}

// When each of a datagram per 10 ms arrives; by the number in its first byte.
struct Arrivals {
  std::vector<int> numbers;
  std::vector<std::int64_t> at_ms;
};

Arrivals send_for(RadioChannel& channel, Way way, std::int64_t for_ms, telemetry::PathId path = 0) {
  Arrivals out;
  for (std::int64_t ms = 0; ms < for_ms; ++ms) {
    if (ms % 10 == 0) {
      const Bytes bytes{static_cast<std::uint8_t>(ms / 10)};
      channel.offer(way, path, {bytes, bytes[0] + 1'000U}, at_ms(ms));
    }
    while (const auto datagram = channel.take(way, path, at_ms(ms))) {
      out.numbers.push_back(datagram->bytes.at(0));
      EXPECT_EQ(datagram->tag, datagram->bytes.at(0) + 1'000U);
      out.at_ms.push_back(ms);
    }
  }
  return out;
}

TEST(RadioChannel, WithoutARadioSectionTakesNoTimeAndLosesNothing) {
  RadioChannel channel({}, {}, 1);
  EXPECT_EQ(channel.paths(), 1);
  const Arrivals down = send_for(channel, Way::kDown, 1'000);
  ASSERT_EQ(down.numbers.size(), 100u);
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(down.numbers[static_cast<std::size_t>(i)], i);
    EXPECT_EQ(down.at_ms[static_cast<std::size_t>(i)], 10 * i);
  }
}

TEST(RadioChannel, DownPassesNothingEitherWayAndSilentNothingToTheCar) {
  for (const auto kind : {BenchFaultKind::kRadioDown, BenchFaultKind::kBaseStationSilent}) {
    RadioChannel channel({}, {fault(kind, 200, 300)}, 1);
    EXPECT_EQ(send_for(channel, Way::kUp, 1'000).numbers.size(), 70u);
    RadioChannel other({}, {fault(kind, 200, 300)}, 1);
    EXPECT_EQ(send_for(other, Way::kDown, 1'000).numbers.size(),
              kind == BenchFaultKind::kRadioDown ? 70u : 100u);
    EXPECT_EQ(channel.counters().switched_off[1], 30u);
  }
}

TEST(RadioChannel, ItsDelayIsAQueueThatKeepsTheOrder) {
  RadioChannel channel({}, {fault(BenchFaultKind::kRadioDelay, 200, 100, 0.4)}, 1);
  const Arrivals up = send_for(channel, Way::kUp, 2'000);
  ASSERT_EQ(up.numbers.size(), 200u);
  for (std::size_t i = 0; i < up.numbers.size(); ++i) {
    EXPECT_EQ(up.numbers[i], static_cast<int>(i));
    const auto sent_ms = static_cast<std::int64_t>(i) * 10;
    const bool delayed = sent_ms >= 200 && sent_ms < 300;
    EXPECT_GE(up.at_ms[i], sent_ms + (delayed ? 400 : 0));
    if (sent_ms < 200 || sent_ms >= 700) {
      EXPECT_EQ(up.at_ms[i], sent_ms);
    }
  }
}

// The car's silence counts from the sending, so a queue is no sign of life.
TEST(RadioChannel, SilenceCountsFromWhenTheNewestThatArrivedWasSent) {
  RadioChannel channel({}, {fault(BenchFaultKind::kRadioDelay, 500, 10'000, 0.4)}, 1);
  EXPECT_FALSE(channel.silence(at_ms(0)));
  send_for(channel, Way::kUp, 500);
  EXPECT_EQ(channel.silence(at_ms(500)), milliseconds(10));
  RadioChannel delayed({}, {fault(BenchFaultKind::kRadioDelay, 0, 10'000, 0.4)}, 1);
  send_for(delayed, Way::kUp, 1'000);
  EXPECT_EQ(delayed.silence(at_ms(1'000)), milliseconds(410));
}

TEST(RadioChannel, LosesTheShareThatTheFaultSays) {
  RadioChannel channel({}, {fault(BenchFaultKind::kRadioLoss, 0, 100'000'000, 0.3)}, 5);
  std::size_t came = 0;
  for (int i = 0; i < 20'000; ++i) {
    channel.offer(Way::kDown, 0, {Bytes{1}}, at_ms(i));
    if (channel.take(Way::kDown, 0, at_ms(i))) ++came;
  }
  EXPECT_NEAR(static_cast<double>(came) / 20'000, 0.7, 0.02);
  EXPECT_EQ(channel.counters().lost[0] + came, 20'000u);
}

// One seed, one trace; both directions of a path fade together, two paths do not.
TEST(RadioChannel, PathsFadeApartAndDirectionsTogether) {
  const scenario::RadioPath path{link::bursty(0.3, milliseconds(120), 0.0, Duration{}), {}};
  RadioChannel channel({path, path}, {}, 7), again({path, path}, {}, 7);
  ASSERT_EQ(channel.paths(), 2);
  const auto down = send_for(channel, Way::kDown, 60'000), up = send_for(channel, Way::kUp, 60'000);
  EXPECT_EQ(down.at_ms, up.at_ms);
  EXPECT_EQ(down.at_ms, send_for(again, Way::kDown, 60'000).at_ms);
  EXPECT_NE(down.at_ms, send_for(channel, Way::kDown, 60'000, 1).at_ms);
  EXPECT_NEAR(static_cast<double>(down.at_ms.size()) / 6'000, 0.7, 0.05);
  // No such path: no harm.
  channel.offer(Way::kUp, 2, {Bytes{1}}, at_ms(60'000));
  EXPECT_FALSE(channel.take(Way::kUp, 2, at_ms(60'000)));
}

}  // namespace
}  // namespace pitwall::bench
