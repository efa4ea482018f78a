// Network namespace with one TUN interface whose IP packets this process reads and writes, so that
// unmodified programs communicate over an emulated radio.
//   in     the interface's name, address and largest packet; whole IPv4 packets for the network
//   out    the IPv4 packets that processes inside the network send; others (IPv6) are skipped
//   invariants
//          the network lasts as long as this object or a process inside it. All traffic goes
//          through the interface, also multicast; except 127.0.0.0/8
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

  // Runs `work` with the calling thread inside the network. Sockets that it opens and processes
  // that it starts stay in that network.
  Result<bool, Problem> inside(const std::function<void()>& work) const;

  // The next waiting packet, without its frame; nullopt if none waits. Never blocks.
  std::optional<std::span<const std::uint8_t>> read(std::span<std::uint8_t> into);
  // False: refused by the kernel (its receive queue is full, or the bytes are not a packet).
  bool write(std::span<const std::uint8_t> packet);
  int fd() const { return tun_.get(); }

 private:
  TunNetwork(FileDescriptor network, FileDescriptor tun)
      : network_(std::move(network)), tun_(std::move(tun)) {}

  FileDescriptor network_, tun_;
};

}  // namespace pitwall::transport
