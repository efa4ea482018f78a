// TCP server on loopback for tests: one client, to which the test sends bytes.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstdint>
#include <span>

#include "protocol/transport/posix_call.hpp"
#include "protocol/transport/udp_socket.hpp"

namespace pitwall::support {

class TcpServer {
 public:
  TcpServer()
      : listener_(transport::posix_call(
            [] { return ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0); })) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(kLoopbackIp);
    auto* generic = reinterpret_cast<sockaddr*>(&address);
    socklen_t length = sizeof address;
    EXPECT_EQ(::bind(listener_.get(), generic, sizeof address), 0);
    EXPECT_EQ(::listen(listener_.get(), 1), 0);
    EXPECT_EQ(getsockname(listener_.get(), generic, &length), 0);
    port_ = ntohs(address.sin_port);
  }
  std::uint16_t port() const { return port_; }
  // Waits until the client connects.
  void accept() {
    client_ = transport::FileDescriptor(
        transport::posix_call([&] { return ::accept(listener_.get(), nullptr, nullptr); }));
  }
  void say(std::span<const std::uint8_t> bytes) const {
    EXPECT_EQ(::send(client_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL), std::ssize(bytes));
  }

 private:
  transport::FileDescriptor listener_, client_;
  std::uint16_t port_ = 0;
};

}  // namespace pitwall::support
