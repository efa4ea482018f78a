// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/socketcan_packet.hpp"

#include <algorithm>

#include "hil/replay/formats/byte_record.hpp"

namespace pitwall::replay {
namespace {

constexpr std::size_t kCanHeader = 8, kClassicPacket = 16, kFdPacket = 72;
constexpr std::size_t kSllHeader = 16, kSll2Header = 20;
constexpr std::uint16_t kProtocolCan = 0x000C, kProtocolFd = 0x000D;
constexpr std::uint8_t kSentByUs = 4;  // PACKET_OUTGOING
constexpr std::uint32_t kPacketExtended = 0x80000000, kPacketRemote = 0x40000000,
                        kPacketError = 0x20000000, kPacketId = 0x1FFFFFFF;
constexpr std::uint8_t kFdFrame = 0x04;  // CANFD_FDF
constexpr std::uint8_t kXlFrame = 0x80;  // in the place of the length: CANXL_XLF

SocketCanPacket bad(const char* why) {
  SocketCanPacket out;
  out.why = why;
  return out;
}

SocketCanPacket read_can(ByteRecord packet, std::optional<bool> says_fd) {
  if (packet.size() < kCanHeader) return bad("a packet that is shorter than the header of a frame");
  const std::uint32_t id = packet.u32(0);
  const std::uint8_t length = packet.u8(4), flags = packet.u8(5);
  if ((length & kXlFrame) != 0) return bad("CAN XL is not read, or the length is damaged");
  SocketCanPacket out;
  can::Frame& f = out.logged.frame;
  f.fd = says_fd.value_or((flags & kFdFrame) != 0 || packet.size() == kFdPacket);
  f.extended = (id & kPacketExtended) != 0;
  f.remote = (id & kPacketRemote) != 0;
  f.id = id & kPacketId;
  f.length = length;
  if (f.fd) out.logged.fd_flags = static_cast<std::uint8_t>(flags & 0x3U);
  const std::size_t room = packet.size() - kCanHeader;
  if (!f.remote && length > room) return bad("the packet is too short for its data");
  // A capture has the kernel's whole struct, or only the bytes in use.
  const std::size_t whole = f.fd ? kFdPacket : kClassicPacket;
  if (packet.size() != whole && room != length && !(f.remote && room == 0))
    return bad("the packet is longer than its frame");
  if (length > can::kMaxDataBytes) return bad("a frame of more than 64 bytes");
  if (!f.remote) std::copy_n(packet.bytes.begin() + kCanHeader, length, f.data.begin());
  out.kind = (id & kPacketError) != 0 ? PacketKind::kErrorFrame : PacketKind::kFrame;
  return out;
}

SocketCanPacket read_cooked(ByteRecord frame, std::uint16_t protocol, std::uint8_t type) {
  SocketCanPacket out;
  out.kind = PacketKind::kOther;
  if (protocol != kProtocolCan && protocol != kProtocolFd) return out;
  out = read_can(frame, protocol == kProtocolFd);
  out.logged.direction =
      type == kSentByUs ? LoggedDirection::kTransmitted : LoggedDirection::kReceived;
  return out;
}

}  // namespace

bool is_can_link_type(std::uint32_t link_type) {
  return link_type == kLinkTypeCan || link_type == kLinkTypeSll || link_type == kLinkTypeSll2;
}

SocketCanPacket read_socketcan_packet(std::uint32_t link_type, std::string_view bytes,
                                      bool is_big_endian_host) {
  const ByteRecord packet{bytes, true};
  if (link_type == kLinkTypeCan) return read_can(packet, std::nullopt);
  const bool is_second = link_type == kLinkTypeSll2;
  const std::size_t header = is_second ? kSll2Header : kSllHeader;
  if (packet.size() < header) return bad("a packet that is shorter than its header");
  const ByteRecord frame{bytes.substr(header), is_big_endian_host};
  if (!is_second)
    return read_cooked(frame, packet.u16(14), static_cast<std::uint8_t>(packet.u16(0)));
  SocketCanPacket out = read_cooked(frame, packet.u16(0), packet.u8(10));
  out.interface_index = packet.u32(4);
  return out;
}

}  // namespace pitwall::replay
