// What holds on every kernel; the rest, on a real vcan0, is in tests/system/vcan.
// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/can/can_socket.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/protocol/transport/any_frame.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/unix_bus_bench.hpp"

namespace pitwall::transport {
namespace {

TEST(CanSocketAnywhere, AnInterfaceThatIsNotThereIsAProblemWithItsName) {
  const auto socket = CanSocket::open("nosuchcan0");
  ASSERT_FALSE(socket.has_value());
  EXPECT_EQ(socket.error().place, "nosuchcan0");
}

// The same class on a unix bus, where a kernel without CAN has one too.
class CanSocketOnUnixBus : public testing::UnixBusBench {
 protected:
  CanSocket open(const CanSocketOptions& options = {}) {
    auto socket = CanSocket::open(bus_, options);
    EXPECT_TRUE(socket) << to_string(socket.error());
    serve();
    return *std::move(socket);
  }
  std::vector<can::ReceivedFrame> receive(CanSocket& socket, std::size_t most = 4'096) {
    std::vector<can::ReceivedFrame> out(most);
    out.resize(socket.receive(out));
    return out;
  }
};

TEST_F(CanSocketOnUnixBus, EveryKindOfFrameArrivesOnceInOrderAndStamped) {
  CanSocket sender = open(), reader = open();
  std::mt19937_64 random(41);
  std::vector<can::Frame> sent;
  const Instant begun = monotonic_now();
  while (sent.size() < 4'000) {
    std::vector<can::Frame> burst(random() % 200 + 1);
    for (can::Frame& frame : burst) frame = any_frame(random);
    ASSERT_EQ(sender.send(burst), burst.size());
    sent.insert(sent.end(), burst.begin(), burst.end());
    serve();
  }
  const auto received = receive(reader, 8'192);
  const Instant ended = monotonic_now();
  ASSERT_EQ(received.size(), sent.size());
  Instant last = begun - milliseconds(1);  // the calendar's offset is known to a few microseconds
  for (std::size_t i = 0; i < sent.size(); ++i) {
    ASSERT_EQ(received[i].frame, sent[i]);
    ASSERT_GE(received[i].at, last);
    last = received[i].at;
  }
  EXPECT_LE(last, ended);
  EXPECT_EQ(sender.counters().sent, sent.size());
  EXPECT_EQ(reader.counters().received, sent.size());
  EXPECT_EQ(reader.counters().rx_malformed, 0u);
  EXPECT_TRUE(receive(sender).empty());
}

TEST_F(CanSocketOnUnixBus, WithOneOffsetTwoSocketsGiveAFrameTheSameOrder) {
  // GIVEN two readers with an offset that is 3 ms too large: it is theirs, and no other is read
  const Duration offset = realtime_minus_monotonic() + milliseconds(3);
  CanSocket sender = open(), first = open({.clock_offset = offset}),
            second = open({.clock_offset = offset});
  const Instant before = monotonic_now();
  // WHEN each is read at times of its own, over more than one look at the clock
  std::vector<can::ReceivedFrame> at_first, at_second;
  const auto take = [&](CanSocket& socket, std::vector<can::ReceivedFrame>& into) {
    for (const can::ReceivedFrame& frame : receive(socket)) into.push_back(frame);
  };
  for (std::uint32_t i = 0; i < 300; ++i) {
    ASSERT_TRUE(sender.send(can::Frame{.id = i, .length = 0}));
    serve();
    if (i % 2 == 0) take(first, at_first);
    if (i % 7 == 0) take(second, at_second);
    nap(milliseconds(1));
  }
  take(first, at_first), take(second, at_second);
  // THEN a frame comes to the second one before the next comes to the first, without a tolerance
  ASSERT_EQ(at_first.size(), 300u);
  ASSERT_EQ(at_second.size(), 300u);
  for (std::size_t i = 0; i + 1 < at_first.size(); ++i) {
    ASSERT_LT(at_second[i].at, at_first[i + 1].at);
    ASSERT_LT(at_first[i].at, at_second[i + 1].at);
  }
  EXPECT_LT(at_first.front().at, before - milliseconds(1));
  EXPECT_LT(at_first.back().at, monotonic_now() - milliseconds(2));
}

TEST_F(CanSocketOnUnixBus, FiltersKeepBackWhatTheirLawSays) {
  std::mt19937_64 random(43);
  CanSocket sender = open();
  for (int round = 0; round < 20; ++round) {
    CanSocketOptions options{.fd = random() % 2 == 0};
    for (std::size_t k = 0; k < random() % 4; ++k)
      options.filters.push_back({.id = static_cast<std::uint32_t>(random() % 64),
                                 .mask = static_cast<std::uint32_t>(random() % 64),
                                 .extended = random() % 2 == 0});
    CanSocket reader = open(options);
    std::vector<can::Frame> frames(100), expected;
    for (can::Frame& frame : frames) {
      frame = any_frame(random);
      bool passes = options.filters.empty();
      for (const CanFilter& f : options.filters)
        passes |=
            !frame.remote && frame.extended == f.extended && (frame.id & f.mask) == (f.id & f.mask);
      if (passes && (options.fd || !frame.fd)) expected.push_back(frame);
    }
    ASSERT_EQ(sender.send(frames), frames.size());
    serve();
    const auto received = receive(reader);
    ASSERT_EQ(received.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_EQ(received[i].frame, expected[i]);
    EXPECT_EQ(reader.counters().received, expected.size());
  }
}

TEST_F(CanSocketOnUnixBus, OwnFramesComeOnlyWhenAskedForAndThenInTheBusOrder) {
  CanSocket echo = open({.receive_own = true}), other = open();
  std::vector<can::Frame> order;
  for (std::uint32_t i = 0; i < 300; ++i) {
    can::Frame frame{.id = i, .length = 1};
    frame.data[0] = static_cast<std::uint8_t>(i % 2);
    ASSERT_TRUE((i % 2 == 0 ? echo : other).send(frame));
    order.push_back(frame);
    serve();
  }
  const auto all = receive(echo);
  ASSERT_EQ(all.size(), order.size());
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(all[i].frame, order[i]);
  EXPECT_EQ(receive(other).size(), order.size() / 2);
}

TEST_F(CanSocketOnUnixBus, ErrorFramesOfAnotherClientTellAsAControllersWould) {
  CanSocket bench = open(), reader = open(), careless = open({.receive_errors = false});
  ASSERT_TRUE(bench.send_error(CAN_ERR_BUSOFF));
  serve();
  EXPECT_TRUE(receive(reader).empty());
  EXPECT_EQ(reader.bus_state(), BusState::kBusOff);
  EXPECT_EQ(reader.counters().error_frames, 1u);
  EXPECT_TRUE(receive(careless).empty());
  EXPECT_EQ(careless.counters().error_frames, 0u);
  const std::uint8_t overrun[] = {0, CAN_ERR_CRTL_RX_OVERFLOW, 0, 0, 9, 9, 9, 9};
  ASSERT_TRUE(bench.send_error(CAN_ERR_CRTL, overrun));
  serve();
  receive(reader);
  EXPECT_EQ(reader.counters().errors.controller, 1u);
  EXPECT_EQ(reader.counters().rx_dropped_queue, 0u);  // not the hub's word
}

TEST_F(CanSocketOnUnixBus, LossesAreThoseTheHubCountsAndAddUpOverHubs) {
  std::uint64_t dropped = 0, delivered = 0;
  start({.queue_bytes = 1});
  CanSocket sender = open(), reader = open();
  std::vector<can::Frame> burst(50, can::Frame{.id = 1, .length = 8});
  for (int hub = 0; hub < 3; ++hub) {
    for (int i = 0; i < 20; ++i) {
      ASSERT_EQ(sender.send(burst), burst.size());
      serve();
      if (i % 4 == 0) delivered += receive(reader).size();
    }
    for (int i = 0; i < 3; ++i) {
      delivered += receive(reader).size();
      serve();
    }
    dropped += hub_->counters().dropped;
    EXPECT_EQ(reader.counters().rx_dropped_queue, dropped);
    EXPECT_EQ(delivered + dropped, static_cast<std::uint64_t>(hub + 1) * 1'000);
    start({.queue_bytes = 1});
    for (CanSocket* socket : {&sender, &reader}) {
      receive(*socket);
      socket->poll_drops();
    }
    serve();
  }
  EXPECT_GT(dropped, 1'000u);
  EXPECT_EQ(reader.counters().error_frames, 0u);
  EXPECT_EQ(reader.counters().received, delivered);
}

TEST_F(CanSocketOnUnixBus, AHubThatDoesNotReadIsAFullQueueThatIsSeen) {
  CanSocket sender = open(), reader = open();
  const std::vector<can::Frame> frames(2'000, can::Frame{.id = 2, .length = 8});
  const std::size_t taken = sender.send(frames);
  EXPECT_GT(taken, 100u);
  EXPECT_LT(taken, frames.size());
  EXPECT_EQ(sender.counters().sent, taken);
  EXPECT_EQ(sender.counters().tx_would_block, 1u);
  sender.poll_drops();
  EXPECT_GE(sender.queued_bytes(), taken * kCanWireBytes);
  serve();
  sender.poll_drops();
  EXPECT_EQ(sender.queued_bytes(), 0u);
  EXPECT_EQ(receive(reader).size(), taken);
}

TEST_F(CanSocketOnUnixBus, AHubThatGoesIsToldAtOnceAndOneThatComesIsFound) {
  CanSocket sender = open(), reader = open();
  ASSERT_TRUE(sender.send(can::Frame{.id = 3}));
  serve();
  ASSERT_TRUE(sender.send(can::Frame{.id = 4}));  // the hub dies with this one unread
  const int descriptor = reader.fd();
  hub_.reset();
  EXPECT_FALSE(reader.hung_up());
  EXPECT_EQ(receive(reader).size(), 1u);  // what it had put into the queue is not lost
  EXPECT_TRUE(reader.hung_up());
  EXPECT_EQ(reader.counters().hub_losses, 1u);
  EXPECT_FALSE(sender.send(can::Frame{.id = 5}));
  EXPECT_EQ(sender.counters().tx_network_down, 1u);
  EXPECT_TRUE(receive(sender).empty());
  EXPECT_TRUE(sender.hung_up());
  EXPECT_FALSE(sender.send(can::Frame{.id = 5}));
  EXPECT_FALSE(sender.send_error(CAN_ERR_BUSOFF));
  EXPECT_EQ(sender.counters().tx_network_down, 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(receive(reader).empty());
    reader.poll_drops();
  }
  EXPECT_EQ(reader.counters().hub_losses, 1u);
  EXPECT_EQ(reader.counters().hub_returns, 0u);
  start();
  for (CanSocket* socket : {&sender, &reader}) {
    socket->poll_drops();
    EXPECT_FALSE(socket->hung_up());
    EXPECT_EQ(socket->counters().hub_returns, 1u);
  }
  EXPECT_EQ(reader.fd(), descriptor);
  ASSERT_TRUE(sender.send(can::Frame{.id = 6}));
  serve();
  const auto after = receive(reader);
  ASSERT_EQ(after.size(), 1u);  // and nothing of before
  EXPECT_EQ(after[0].frame.id, 6u);
  EXPECT_EQ(reader.counters().rx_failed + sender.counters().rx_failed, 0u);
  EXPECT_EQ(sender.counters().tx_failed, 0u);
}

TEST_F(CanSocketOnUnixBus, NothingIsAllocatedWhileItRunsNorWhenTheHubGoesAndComes) {
  if (!testing::kAllocationsCounted) GTEST_SKIP() << "the address sanitizer has its own heap";
  CanSocket sender = open(), reader = open({.filters = {{.id = 1}}, .receive_own = true});
  std::vector<can::ReceivedFrame> frames(256);
  const std::vector<can::Frame> burst(100, can::Frame{.id = 1, .length = 8});
  const auto turn = [&] {
    for (CanSocket* socket : {&sender, &reader}) {
      socket->send(burst);
      socket->receive(frames);
      socket->poll_drops();
    }
  };
  EXPECT_EQ(testing::allocations_of(turn), 0u);
  serve();
  EXPECT_EQ(testing::allocations_of(turn), 0u);
  hub_.reset();
  EXPECT_EQ(testing::allocations_of(turn), 0u);
  ASSERT_TRUE(sender.hung_up() && reader.hung_up());
  start();
  EXPECT_EQ(testing::allocations_of(turn), 0u);
  EXPECT_FALSE(sender.hung_up() || reader.hung_up());
}

TEST_F(CanSocketOnUnixBus, WithoutAHubItDoesNotOpen) {
  hub_.reset();
  const auto socket = CanSocket::open(bus_);
  ASSERT_FALSE(socket);
  EXPECT_EQ(socket.error().place, bus_);
}

}  // namespace
}  // namespace pitwall::transport
