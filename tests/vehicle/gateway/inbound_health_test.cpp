// What the gateway says of the bus and of race control beside the values of the car.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <vector>

#include "protocol/can/integrity_bench.hpp"
#include "tests/vehicle/gateway/traffic.hpp"
#include "vehicle/gateway/inbound.hpp"

namespace pitwall::gateway {
namespace {

using namespace testing;

InboundOutput hear_at(const InboundParams& params, InboundState& state, const can::Frame& frame,
                      Instant at) {
  const can::ReceivedFrame received{frame, at};
  return decode(params, state, {&received, 1}, at);
}

TEST(InboundFlags, BothEncodingsAreToldAsTheyWereHeard) {
  for (const auto encoding : {world::FlagEncoding::kMyLaps, world::FlagEncoding::kMarelli}) {
    const InboundParams params{.flag_encoding = encoding};
    InboundState state;
    hear_at(params, state, summary({.heartbeat = 1, .track = 3, .vehicle = 2, .laps = 7}),
            at_ms(10));
    const auto rc =
        hear_at(params, state, marelli({.track = 9, .vehicle = 4, .sector = 5}), at_ms(20))
            .race_control;
    const bool by_mylaps = encoding == world::FlagEncoding::kMyLaps;
    EXPECT_EQ(rc.encoding, encoding);
    EXPECT_EQ(rc.raw_track, by_mylaps ? 3 : 9);
    EXPECT_EQ(rc.raw_vehicle, by_mylaps ? 2 : 4);
    EXPECT_EQ(rc.raw_sector, by_mylaps ? 0 : 5);
    EXPECT_EQ(rc.other_raw_track, by_mylaps ? 9 : 3);
    EXPECT_EQ(rc.other_raw_vehicle, by_mylaps ? 4 : 2);
    EXPECT_EQ(rc.other_raw_sector, by_mylaps ? 5 : 0);
    EXPECT_EQ(rc.lap_count, 7);
  }
}

TEST(InboundHealth, TheLastFrameIsTheNewestOfAny) {
  InboundState state;
  can::Frame unknown;
  unknown.id = 1;
  EXPECT_EQ(decode({}, state, {}, at_ms(5)).bus.last_frame, Instant{});
  EXPECT_EQ(hear_at({}, state, wheels(50.0), at_ms(10)).bus.last_frame, at_ms(10));
  EXPECT_EQ(hear_at({}, state, unknown, at_ms(20)).bus.last_frame, at_ms(20));
  EXPECT_EQ(decode({}, state, {}, at_ms(30)).bus.last_frame, at_ms(20));
}

// A frame of eight bytes in ten milliseconds: 111 bits of 5000.
TEST(InboundHealth, TheLoadIsThatOfTheFramesHeard) {
  InboundState state;
  InboundOutput out;
  for (std::int64_t ms = 5; ms < 100; ms += 10) out = hear_at({}, state, wheels(50.0), at_ms(ms));
  observe_link(state, out.bus, {}, at_ms(100));
  EXPECT_NEAR(out.bus.link.load, 111.0 / 5000.0, 1e-9);
}

TEST(InboundHealth, EveryMessageOfTheCarHasItsRow) {
  InboundState state;
  const world::BusHealth bus = decode({}, state, {}, at_ms(1)).bus;
  std::size_t i = 0;
  for (const can::MessageRow& row : av21::kMessages) {
    if (row.direction != can::Direction::kFromCar) continue;
    ASSERT_LT(i, bus.messages.size());
    EXPECT_EQ(bus.messages[i++].id, row.id);
  }
  EXPECT_EQ(i, bus.messages.size());
}

// Between two looks one frame is missing, and the next one tells by its counter.
TEST(InboundHealth, ALossIsToldWithWhatBetrayedIt) {
  InboundState state;
  for (std::uint8_t i = 0; i < 50; ++i) hear_at({}, state, steering(1.0, i), at_ms(10 * i));
  const auto by_counter = hear_at({}, state, steering(1.0, 51), at_ms(510)).bus;
  ASSERT_EQ(by_counter.losses.size(), 1U);
  EXPECT_EQ(by_counter.losses[0].detector, world::LossDetector::kCounter);
  const auto by_period = decode({}, state, {}, at_ms(526)).bus;
  ASSERT_EQ(by_period.losses.size(), 1U);
  EXPECT_EQ(by_period.losses[0].detector, world::LossDetector::kPeriod);
}

// The bench's own messages, each watched by itself.
TEST(InboundHealth, AMessageBesideTheDatabaseThatIsMissingIsReported) {
  static constexpr std::array kRows = [] {
    std::array rows{can::integrity_bench::kMessages[0], can::integrity_bench::kMessages[0]};
    rows[0].id -= 1;
    return rows;
  }();
  const InboundParams params{.also = kRows};
  for (const can::MessageRow& row : kRows) {
    ASSERT_FALSE(row.has_counter);
    InboundState state;
    Instant at{};
    for (int i = 0; i < 10; ++i) {
      at += row.period;
      EXPECT_TRUE(hear_at(params, state, empty_frame(row), at).bus.losses.empty());
    }
    const auto bus = decode(params, state, {}, at + row.period * 2).bus;
    ASSERT_EQ(bus.losses.size(), 1U) << row.id;
    EXPECT_EQ(bus.losses[0].id, row.id);
  }
}

}  // namespace
}  // namespace pitwall::gateway
