// SPDX-License-Identifier: Apache-2.0
#include "hil/guest/native_bus.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "protocol/transport/can_socket.hpp"

namespace pitwall::guest {
namespace {

TEST(NativeBus, TheLoopbackExistsAndNonsenseDoesNot) {
  EXPECT_TRUE(interface_exists("lo"));
  for (const char* name : {"", "nosuchcan0", "../net/lo", "lo/mtu"})
    EXPECT_FALSE(interface_exists(name)) << name;
}

TEST(NativeBus, AKernelWithoutCanIsAProblemNotASilence) {
  if (transport::CanSocket::supported()) {
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

}  // namespace
}  // namespace pitwall::guest
