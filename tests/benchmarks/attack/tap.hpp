// Copy of a radio datagram for an eavesdropper, with its direction and sender.
//   wire   u8 direction (1: the car's, 0: the base's), sender's ip u32 and port u16, little endian;
//          then the datagram
//   in     any bytes
//   out    a Copy; its bytes point into the input
//   errors read_copy() returns an empty optional for fewer than kCopyFront bytes
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "protocol/transport/udp_socket.hpp"

namespace pitwall::attack {

inline constexpr std::size_t kCopyFront = 7;

struct Copy {
  bool from_car = false;
  UdpAddress sender;
  std::span<const std::uint8_t> bytes;
};

inline void write_copy(const Copy& copy, std::vector<std::uint8_t>& out) {
  out.assign(1, copy.from_car ? 1 : 0);
  for (unsigned i = 0; i < 4; ++i)
    out.push_back(static_cast<std::uint8_t>(copy.sender.ip >> 8 * i));
  for (unsigned i = 0; i < 2; ++i)
    out.push_back(static_cast<std::uint8_t>(copy.sender.port >> 8 * i));
  out.insert(out.end(), copy.bytes.begin(), copy.bytes.end());
}

inline std::optional<Copy> read_copy(std::span<const std::uint8_t> wire) {
  if (wire.size() < kCopyFront) return std::nullopt;
  Copy copy{.from_car = wire[0] == 1, .sender = {.ip = 0}, .bytes = wire.subspan(kCopyFront)};
  for (unsigned i = 0; i < 4; ++i) copy.sender.ip |= std::uint32_t{wire[1 + i]} << 8 * i;
  copy.sender.port = static_cast<std::uint16_t>(wire[5] | wire[6] << 8);
  return copy;
}

}  // namespace pitwall::attack
