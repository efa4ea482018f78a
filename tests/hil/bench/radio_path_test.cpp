// Carried both ways as it was, whoever the car is at the moment.
// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/radio_path.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"

namespace pitwall::bench {
namespace {

using transport::UdpSocket;
using Bytes = std::vector<std::uint8_t>;

constexpr Duration kPatience = seconds(5);  // of a loaded machine; nothing is measured with it

// A socket of the test: base or car.
UdpSocket socket() {
  auto bound = UdpSocket::bind({});
  EXPECT_TRUE(bound);
  return *std::move(bound);
}

std::uint16_t free_port() { return socket().local().port; }

Bytes take(UdpSocket& from) {
  const int watched[] = {from.fd()};
  transport::wait_readable(watched, transport::monotonic_now() + kPatience);
  std::vector<transport::UdpDatagram> got(1);
  if (from.receive(got) == 0) return {};
  return {got[0].payload().begin(), got[0].payload().end()};
}

Bytes telemetry_of(double mode) {
  telemetry::StatePacket packet;
  packet.values[telemetry::field("mode.mode")] = mode;
  telemetry::PacketBuffer buffer;
  telemetry::EncodeCounters counters;
  const auto bytes = telemetry::encode(packet, buffer, counters);
  return {bytes.begin(), bytes.end()};
}

struct RadioPathTest : ::testing::Test {
  UdpSocket base = socket(), car = socket();
  std::uint16_t listen = free_port(), uplink = free_port();
  Result<RadioPath, Problem> opened =
      RadioPath::open({.listen = listen, .onward = base.local().port, .uplink = uplink});
  RadioPath& path = *opened;
  Instant now{};

  // Until the path has counted one more of something.
  template <class Count>
  void carry(const Count& count) {
    const auto before = count();
    const Instant limit = transport::monotonic_now() + kPatience;
    while (count() == before && transport::monotonic_now() < limit) path.serve(now);
    EXPECT_EQ(count(), before + 1);
  }
  void say(UdpSocket& from, const Bytes& bytes) {
    ASSERT_TRUE(from.send_to({.port = listen}, bytes));
    carry([&] { return path.counters().packets + path.counters().refused; });
  }
  void answer(const Bytes& bytes) {
    ASSERT_TRUE(base.send_to({.port = uplink}, bytes));
    carry([&] { return path.counters().to_car + path.counters().no_car; });
  }
};

TEST_F(RadioPathTest, EveryDatagramReachesTheBaseByteForByte) {
  const Bytes packet = telemetry_of(2.0), noise{1, 2, 3};
  say(car, packet);
  EXPECT_EQ(take(base), packet);
  say(car, noise);
  EXPECT_EQ(take(base), noise) << "the bench is no filter";
  EXPECT_EQ(path.counters().packets, 1u);
  EXPECT_EQ(path.counters().refused, 1u);
  EXPECT_EQ(path.report().mode, 2.0);
}

TEST_F(RadioPathTest, AnAnswerGoesToTheCarThatSpokeLast) {
  say(car, telemetry_of(0.0));
  const Bytes first{7}, second{8, 9};
  answer(first);
  EXPECT_EQ(take(car), first);
  UdpSocket restarted = socket();
  say(restarted, telemetry_of(0.0));
  answer(second);
  EXPECT_EQ(take(restarted), second);
  EXPECT_EQ(path.counters().to_car, 2u);
}

TEST_F(RadioPathTest, NoiseMakesNobodyTheCar) {
  answer({1});
  EXPECT_EQ(path.counters().no_car, 1u) << "nobody has spoken yet";
  say(car, telemetry_of(0.0));
  UdpSocket stranger = socket();
  say(stranger, {1, 2, 3});
  answer({5});
  EXPECT_EQ(take(car), Bytes{5});
}

TEST_F(RadioPathTest, ACarThatHasStoppedSpeakingIsSilentAndOneThatNeverSpokeIsNot) {
  path.serve(now + seconds(100));
  EXPECT_FALSE(path.report().silent);
  say(car, telemetry_of(3.0));
  path.serve(now + RadioPath::kSilence);
  EXPECT_FALSE(path.report().silent);
  path.serve(now + RadioPath::kSilence + milliseconds(1));
  EXPECT_TRUE(path.report().silent);
  EXPECT_NE(path.report().mode, 3.0) << "old news are no news";
  now = now + seconds(1);
  say(car, telemetry_of(1.0));
  EXPECT_FALSE(path.report().silent);
  EXPECT_EQ(path.report().mode, 1.0);
}

TEST(RadioPath, APortThatIsTakenIsAProblem) {
  const UdpSocket holder = socket();
  const auto opened = RadioPath::open({.listen = holder.local().port, .onward = 0, .uplink = 0});
  ASSERT_FALSE(opened);
  EXPECT_NE(to_string(opened.error()).find(std::to_string(holder.local().port)), std::string::npos);
}

}  // namespace
}  // namespace pitwall::bench
