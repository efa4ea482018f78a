// What the kernel tells of a controller, heard by CanSocket and CanInterface: both must agree with
// each other and with `ip`. Runs where slcan is (see CMakeLists.txt).
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "hil/can_bus/memory_bus.hpp"
#include "protocol/transport/can/can_interface.hpp"
#include "protocol/transport/can/can_socket.hpp"
#include "protocol/vocabulary/text.hpp"
#include "tests/support/comes_true.hpp"
#include "tests/system/slcan/scripted_controller.hpp"

namespace pitwall::slcan {
namespace {

using testing::comes_true;
using transport::BusState;
using transport::CanInterface;
using transport::CanSocket;

std::string output_of(const std::string& command) {
  std::string out;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return out;
  std::array<char, 4'096> text;
  while (std::fgets(text.data(), text.size(), pipe) != nullptr) out += text.data();
  ::pclose(pipe);
  return out;
}

class Controller : public ::testing::Test {
 protected:
  void SetUp() override {
    auto opened = ScriptedController::open();
    ASSERT_TRUE(opened) << to_string(opened.error());
    controller_ = *std::move(opened);
    auto interface = CanInterface::open(controller_->interface());
    ASSERT_TRUE(interface) << to_string(interface.error());
    interface_.emplace(*std::move(interface));
    const auto problem = interface_->configure({.bitrate = 500'000});
    ASSERT_FALSE(problem) << to_string(*problem);
    auto socket = CanSocket::open(controller_->interface());
    ASSERT_TRUE(socket) << to_string(socket.error());
    socket_.emplace(*std::move(socket));
    ASSERT_TRUE(comes_true([&] { return controller_->opened() == 1; }));
  }

  std::size_t receive() {
    std::vector<can::ReceivedFrame> frames(64);
    return socket_->receive(frames);
  }
  const transport::CanInterfaceStatus& status() {
    EXPECT_TRUE(interface_->refresh());
    return interface_->status();
  }

  std::unique_ptr<ScriptedController> controller_;
  std::optional<CanInterface> interface_;
  std::optional<CanSocket> socket_;
};

TEST_F(Controller, ErrorFramesInterfaceAndIpAgreeOnEveryState) {
  struct Say {
    const char* words;
    BusState state;
    const char* ip;
  };
  for (const Say& say : std::vector<Say>{{"sw096000\r", BusState::kWarning, "ERROR-WARNING"},
                                         {"sp000128\r", BusState::kPassive, "ERROR-PASSIVE"},
                                         {"sw000100\r", BusState::kWarning, "ERROR-WARNING"},
                                         {"sa000010\r", BusState::kActive, "ERROR-ACTIVE"},
                                         {"sb256000\r", BusState::kBusOff, "BUS-OFF"}}) {
    controller_->say(say.words);
    EXPECT_TRUE(comes_true([&] {
      receive();
      return socket_->bus_state() == say.state;
    })) << say.words;
    EXPECT_EQ(status().state, say.state) << say.words;
    EXPECT_GT(socket_->bus_state_at(), Instant{});
    const std::string ip = output_of("ip -details link show " + controller_->interface());
    EXPECT_NE(ip.find(say.ip), std::string::npos) << ip;
    EXPECT_NE(ip.find("bitrate 500000"), std::string::npos) << ip;
  }
  EXPECT_EQ(status().bitrate, 500'000u);
  EXPECT_EQ(status().warnings, 1u);  // the kernel counts the way up only
  EXPECT_EQ(status().passives, 1u);
  EXPECT_EQ(status().bus_offs, 1u);
  EXPECT_FALSE(status().running);  // a controller that is off has no carrier
  EXPECT_EQ(socket_->counters().errors.bus_off, 1u);
  EXPECT_EQ(socket_->counters().error_frames, 5u);
}

TEST_F(Controller, BusErrorsAndOverrunsAreCountedByTheirKind) {
  controller_->say("e1a\re2bs\re1o\r");
  EXPECT_TRUE(comes_true([&] {
    receive();
    return socket_->counters().error_frames == 3;
  }));
  EXPECT_EQ(socket_->counters().errors.no_acknowledgement, 1u);
  EXPECT_GE(socket_->counters().errors.protocol, 1u);
  EXPECT_EQ(socket_->counters().errors.controller, 1u);
  EXPECT_EQ(status().rx_over_errors, 1u);  // lost in the controller: the interface alone can tell
  EXPECT_EQ(status().lost(), 1u);
  EXPECT_EQ(socket_->counters().rx_dropped_queue, 0u);
  EXPECT_EQ(socket_->bus_state(), BusState::kUnknown);  // none of them tells a state
}

TEST_F(Controller, FramesComeAndGo) {
  controller_->say("t12381122334455667788\rt7FF0\r");
  std::vector<can::ReceivedFrame> frames(8);
  std::size_t count = 0;
  EXPECT_TRUE(comes_true([&] {
    count += socket_->receive(std::span(frames).subspan(count));
    return count == 2;
  }));
  EXPECT_EQ(frames[0].frame.id, 0x123u);
  EXPECT_EQ(frames[0].frame.data[7], 0x88u);
  EXPECT_EQ(frames[1].frame.id, 0x7FFu);
  EXPECT_EQ(frames[1].frame.length, 0u);
  ASSERT_TRUE(socket_->send(frames[0].frame));
  std::vector<std::string> sent;
  EXPECT_TRUE(comes_true([&] {
    for (std::string& line : controller_->take_frames()) sent.push_back(std::move(line));
    return !sent.empty();
  }));
  EXPECT_EQ(sent, std::vector<std::string>{"t12381122334455667788"});
}

// Without the slots: what a plain writer meets. Everything that the queue held goes out afterwards.
TEST_F(Controller, AFullQueueIsEnobufsAndWhatItHoldsIsKnown) {
  controller_->listen(false);
  can::Frame frame;
  frame.id = 0x55;
  frame.length = 1;
  std::size_t taken = 0;
  while (taken < 100 && socket_->send(frame)) ++taken;
  EXPECT_EQ(taken, status().tx_queue_frames + 2);  // one in the line, one in the driver's hands
  EXPECT_EQ(socket_->counters().tx_enobufs, 1u);
  socket_->poll_drops();
  EXPECT_GT(socket_->queued_bytes(), 0u);
  const auto problem = interface_->flush();
  EXPECT_FALSE(problem) << to_string(*problem);
  socket_->poll_drops();
  EXPECT_EQ(socket_->queued_bytes(), 0u);
  EXPECT_TRUE(status().plain_queue);
  // A second time and a third: the first one made a queue, the others replace it.
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(socket_->send(frame));
    const auto again = interface_->flush();
    EXPECT_FALSE(again) << to_string(*again);
    socket_->poll_drops();
    EXPECT_EQ(socket_->queued_bytes(), 0u);
  }
  controller_->listen(true);
  std::size_t received = 0;
  EXPECT_TRUE(comes_true([&] {
    received += controller_->take_frames().size();
    return received == 1;  // that of the line; the others are gone
  }));
  ASSERT_TRUE(socket_->send(frame));
  EXPECT_TRUE(comes_true([&] { return controller_->take_frames().size() == 1; }))
      << output_of("ip -s -d link show " + controller_->interface() + "; tc -s qdisc show dev " +
                   controller_->interface());
}

TEST_F(Controller, WhatTheDriverCannotIsSaidInItsWords) {
  const auto refused = interface_->configure({.restart_ms = 100});
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->place, controller_->interface());
  EXPECT_NE(refused->what.find("restart-ms refused"), std::string::npos) << refused->what;
  EXPECT_FALSE(status().up);
  EXPECT_FALSE(interface_->configure({.listen_only = true}));
  EXPECT_TRUE(status().listen_only && status().up);
  EXPECT_FALSE(interface_->configure({.listen_only = false, .tx_queue_frames = 33}));
  EXPECT_FALSE(status().listen_only);
  EXPECT_EQ(status().tx_queue_frames, 33u);
}

TEST_F(Controller, ARestartEndsBusOffWhereTheDriverCannotRestart) {
  controller_->say("sb256000\r");
  EXPECT_TRUE(comes_true([&] { return status().state == BusState::kBusOff; }));
  const auto problem = interface_->restart();
  EXPECT_FALSE(problem) << to_string(*problem);
  EXPECT_EQ(status().state, BusState::kActive);
  EXPECT_TRUE(status().up && status().running);
  EXPECT_TRUE(comes_true([&] { return controller_->opened() == 2; }));
}

// Letter of slcan and the state of the kernel for a state of the bench's node.
struct ModelledState {
  char letter;
  BusState state;
};
ModelledState modelled(can_bus::ErrorState state) {
  switch (state) {
    case can_bus::ErrorState::kActive:
      return {'a', BusState::kActive};
    case can_bus::ErrorState::kWarning:
      return {'w', BusState::kWarning};
    case can_bus::ErrorState::kPassive:
      return {'p', BusState::kPassive};
    case can_bus::ErrorState::kBusOff:
      break;
  }
  return {'b', BusState::kBusOff};
}

// The bench's bus in memory and the kernel hear of the same errors: they come to the same
// states, neither sends in bus-off, and both are back after a restart alone.
TEST_F(Controller, TheBenchsNodeGoesThroughTheStatesOfTheKernels) {
  can_bus::MemoryBus bus{{.ports = 2}};
  bus.damage_transmitter(0, 1.0);
  can::Frame frame;
  frame.id = 0x100;
  Instant now = Instant{} + seconds(1);
  ASSERT_TRUE(bus.offer(0, frame, now));
  std::vector<can_bus::ErrorState> passed{bus.status(0).state};
  while (passed.back() != can_bus::ErrorState::kBusOff && now < Instant{} + seconds(2)) {
    bus.advance(now += microseconds(2));
    const can_bus::PortStatus node = bus.status(0);
    if (node.state == passed.back()) continue;
    passed.push_back(node.state);
    const ModelledState reported = modelled(node.state);
    controller_->say(
        formatted("s%c%03u%03u\r", reported.letter, node.receive_errors, node.send_errors));
    EXPECT_TRUE(comes_true([&] { return status().state == reported.state; })) << reported.letter;
  }
  EXPECT_EQ(passed.size(), 4U) << "active, warning, passive, bus-off";
  EXPECT_FALSE(bus.offer(0, frame, now));
  EXPECT_FALSE(status().running) << "without a carrier the kernel sends nothing either";
  bus.damage_transmitter(0, 0.0);
  bus.advance(now += seconds(1));
  EXPECT_EQ(bus.status(0).state, can_bus::ErrorState::kBusOff) << "nobody restarted it";
  EXPECT_EQ(status().state, BusState::kBusOff);
  EXPECT_TRUE(bus.restart(0, now));
  const auto problem = interface_->restart();
  EXPECT_FALSE(problem) << to_string(*problem);
  bus.advance(now += milliseconds(10));
  EXPECT_EQ(bus.status(0).state, can_bus::ErrorState::kActive);
  EXPECT_EQ(status().state, BusState::kActive);
  EXPECT_TRUE(bus.offer(0, frame, now));
  EXPECT_TRUE(comes_true([&] { return controller_->opened() == 2; }));
  EXPECT_TRUE(comes_true([&] { return socket_->send(frame); }));
  EXPECT_TRUE(comes_true([&] { return controller_->take_frames().size() == 1; }));
}

TEST_F(Controller, AnUnpluggedOneIsGone) {
  controller_->unplug();
  EXPECT_TRUE(comes_true([&] { return !status().exists; }));
  EXPECT_FALSE(status().up);
  EXPECT_TRUE(interface_->restart());
}

}  // namespace
}  // namespace pitwall::slcan
