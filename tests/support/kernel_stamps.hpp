// Wait until the kernel stamps datagrams on arrival. It begins to do so some time after the first
// socket asked for it (a work queue switches it on); until then a datagram is stamped when it is
// read, and the stamps of two sockets have the order of reading.
//   out    a socket that keeps the stamps switched on; keep it until the end of the test
//   errors fails the test after kTries
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <array>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/udp_socket.hpp"

namespace pitwall::testing {

inline transport::UdpSocket await_kernel_stamps() {
  constexpr int kTries = 1'000;
  constexpr Duration kUnread = milliseconds(5);
  auto socket = *transport::UdpSocket::bind({});
  for (int i = 0; i < kTries; ++i) {
    const Instant before = transport::monotonic_now();
    EXPECT_TRUE(socket.send_to(socket.local(), std::array<std::uint8_t, 1>{}));
    transport::sleep_until(before + kUnread);
    std::array<transport::UdpDatagram, 1> datagram;
    const bool read = socket.receive(datagram) == 1;
    if (read && datagram[0].at - before < kUnread / 2) return socket;
  }
  ADD_FAILURE() << "the kernel stamps no datagram on arrival";
  return socket;
}

}  // namespace pitwall::testing
