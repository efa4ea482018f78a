// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/car_monitor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "protocol/transport/clock.hpp"
#include "tests/hil/bench/test_timeout.hpp"

namespace pitwall::bench {
namespace {

using transport::UdpSocket;

struct Monitored : ::testing::Test {
  Result<CarMonitor, Problem> opened = CarMonitor::open(0);
  CarMonitor& monitor = *opened;
  UdpSocket car = *UdpSocket::bind({});
  Instant now{};

  void send(std::span<const std::uint8_t> bytes) {
    const auto received = [&] { return monitor.packets() + monitor.refused(); };
    const auto before = received();
    ASSERT_TRUE(car.send_to({.port = monitor.port()}, bytes));
    const Instant limit = transport::monotonic_now() + kTestTimeout;
    while (received() == before && transport::monotonic_now() < limit) monitor.read(now);
    EXPECT_EQ(received(), before + 1);
  }
  void say(double mode) {
    telemetry::StatePacket packet;
    packet.values[telemetry::field("mode.mode")] = mode;
    packet.values[telemetry::field("mode.first_stop_cause")] = 31.0;
    packet.values[telemetry::field("planner.operator_limit")] = 30.0;
    telemetry::PacketBuffer buffer;
    telemetry::EncodeCounters counters;
    send(telemetry::encode(packet, buffer, counters));
  }
};

TEST_F(Monitored, IsToldWhatTheCarSays) {
  say(2.0);
  EXPECT_EQ(monitor.report().mode, 2.0);
  EXPECT_EQ(monitor.report().cause, 31.0);
  EXPECT_EQ(monitor.report().operator_limit_mps, 30.0);
  EXPECT_TRUE(std::isnan(monitor.report().x_m));
}

TEST_F(Monitored, NoiseIsCountedAndChangesNothing) {
  say(2.0);
  const std::vector<std::uint8_t> noise{1, 2, 3};
  send(noise);
  EXPECT_EQ(monitor.refused(), 1u);
  EXPECT_EQ(monitor.report().mode, 2.0);
}

TEST_F(Monitored, ACarThatHasStoppedSpeakingIsSilentAndOneThatNeverSpokeIsNot) {
  monitor.read(now + seconds(100));
  EXPECT_FALSE(monitor.report().silent);
  say(3.0);
  monitor.read(now + CarMonitor::kSilence);
  EXPECT_FALSE(monitor.report().silent);
  monitor.read(now + CarMonitor::kSilence + milliseconds(1));
  EXPECT_TRUE(monitor.report().silent);
  EXPECT_NE(monitor.report().mode, 3.0) << "old news are no news";
  now = now + seconds(1);
  say(1.0);
  EXPECT_FALSE(monitor.report().silent);
  EXPECT_EQ(monitor.report().mode, 1.0);
}

TEST_F(Monitored, APortThatIsTakenIsAProblem) {
  const auto second = CarMonitor::open(monitor.port());
  ASSERT_FALSE(second);
  EXPECT_NE(to_string(second.error()).find(std::to_string(monitor.port())), std::string::npos);
}

}  // namespace
}  // namespace pitwall::bench
