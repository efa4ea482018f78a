// A network of its own with one interface (TUN) whose IP packets we read and write ourselves: how
// programs that know nothing of it are made to talk over an emulated radio.
//   in     the interface's name, address and largest packet; whole IPv4 packets for the network
//   out    the IPv4 packets that somebody inside the network sends; others (IPv6) are passed over
//   invariants
//          the network lasts as long as this object or a process inside it. Everything goes through
//          the interface: multicast too, but for 127.0.0.0/8
//   errors create(): Problem that names what the kernel refused; needs CAP_SYS_ADMIN and
//          CAP_NET_ADMIN (root) and /dev/net/tun
//   source Linux networking/tuntap.rst, network_namespaces(7)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::transport {

struct TunPlan {
  std::string name = "radio0";
  std::uint32_t address = 0;  // host byte order
  unsigned prefix_bits = 24;
  int largest_packet = 1'500;
};

class TunNetwork {
 public:
  static Result<TunNetwork, Problem> create(const TunPlan& plan);

  // Does the work with the calling thread inside the network: the sockets that it opens and the
  // processes that it starts belong there for good.
  Result<bool, Problem> inside(const std::function<void()>& work) const;

  // The next packet that waits, without its frame; none: nothing waits. Never blocks.
  std::optional<std::span<const std::uint8_t>> read(std::span<std::uint8_t> into);
  // False: refused by the kernel (its receive queue is full, or it is no packet).
  bool write(std::span<const std::uint8_t> packet);
  int fd() const { return tun_.get(); }

 private:
  TunNetwork(FileDescriptor network, FileDescriptor tun)
      : network_(std::move(network)), tun_(std::move(tun)) {}

  FileDescriptor network_, tun_;
};

}  // namespace pitwall::transport
