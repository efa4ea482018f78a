// What can be said without booting; a booted guest is tested in tests/system/vcan.
// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/guest.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace pitwall::can_bus {
namespace {

TEST(Guest, NothingToRunIsAProblem) {
  const auto guest = Guest::boot({});
  ASSERT_FALSE(guest.has_value());
  EXPECT_EQ(guest.error().what, "no command to run");
}

TEST(Guest, AMachineWithoutUserModeLinuxSaysSo) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/no/such/folder", 1);
  const auto obstacle = guest_obstacle();
  const auto guest = Guest::boot({.command = {"true"}});
  setenv("PATH", path.c_str(), 1);
  ASSERT_TRUE(obstacle.has_value());
  EXPECT_EQ(obstacle->place, "linux.uml");
  ASSERT_FALSE(guest.has_value());
  EXPECT_EQ(guest.error().place, "linux.uml");
}

}  // namespace
}  // namespace pitwall::can_bus
