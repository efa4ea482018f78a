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

  InboundOutput hear(const std::vector<can::Frame>& frames) {
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
      EXPECT_TRUE(hear({wheels(144.0), steering(5.0, counter++)}).seen.empty());
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
       return r.hear({wheels(144.0), steering(5.0, static_cast<std::uint8_t>(r.counter - 1))});
     },
     &world::FrameRefusals::stuck_counter},
    {Monitor::kFrameShape, "a short frame",
     [](MonitoredReceiver& r) {
       return r.hear({shortened(wheels(144.0)), steering(5.0, r.counter++)});
     },
     &world::FrameRefusals::wrong_length},
    {Monitor::kFrameShape, "a 29 bit identifier",
     [](MonitoredReceiver& r) {
       return r.hear({extended(wheels(144.0)), steering(5.0, r.counter++)});
     },
     &world::FrameRefusals::remote_or_error},
    {Monitor::kDecodedRange, "a wheel that leaps",
     [](MonitoredReceiver& r) {
       return r.hear({wheels(330.0), steering(5.0, r.counter++)});
     },
     &world::FrameRefusals::implausible_slew},
    {Monitor::kDecodedRange, "an angle beyond all range",
     [](MonitoredReceiver& r) {
       return r.hear({wheels(144.0), steering(500.0, r.counter++)});
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
    const InboundOutput out = car.hear({wheels(144.0), steering(5.0, car.counter++), stranger});
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
    const InboundOutput out = car.hear({wheels(144.0), steering(5.0, car.counter++), own});
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
    while (ticks < 10 && !car.hear({wheels(144.0)}).seen.has(Monitor::kMessageAge)) ++ticks;
    EXPECT_EQ(ticks < 10, !off);
    if (off) continue;
    EXPECT_LE(10 * (ticks + 1), 30) << "ms, at ticks of 10";
  }
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
      EXPECT_TRUE(car.hear({wheels(144.0), protected_frame()}).seen.empty()) << i;
    can::Frame spoilt = protected_frame();
    spoilt.data[kRows[0].protection.crc_byte] ^= 0x55;
    const InboundOutput out = car.hear({wheels(144.0), spoilt});
    EXPECT_EQ(out.seen, off ? MonitorSet{} : only(Monitor::kChecksum));
    EXPECT_EQ(out.bus.refused.wrong_checksum, off ? 0u : 1u);
    EXPECT_TRUE(car.hear({wheels(144.0), protected_frame()}).seen.empty()) << "and it is over";
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
    EXPECT_EQ(car.hear({flags(4, 1)}).race_control.track, world::TrackFlag::kGreen);
    can::Frame damaged = flags(4, 2);
    damaged.data[0] = 0x12;  // red
    const InboundOutput out = car.hear({damaged});
    EXPECT_EQ(out.race_control.track, off ? world::TrackFlag::kRed : world::TrackFlag::kGreen);
    EXPECT_EQ(out.seen.has(Monitor::kChecksum), !off);
    EXPECT_EQ(car.hear({flags(3, 3)}).race_control.track, world::TrackFlag::kYellow);
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
      remember_command(car.state, command, true, at_ms(10 * car.tick));
      seen |=
          car.hear({wheels(144.0), steering(5.0, car.counter++)}).seen.has(Monitor::kFrozenSignal);
    }
    EXPECT_EQ(seen, !off);
  }
}

}  // namespace
}  // namespace pitwall::gateway
