// What holds on every kernel; the rest, on a real vcan0, is in tests/system/vcan.
// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/can_socket.hpp"

#include <gtest/gtest.h>

namespace pitwall::transport {
namespace {

TEST(CanSocketAnywhere, AnInterfaceThatIsNotThereIsAProblemWithItsName) {
  for (const std::string name : {"nosuchcan0", "", "a-name-that-is-far-too-long"}) {
    const auto socket = CanSocket::open(name);
    ASSERT_FALSE(socket.has_value());
    EXPECT_EQ(socket.error().place, name);
    const bool blames_kernel = socket.error().what.find("no CAN in this kernel") == 0;
    EXPECT_EQ(blames_kernel, !CanSocket::supported());
  }
}

}  // namespace
}  // namespace pitwall::transport
