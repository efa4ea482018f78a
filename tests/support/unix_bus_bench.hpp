// Test bench of a Unix-socket CAN bus in one thread: the hub runs only when the test calls it, so
// that the test chooses every order and every loss.
//   in     a folder of its own
//   out    a hub at folder/bus; raw clients that write and read packets unchanged
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "protocol/transport/can/unix_bus.hpp"
#include "protocol/transport/can/unix_can_hub.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::testing {

using Packet = std::vector<std::uint8_t>;

inline Packet packet_of(const transport::CanWire& wire, std::size_t bytes) {
  Packet out(bytes);
  std::memcpy(out.data(), &wire, bytes);
  return out;
}

// A frame that carries a number, as a packet: classic or CAN FD.
inline Packet numbered(std::uint32_t id, std::uint32_t number, bool fd = false) {
  transport::CanWire wire{};
  wire.can_id = id;
  wire.len = 8;
  std::memcpy(wire.data, &number, sizeof number);
  return packet_of(wire, fd ? transport::kCanFdWireBytes : transport::kCanWireBytes);
}

inline transport::CanWire wire_of(const Packet& packet) {
  transport::CanWire out{};
  std::memcpy(&out, packet.data(), std::min(packet.size(), sizeof out));
  return out;
}

inline std::uint32_t number_in(const Packet& packet) {
  std::uint32_t out = 0;
  std::memcpy(&out, wire_of(packet).data, sizeof out);
  return out;
}

class RawClient {
 public:
  explicit RawClient(const std::string& bus,
                     transport::ReceiveMode mode = transport::ReceiveMode::kEverything) {
    const auto address = transport::unix_bus_address(bus);
    if (address) connected_ = transport::connect_to_hub(*address, mode, fd_).ok();
  }

  bool connected() const { return connected_; }
  int fd() const { return fd_.get(); }
  bool send(const Packet& packet) {
    return ::send(fd_.get(), packet.data(), packet.size(), MSG_DONTWAIT | MSG_NOSIGNAL) ==
           static_cast<ssize_t>(packet.size());
  }
  // Reads the waiting packets, at most `most`.
  std::vector<Packet> read(std::size_t most = SIZE_MAX) {
    std::vector<Packet> out;
    while (out.size() < most) {
      Packet packet(256);
      const ssize_t got = ::recv(fd_.get(), packet.data(), packet.size(), MSG_DONTWAIT);
      if (got <= 0) break;
      packet.resize(static_cast<std::size_t>(got));
      out.push_back(std::move(packet));
    }
    return out;
  }
  void leave() { fd_.reset(); }

 private:
  transport::FileDescriptor fd_;
  bool connected_ = false;
};

class UnixBusBench : public ::testing::Test {
 protected:
  void SetUp() override {
    auto folder = transport::TemporaryFolder::create("pitwall-unix-bus-");
    ASSERT_TRUE(folder);
    folder_ = std::make_unique<transport::TemporaryFolder>(*std::move(folder));
    bus_ = "unix:" + path();
    start();
  }

  void start(const transport::UnixCanHubOptions& options = {}) {
    hub_.reset();
    auto hub = transport::UnixCanHub::open(bus_, options);
    ASSERT_TRUE(hub) << to_string(hub.error());
    hub_ = *std::move(hub);
  }

  std::string path() const { return folder_->path() + "/bus"; }
  // Serves all waiting work and nothing later; the first round accepts the joining clients.
  void serve() {
    for (int round = 0; round < 3; ++round) {
      for (auto before = work(); hub_->serve(Instant{}), work() != before; before = work()) {
      }
    }
  }

  std::unique_ptr<transport::TemporaryFolder> folder_;
  std::string bus_;
  std::unique_ptr<transport::UnixCanHub> hub_;

 private:
  std::uint64_t work() const {
    const auto& c = hub_->counters();
    return c.relayed + c.malformed + c.joined + c.left + c.refused;
  }
};

}  // namespace pitwall::testing
