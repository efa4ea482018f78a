// Carried both ways as it was, whoever the car is at the moment.
// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/radio_path.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "tests/hil/bench/test_timeout.hpp"
#include "tests/support/instants.hpp"

namespace pitwall::bench {
namespace {

using transport::UdpSocket;
using Bytes = std::vector<std::uint8_t>;

// A socket of the test: base or car.
UdpSocket socket() {
  auto bound = UdpSocket::bind({});
  EXPECT_TRUE(bound);
  return *std::move(bound);
}

Bytes take(UdpSocket& from) {
  const int watched[] = {from.fd()};
  transport::wait_readable(watched, transport::monotonic_now() + kTestTimeout);
  std::vector<transport::UdpDatagram> got(1);
  if (from.receive(got) == 0) return {};
  return {got[0].payload().begin(), got[0].payload().end()};
}

// A path, or two; the base and the car of each are sockets of the test.
struct Ends {
  explicit Ends(const std::vector<scenario::RadioPath>& radio = {},
                std::vector<faults::BenchFault> faults = {})
      : channel(radio, std::move(faults), 3) {
    std::vector<RadioPorts> wanted;
    for (std::size_t i = 0; i < channel.paths(); ++i) {
      bases.push_back(socket());
      cars.push_back(socket());
      wanted.push_back({.listen = 0, .onward = bases.back().local().port, .uplink = 0});
    }
    auto opened = RadioPath::open(wanted, std::move(channel));
    EXPECT_TRUE(opened);
    path.emplace(*std::move(opened));
    for (std::size_t i = 0; i < wanted.size(); ++i) ports.push_back(path->ports(i));
  }

  // Until the path has counted one more of something.
  template <class Count>
  void carry(const Count& count) {
    const auto before = count();
    const Instant limit = transport::monotonic_now() + kTestTimeout;
    while (count() == before && transport::monotonic_now() < limit) path->serve(now);
    EXPECT_EQ(count(), before + 1);
  }
  void say(UdpSocket& from, const Bytes& bytes, std::size_t lane = 0) {
    ASSERT_TRUE(from.send_to({.port = ports[lane].listen}, bytes));
    carry([&] { return path->counters().from_car; });
  }
  void answer(const Bytes& bytes, std::size_t lane = 0) {
    ASSERT_TRUE(bases[lane].send_to({.port = ports[lane].uplink}, bytes));
    carry([&] { return path->counters().from_base; });
  }

  RadioChannel channel;
  std::vector<UdpSocket> bases, cars;
  std::vector<RadioPorts> ports;
  std::optional<RadioPath> path;
  Instant now = at_ms(0);
};

TEST(RadioPath, CarriesEveryDatagramByteForByteAndUnread) {
  Ends ends;
  const Bytes sealed(700, 0xA5), noise{1, 2, 3};
  ends.say(ends.cars[0], sealed);
  EXPECT_EQ(take(ends.bases[0]), sealed);
  ends.say(ends.cars[0], noise);
  EXPECT_EQ(take(ends.bases[0]), noise) << "the bench is no filter";
  ends.answer({9, 8});
  EXPECT_EQ(take(ends.cars[0]), (Bytes{9, 8}));
  EXPECT_EQ(ends.path->counters().to_base, 2u);
  EXPECT_EQ(ends.path->counters().to_car, 1u);
}

TEST(RadioPath, AnAnswerGoesToTheCarThatSpokeLast) {
  Ends ends;
  ends.answer({1});
  EXPECT_EQ(ends.path->counters().no_car, 1u) << "nobody has spoken yet";
  ends.say(ends.cars[0], {1});
  ends.answer({7});
  EXPECT_EQ(take(ends.cars[0]), Bytes{7});
  UdpSocket restarted = socket();
  ends.say(restarted, {1});
  ends.answer({8, 9});
  EXPECT_EQ(take(restarted), (Bytes{8, 9}));
}

TEST(RadioPath, PathsAreApart) {
  Ends ends(std::vector<scenario::RadioPath>(2));
  ends.say(ends.cars[0], {1}, 0);
  ends.say(ends.cars[1], {2}, 1);
  EXPECT_EQ(take(ends.bases[0]), Bytes{1});
  EXPECT_EQ(take(ends.bases[1]), Bytes{2});
  ends.answer({3}, 1);
  EXPECT_EQ(take(ends.cars[1]), Bytes{3});
}

TEST(RadioPath, WhatTheAirHoldsBackComesWhenItIsTime) {
  Ends ends({{link::bursty(0.0, {}, 0.0, milliseconds(15)), {}}});
  ends.say(ends.cars[0], {1});
  EXPECT_EQ(ends.path->counters().to_base, 0u);
  ends.path->serve(at_ms(14));
  EXPECT_EQ(ends.path->counters().to_base, 0u);
  ends.path->serve(at_ms(15));
  EXPECT_EQ(take(ends.bases[0]), Bytes{1});
}

TEST(RadioPath, AFaultOfTheRadioIsCarriedOut) {
  Ends ends({}, {{.kind = faults::BenchFaultKind::kBaseStationSilent,
                  .start = at_ms(100),
                  .duration = milliseconds(100)}});
  ends.say(ends.cars[0], {1});
  ends.now = at_ms(150);
  ends.answer({2});
  EXPECT_EQ(ends.path->counters().to_car, 0u);
  ends.now = at_ms(250);
  ends.answer({3});
  EXPECT_EQ(take(ends.cars[0]), Bytes{3});
}

TEST(RadioPath, APortThatIsTakenIsAProblem) {
  const UdpSocket holder = socket();
  const std::vector<RadioPorts> ports{{.listen = holder.local().port, .onward = 0, .uplink = 0}};
  const auto opened = RadioPath::open(ports, RadioChannel{{}, {}, 1});
  ASSERT_FALSE(opened);
  EXPECT_NE(to_string(opened.error()).find(std::to_string(holder.local().port)), std::string::npos);
}

}  // namespace
}  // namespace pitwall::bench
