// Decoder of CAN frames in packets of a SocketCAN capture, as libpcap records them.
//
//   227 CAN_SOCKETCAN   | identifier and flags, big endian | length | FD flags | 2 | data
//   113 LINUX_SLL       | packet type | 280 | .. | protocol 0x000C, 0x000D | as 227, but the
//   276 LINUX_SLL2      | protocol | 2 | interface index | ..                | order of the host
//
//   in     link type, one packet, byte order of the file, which is that of the recording host
//   out    a frame, with direction and interface if the header has them; or the kind error frame or
//          other protocol
//   errors the reason why it is not a valid CAN frame
//   source www.tcpdump.org/linktypes (CAN_SOCKETCAN, LINUX_SLL, LINUX_SLL2), Wireshark's
//          packet-socketcan.c
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "hil/replay/formats/can_log.hpp"

namespace pitwall::replay {

inline constexpr std::uint32_t kLinkTypeCan = 227, kLinkTypeSll = 113, kLinkTypeSll2 = 276;

enum class PacketKind : std::uint8_t { kFrame, kErrorFrame, kOther, kBad };

struct SocketCanPacket {
  PacketKind kind = PacketKind::kBad;
  LoggedFrame logged;
  std::optional<std::uint32_t> interface_index{};
  const char* why = "";  // reason of kBad
};

bool is_can_link_type(std::uint32_t link_type);
SocketCanPacket read_socketcan_packet(std::uint32_t link_type, std::string_view packet,
                                      bool is_big_endian_host);

}  // namespace pitwall::replay
