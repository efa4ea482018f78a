// IPv4 address and port of a datagram's sender or destination.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace pitwall {

inline constexpr std::uint32_t kLoopbackIp = 0x7F000001;  // 127.0.0.1

struct UdpAddress {
  std::uint32_t ip = kLoopbackIp;  // host byte order
  std::uint16_t port = 0;          // 0: not known; in bind(): the kernel chooses

  constexpr bool operator==(const UdpAddress&) const = default;
  constexpr bool known() const { return port != 0; }
};

inline std::string to_string(const UdpAddress& a) {
  std::string out;
  for (int shift = 24; shift >= 0; shift -= 8) {
    out += std::to_string((a.ip >> shift) & 0xFFU);
    out += shift == 0 ? ':' : '.';
  }
  return out + std::to_string(a.port);
}

}  // namespace pitwall
