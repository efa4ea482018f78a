// What needs no CAN in the kernel; that a socket is bound is tested in tests/system/vcan.
// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/can/raw_can_socket.hpp"

#include <gtest/gtest.h>

namespace pitwall::transport {
namespace {

TEST(RawCanSocket, AnInterfaceThatIsNotThereIsAProblemWithItsName) {
  for (const std::string name : {"nosuchcan0", "", "a-name-that-is-far-too-long"}) {
    bool has_set_options = false;
    const auto socket = open_raw_can_socket(name, [&](int) {
      has_set_options = true;
      return PosixOutcome{.value = 0, .error = 0};
    });
    ASSERT_FALSE(socket.has_value());
    EXPECT_EQ(socket.error().place, name);
    EXPECT_EQ(socket.error().what.starts_with("no CAN in this kernel"), !has_can());
    EXPECT_FALSE(has_set_options);
  }
}

}  // namespace
}  // namespace pitwall::transport
