// The car's I/O and the guard, turned tick by tick against a controller that stalls, goes bus-off
// or only listens.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <string>
#include <vector>

#include "protocol/transport/can/can_interface.hpp"
#include "protocol/transport/clock.hpp"
#include "tests/support/in_time.hpp"
#include "tests/system/slcan/scripted_controller.hpp"
#include "vehicle/io/black_box.hpp"
#include "vehicle/io/car_io.hpp"
#include "vehicle/safety/bus_guard.hpp"

namespace pitwall::slcan {
namespace {

using testing::in_time;
using world::ControllerState;

constexpr Duration kTick = milliseconds(10);
constexpr std::uint32_t kIds[] = {0x58, 0x57, 0x59, 0x6F, 0x5A};  // brake first

can::Frame command(std::uint32_t id, std::uint32_t tick) {
  can::Frame frame;
  frame.id = id;
  frame.length = 4;
  for (unsigned i = 0; i < 4; ++i) frame.data[i] = static_cast<std::uint8_t>(tick >> (24 - 8 * i));
  return frame;
}

struct Received {
  std::uint32_t id = 0, tick = 0;
};

// "t" id length data, all hexadecimal: 3, 1, 8 digits.
Received parse(const std::string& line) {
  const auto number = [&](std::size_t from, std::size_t digits) {
    std::uint32_t value = 0;
    std::from_chars(line.data() + from, line.data() + from + digits, value, 16);
    return value;
  };
  return {number(1, 3), number(5, 8)};
}

class Transmit : public ::testing::Test {
 protected:
  void SetUp() override { set_up(false); }

  void set_up(bool listen_only) {
    car_io_.reset();
    controller_.reset();
    auto opened = ScriptedController::open();
    ASSERT_TRUE(opened) << to_string(opened.error());
    controller_ = *std::move(opened);
    auto interface = transport::CanInterface::open(controller_->interface());
    ASSERT_TRUE(interface) << to_string(interface.error());
    const auto problem = interface->configure({.bitrate = 500'000, .listen_only = listen_only});
    ASSERT_FALSE(problem) << to_string(*problem);
    io::Arguments args;
    args.can_interface = controller_->interface();
    auto car_io = io::CarIo::open(args);
    ASSERT_TRUE(car_io) << to_string(car_io.error());
    car_io_.emplace(*std::move(car_io));
  }

  // One tick of the car: hear, let the guard judge, send.
  safety::BusGuardOutput tick(bool may_restart) {
    next_ = std::max(next_ + kTick, transport::monotonic_now());
    transport::sleep_until(next_);
    const auto received = car_io_->read(box_);
    link_ = received.link;
    const Instant now = transport::monotonic_now();
    const auto out = safety::guard(params_, guard_, link_, false, now);
    std::vector<can::Frame> frames;
    for (const std::uint32_t id : kIds) frames.push_back(command(id, tick_));
    car_io_->write(frames, now);
    if (out.restart_now && may_restart) car_io_->restart_bus();
    ++tick_;
    return out;
  }
  template <class Until>
  bool run_until(Until&& until, int ticks = 1'000) {
    for (; ticks > 0; --ticks)
      if (until(tick(true))) return true;
    return false;
  }

  std::unique_ptr<ScriptedController> controller_;
  io::BlackBox box_;  // off
  std::optional<io::CarIo> car_io_;
  safety::BusGuardParams params_;
  safety::BusGuardState guard_;
  world::LinkObservation link_;
  Instant next_ = transport::monotonic_now();
  std::uint32_t tick_ = 1;
};

TEST_F(Transmit, WhatTheKernelTakesGoesOutInItsOrder) {
  for (int i = 0; i < 50; ++i) ASSERT_FALSE(tick(true).failed);
  std::vector<std::string> lines;
  const Instant limit = transport::monotonic_now() + seconds(10);
  while (lines.size() < car_io_->transmit().taken && transport::monotonic_now() < limit) {
    transport::sleep_until(transport::monotonic_now() + milliseconds(5));
    for (std::string& line : controller_->take_frames()) lines.push_back(std::move(line));
  }
  ASSERT_EQ(lines.size(), car_io_->transmit().taken);
  EXPECT_TRUE(in_time(lines.size() >= 5 * std::size(kIds)));
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Received received = parse(lines[i]);
    EXPECT_EQ(received.id, kIds[i % std::size(kIds)]);
    EXPECT_GE(received.tick, last);
    last = received.tick;
  }
  EXPECT_EQ(link_.controller, ControllerState::kActive);
  EXPECT_EQ(guard_.restarts_total, 0u);
}

// The controller's own buffer has one frame that nobody can take back; nothing else is old.
TEST_F(Transmit, AfterAStallOfASecondOnlyTheNewestCommandsGoOut) {
  for (int i = 0; i < 20; ++i) tick(false);
  controller_->listen(false);
  Duration longest{};
  for (int i = 0; i < 100; ++i) {
    tick(false);
    longest = std::max(longest, link_.tx_stalled);
  }
  EXPECT_GE(longest, milliseconds(500));  // the transmit watchdog saw it
  EXPECT_GT(car_io_->transmit().replaced, 50u);
  EXPECT_GT(car_io_->bus().flushes, 10u);
  const std::uint32_t resumed = tick_;
  static_cast<void>(controller_->take_frames());
  controller_->listen(true);
  for (int i = 0; i < 50; ++i) tick(false);
  transport::sleep_until(transport::monotonic_now() + milliseconds(50));
  const auto lines = controller_->take_frames();
  ASSERT_GT(lines.size(), 5u * std::size(kIds));
  std::map<std::uint32_t, std::uint32_t> newest;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const Received received = parse(lines[i]);
    // Given at most two ticks before it became stale, and another one until the queue was emptied.
    EXPECT_TRUE(in_time(received.tick + 4 >= resumed)) << "frame " << i << ": " << lines[i];
    EXPECT_GE(received.tick, newest[received.id]) << lines[i];
    newest[received.id] = received.tick;
  }
  for (int i = 0; i < 500 && link_.tx_stalled > Duration{}; ++i) tick(false);
  EXPECT_EQ(link_.tx_stalled, Duration{});
  const std::uint64_t dropped = car_io_->transmit().dropped();
  tick(false);
  EXPECT_EQ(link_.tx_drops, dropped);
}

TEST_F(Transmit, OneBusOffIsRestartedAndTheCarGoesOn) {
  for (int i = 0; i < 20; ++i) tick(true);
  controller_->say("sb256000\r");
  ASSERT_TRUE(run_until([&](const auto&) { return link_.controller == ControllerState::kBusOff; }));
  ASSERT_TRUE(run_until([&](const auto&) { return car_io_->bus().restarts == 1; }));
  ASSERT_TRUE(run_until([&](const auto&) { return link_.controller == ControllerState::kActive; }));
  static_cast<void>(controller_->take_frames());
  const std::uint32_t restarted = tick_;
  for (int i = 0; i < 50; ++i) ASSERT_FALSE(tick(true).failed);
  const auto lines = controller_->take_frames();
  ASSERT_GT(lines.size(), 5u * std::size(kIds));
  for (const std::string& line : lines)
    EXPECT_TRUE(in_time(parse(line).tick + 2 >= restarted)) << line;
  EXPECT_EQ(link_.restarts, 1u);
  EXPECT_EQ(guard_.restarts_total, 1u);
}

TEST_F(Transmit, BusOffAgainAndAgainIsRestartedThreeTimesAndThenNeverAgain) {
  while (controller_->opened() == 0) tick(true);
  const std::size_t opened = controller_->opened();
  controller_->answer_open("sb256000\r");
  controller_->say("sb256000\r");
  ASSERT_TRUE(run_until([](const auto& out) { return out.failed; }));
  for (int i = 0; i < 100; ++i) {
    const auto out = tick(true);
    ASSERT_TRUE(out.failed);
    ASSERT_FALSE(out.restart_now);
  }
  EXPECT_EQ(guard_.restarts_total, 3u);
  EXPECT_EQ(car_io_->bus().restarts, 3u);
  EXPECT_EQ(controller_->opened(), opened + 3);
  EXPECT_EQ(link_.controller, ControllerState::kBusOff);
}

// A bus on which nobody answers: the stall itself is the bus-off.
TEST_F(Transmit, AStallThatDoesNotEndIsTheLatchInTheEnd) {
  for (int i = 0; i < 10; ++i) tick(true);
  controller_->listen(false);
  EXPECT_TRUE(run_until([](const auto& out) { return out.failed; }));
  EXPECT_LE(guard_.restarts_total, 3u);
}

TEST_F(Transmit, AnUnpluggedInterfaceIsDownAndLatches) {
  for (int i = 0; i < 10; ++i) tick(true);
  controller_->unplug();
  EXPECT_TRUE(run_until([](const auto& out) { return out.failed; }));
  EXPECT_EQ(link_.controller, ControllerState::kDown);
  EXPECT_EQ(car_io_->bus().restarts, 0u);
  EXPECT_GT(car_io_->bus().restarts_refused, 0u);
  EXPECT_NE(std::string(car_io_->bus().refusal.data()).find("error: "), std::string::npos);
}

TEST_F(Transmit, FramesLostInTheControllerShowWithoutAFurtherFrame) {
  tick(true);
  controller_->say("e1o\re1o\r");
  EXPECT_TRUE(run_until([&](const auto&) { return link_.lost_in_interface == 2; }));
  EXPECT_EQ(link_.lost_in_socket, 0u);
  EXPECT_EQ(link_.error_frames, 2u);
}

TEST_F(Transmit, AnInterfaceThatOnlyListensIsNeverSentTo) {
  ASSERT_FALSE(car_io_->listen_only());
  set_up(true);
  EXPECT_TRUE(car_io_->listen_only());
  for (int i = 0; i < 30; ++i) tick(true);
  transport::sleep_until(transport::monotonic_now() + milliseconds(50));
  EXPECT_TRUE(controller_->take_frames().empty());
  EXPECT_EQ(car_io_->can().sent, 0u);
  EXPECT_EQ(car_io_->tx_drops(), 30u * std::size(kIds));
  EXPECT_EQ(guard_.restarts_total, 0u);
}

}  // namespace
}  // namespace pitwall::slcan
