// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/native_bus.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "protocol/transport/can/raw_can_socket.hpp"

namespace pitwall::can_bus {
namespace {

TEST(NativeBus, TheLoopbackExistsAndNonsenseDoesNot) {
  EXPECT_TRUE(interface_exists("lo"));
  for (const char* name : {"", "nosuchcan0", "../net/lo", "lo/mtu"})
    EXPECT_FALSE(interface_exists(name)) << name;
}

TEST(NativeBus, AKernelWithoutCanIsAProblemNotASilence) {
  if (transport::has_can()) {
    // Nothing to make: nothing that could go wrong.
    EXPECT_FALSE(bring_up({}).has_value());
    return;
  }
  const std::vector<std::string> names{"vcan0"};
  for (const auto& problem : {bring_up(names), take_down(names)}) {
    ASSERT_TRUE(problem.has_value());
    EXPECT_EQ(problem->place, "kernel");
    EXPECT_NE(problem->what.find("no CAN"), std::string::npos);
  }
}

TEST(NativeBus, AnInterfaceWithoutAControllerIsNotTouched) {
  const std::vector<std::string> names{"lo"};
  const auto problem = bring_up(names, {.bitrate = 500'000});
  ASSERT_TRUE(problem.has_value());
  EXPECT_EQ(problem->place, "lo");
  EXPECT_NE(problem->what.find("no CAN controller"), std::string::npos);
}

TEST(NativeBus, TheStatusNamesWhatMatters) {
  transport::CanInterfaceStatus status;
  EXPECT_EQ(status_text("can0", status), "can0: is gone\n");
  status.exists = status.up = status.has_controller = status.listen_only = true;
  status.state = transport::BusState::kBusOff;
  status.bitrate = 1'000'000;
  status.bus_offs = 4;
  const std::string text = status_text("can0", status);
  for (const char* part : {"can0: up, but not running", "bus-off", "1000000 bit/s", "listen-only",
                           "not by itself", "bus-off 4"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  status.has_controller = false;
  EXPECT_NE(status_text("vcan0", status).find("none (a virtual"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::can_bus
