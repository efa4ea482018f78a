// What each monitor of the gateway sees, in the very tick, and that one that is off sees and
// refuses nothing.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "protocol/can/e2e.hpp"
#include "protocol/can/integrity_bench.hpp"
#include "tests/vehicle/gateway/traffic.hpp"
#include "vehicle/gateway/inbound.hpp"

namespace pitwall::gateway {
namespace {

using namespace testing;
using world::Monitor;
using world::MonitorSet;

constexpr std::uint32_t kOwnId = 1402;

struct MonitoredReceiver {
  InboundParams params;
  InboundState state;
  std::int64_t tick = 0;
  std::uint8_t counter = 0;

  InboundOutput receive(const std::vector<can::Frame>& frames) {
    // Wheel speeds come every 5 ms.
    std::vector<can::ReceivedFrame> received{{wheels(144.0), at_ms(10 * tick - 5)}};
    for (const can::Frame& frame : frames) received.push_back({frame, at_ms(10 * tick)});
    const InboundOutput out = decode(params, state, received, at_ms(10 * tick));
    ++tick;
    return out;
  }
  // Some healthy traffic, without an alarm.
  void warm_up() {
    for (int i = 0; i < 30; ++i)
      EXPECT_TRUE(receive({wheels(144.0), steering(5.0, counter++)}).seen.empty());
  }
};

MonitorSet only(Monitor monitor) {
  MonitorSet set;
  set.add(monitor);
  return set;
}

struct Case {
  Monitor monitor;
  const char* name;
  std::function<InboundOutput(MonitoredReceiver&)> wrong;
  std::uint64_t world::FrameRefusals::*refusal;
};

can::Frame shortened(can::Frame frame) {
  --frame.length;
  return frame;
}
can::Frame extended(can::Frame frame) {
  frame.extended = true;
  return frame;
}

const std::vector<Case> kCases{
    {Monitor::kCounter, "a repeated counter",
     [](MonitoredReceiver& r) {
       return r.receive({wheels(144.0), steering(5.0, static_cast<std::uint8_t>(r.counter - 1))});
     },
     &world::FrameRefusals::stuck_counter},
    {Monitor::kFrameShape, "a short frame",
     [](MonitoredReceiver& r) {
       return r.receive({shortened(wheels(144.0)), steering(5.0, r.counter++)});
     },
     &world::FrameRefusals::wrong_length},
    {Monitor::kFrameShape, "a 29 bit identifier",
     [](MonitoredReceiver& r) {
       return r.receive({extended(wheels(144.0)), steering(5.0, r.counter++)});
     },
     &world::FrameRefusals::remote_or_error},
    {Monitor::kDecodedRange, "a wheel that leaps",
     [](MonitoredReceiver& r) {
       return r.receive({wheels(330.0), steering(5.0, r.counter++)});
     },
     &world::FrameRefusals::implausible_slew},
    {Monitor::kDecodedRange, "an angle beyond all range",
     [](MonitoredReceiver& r) {
       return r.receive({wheels(144.0), steering(500.0, r.counter++)});
     },
     &world::FrameRefusals::out_of_range}};

TEST(GatewayMonitors, EachSeesItsFaultInTheTickOfTheFrameAndNothingElseDoes) {
  for (const Case& c : kCases) {
    MonitoredReceiver car;
    car.warm_up();
    const InboundOutput out = c.wrong(car);
    EXPECT_EQ(out.seen, only(c.monitor)) << c.name;
    EXPECT_EQ(out.bus.refused.*c.refusal, 1u) << c.name;
  }
}

TEST(GatewayMonitors, OneThatIsOffSeesAndRefusesNothing) {
  for (const Case& c : kCases) {
    MonitoredReceiver car;
    car.params.off = only(c.monitor);
    car.warm_up();
    const InboundOutput out = c.wrong(car);
    EXPECT_TRUE(out.seen.empty()) << c.name;
    EXPECT_EQ(out.bus.refused.total(), 0u) << c.name;
  }
}

TEST(GatewayMonitors, AnUnknownIdentifierIsSeen) {
  for (const bool off : {false, true}) {
    MonitoredReceiver car;
    if (off) car.params.off = only(Monitor::kFrameShape);
    car.warm_up();
    can::Frame stranger = wheels(144.0);
    stranger.id = 0x7A0;
    const InboundOutput out = car.receive({wheels(144.0), steering(5.0, car.counter++), stranger});
    EXPECT_EQ(out.seen.has(Monitor::kFrameShape), !off);
    EXPECT_EQ(out.bus.refused.unknown_id, 1u) << "nobody can apply it";
  }
}

TEST(GatewayMonitors, OurOwnVoiceFromAnotherNode) {
  for (const bool off : {false, true}) {
    MonitoredReceiver car;
    if (off) car.params.off = only(Monitor::kOwnId);
    car.warm_up();
    can::Frame own;
    own.id = kOwnId;
    own.length = 8;
    const InboundOutput out = car.receive({wheels(144.0), steering(5.0, car.counter++), own});
    EXPECT_EQ(out.seen.has(Monitor::kOwnId), !off);
    EXPECT_EQ(out.own_id_seen, !off);
    EXPECT_EQ(out.own_frames, 1u);
  }
}

TEST(GatewayMonitors, AMessageThatStopsIsSeenWithinTwoAndAHalfPeriods) {
  for (const bool off : {false, true}) {
    MonitoredReceiver car;
    if (off) car.params.off = only(Monitor::kMessageAge);
    car.warm_up();
    int ticks = 0;
    while (ticks < 10 && !car.receive({wheels(144.0)}).seen.has(Monitor::kMessageAge)) ++ticks;
    EXPECT_EQ(ticks < 10, !off);
    if (off) continue;
    EXPECT_LE(10 * (ticks + 1), 30) << "ms, at ticks of 10";
  }
}

// Of each message alone: older than two and a half periods, or than its timeout. What was never
// heard is not late, and what we send is none of it.
TEST(GatewayMonitors, EachMessageOfTheCarIsLateByItsOwnPeriod) {
  constexpr Instant kReceived = at_ms(1'000);
  for (std::size_t i = 0; i < can::av21::kMessages.size(); ++i) {
    const can::MessageRow& row = can::av21::kMessages[i];
    const Duration late = row.period * 5 / 2;
    for (const Duration age : {Duration{}, std::min(late, row.timeout),
                               std::min(late, row.timeout) + nanoseconds(1), late + row.timeout}) {
      InboundState state;
      state.messages[i].last = kReceived;
      state.messages[i].ever = true;
      const bool is_late = age > late || age > row.timeout;
      const InboundOutput out = decode({}, state, {}, kReceived + age);
      EXPECT_EQ(out.seen.has(Monitor::kMessageAge),
                is_late && row.direction == can::Direction::kFromCar)
          << row.id << " after " << age.ns;
    }
  }
}

TEST(GatewayMonitors, AFrameThatIsMissingIsSeenThoughItsMessageIsNotLate) {
  MonitoredReceiver car;
  car.warm_up();
  car.receive({wheels(144.0)});
  ++car.counter;
  const InboundOutput out = car.receive({wheels(144.0), steering(5.0, car.counter++)});
  EXPECT_EQ(out.bus.losses.size(), 1u);
  EXPECT_TRUE(out.seen.has(Monitor::kMessageAge));
}

// Whether the frame is refused yet or not, and also where the debt cannot rise any more.
TEST(GatewayMonitors, EveryBadCounterIsSeen) {
  MonitoredReceiver car;
  car.warm_up();
  const auto sees = [&car](std::uint8_t counter) {
    return car.receive({wheels(144.0), steering(5.0, counter)}).seen.has(Monitor::kCounter);
  };
  car.counter = static_cast<std::uint8_t>(car.counter + 100);
  EXPECT_TRUE(sees(car.counter)) << "the first that jumps is applied";
  EXPECT_EQ(car.state.refused.total(), 0u);
  for (int i = 0; i < 3 * car.params.fault_debt; ++i) EXPECT_TRUE(sees(car.counter)) << i;
  EXPECT_GT(car.state.refused.stuck_counter, 0u);
}

TEST(GatewayMonitors, MessagesBesideTheDatabaseAreCountedLikeItsOwn) {
  static constexpr std::array kRows{can::integrity_bench::kMessages[2],
                                    can::integrity_bench::kMessages[3]};
  InboundParams params{.also = kRows};
  InboundState state;
  std::array<can::ProtectState, 2> senders;
  const auto receive = [&](std::size_t row, int ms, auto&& spoil) {
    can::ReceivedFrame received{.frame = {}, .at = at_ms(ms)};
    received.frame.id = kRows[row].id;
    received.frame.length = kRows[row].length;
    can::protect(kRows[row].protection, senders[row], received.frame);
    spoil(received.frame);
    return decode(params, state, {&received, 1}, received.at).bus;
  };
  const auto whole = [](can::Frame&) {};
  EXPECT_EQ(receive(0, 10, whole).frames_applied, 1u);
  EXPECT_EQ(receive(1, 10, whole).frames_applied, 2u);
  const auto crc = kRows[1].protection.crc_byte;
  const world::BusHealth spoilt = receive(1, 20, [&](can::Frame& f) { f.data[crc] ^= 0x55; });
  EXPECT_EQ(spoilt.frames_applied, 2u);
  EXPECT_EQ(spoilt.refused.wrong_checksum, 1u);
  const world::BusHealth shortened = receive(1, 30, [](can::Frame& f) { --f.length; });
  EXPECT_EQ(shortened.frames_applied, 2u);
  EXPECT_EQ(shortened.refused.wrong_length, 1u);
  EXPECT_EQ(shortened.refused.unknown_id, 0u) << "it is known, if not in this length";
}

TEST(GatewayMonitors, MoreMessagesBesideTheDatabaseThanFitAreOurOwnMistake) {
  const std::vector<can::MessageRow> rows(kAlsoMax + 1, can::integrity_bench::kMessages[3]);
  InboundState state;
  static_cast<void>(decode({.also = std::span{rows}.first(kAlsoMax)}, state, {}, at_ms(1)));
  EXPECT_DEATH(static_cast<void>(decode({.also = rows}, state, {}, at_ms(1))), "CHECK");
}

TEST(GatewayMonitors, AChecksumIsJudgedBesideTheDatabase) {
  static constexpr std::array kRows{can::integrity_bench::kMessages[3]};
  ASSERT_NE(kRows[0].protection.profile, can::Protection::kNone);
  for (const bool off : {false, true}) {
    MonitoredReceiver car;
    car.params.also = kRows;
    if (off) car.params.off = only(Monitor::kChecksum);
    can::ProtectState sender;
    const auto protected_frame = [&] {
      can::Frame frame;
      frame.id = kRows[0].id;
      frame.length = kRows[0].length;
      can::protect(kRows[0].protection, sender, frame);
      return frame;
    };
    for (int i = 0; i < 30; ++i)
      EXPECT_TRUE(car.receive({wheels(144.0), protected_frame()}).seen.empty()) << i;
    can::Frame spoilt = protected_frame();
    spoilt.data[kRows[0].protection.crc_byte] ^= 0x55;
    const InboundOutput out = car.receive({wheels(144.0), spoilt});
    EXPECT_EQ(out.seen, off ? MonitorSet{} : only(Monitor::kChecksum));
    EXPECT_EQ(out.bus.refused.wrong_checksum, off ? 0u : 1u);
    EXPECT_TRUE(car.receive({wheels(144.0), protected_frame()}).seen.empty()) << "and it is over";
  }
}

// Where the bus protects a message of the car: a damaged one is not applied, a true one is.
TEST(GatewayMonitors, AChecksumOfAMessageOfTheCarKeepsAFalseValueOut) {
  static constexpr auto kRow = [] {
    for (can::MessageRow row : can::av21::kMessages) {
      if (row.id != 1200) continue;
      row.protection = {.profile = can::Protection::kJ1850, .length = 8, .crc_byte = 7};
      return row;
    }
    return can::MessageRow{};
  }();
  static constexpr std::array kRows{kRow};
  const auto flags = [](std::uint8_t track, std::uint8_t heartbeat) {
    can::Frame frame;
    frame.id = 1200;
    frame.length = 8;
    frame.data[0] = static_cast<std::uint8_t>(track << 4U | heartbeat);
    can::ProtectState sender;
    can::protect(kRow.protection, sender, frame);
    return frame;
  };
  for (const bool off : {false, true}) {
    MonitoredReceiver car;
    car.params.also = kRows;
    if (off) car.params.off = only(Monitor::kChecksum);
    EXPECT_EQ(car.receive({flags(4, 1)}).race_control.track, world::TrackFlag::kGreen);
    can::Frame damaged = flags(4, 2);
    damaged.data[0] = 0x12;  // red
    const InboundOutput out = car.receive({damaged});
    EXPECT_EQ(out.race_control.track, off ? world::TrackFlag::kRed : world::TrackFlag::kGreen);
    EXPECT_EQ(out.seen.has(Monitor::kChecksum), !off);
    EXPECT_EQ(car.receive({flags(3, 3)}).race_control.track, world::TrackFlag::kYellow);
  }
}

TEST(GatewayMonitors, AFrozenReportIsSeenThroughTheWholeGateway) {
  for (const bool off : {false, true}) {
    MonitoredReceiver car;
    if (off) car.params.off = only(Monitor::kFrozenSignal);
    car.warm_up();
    bool seen = false;
    for (int i = 0; i < 40; ++i) {
      world::ActuatorCommand command;
      command.road_wheel_rad = 0.0005 * i;
      command.throttle_fraction = command.brake_kpa = 0.0;
      store_command(car.state, command, true, at_ms(10 * car.tick));
      seen |= car.receive({wheels(144.0), steering(5.0, car.counter++)})
                  .seen.has(Monitor::kFrozenSignal);
    }
    EXPECT_EQ(seen, !off);
  }
}

}  // namespace
}  // namespace pitwall::gateway
