// Writer of CAN logs as SocketCAN captures: pcap, or pcapng with channel names and directions.
//   in     frames with stamps up to 2106 for pcap
//   out    bytes, little endian; pcap in microseconds, or in nanoseconds if a stamp has more
//          digits; pcapng in nanoseconds. Frames are whole structs of the kernel, 16 or 72 bytes
//   invariants
//          read_pcap(), read_pcapng() read the same frames; pcap has one channel and no direction
//   source IETF draft-ietf-opsawg-pcap, draft-ietf-opsawg-pcapng; linktype 227
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/replay/formats/can_log.hpp"

namespace pitwall::replay {

inline constexpr std::int64_t kMaxPcapSeconds = 0xFFFFFFFF;

std::string to_pcap(const CanLog& log);
std::string to_pcapng(const CanLog& log);

}  // namespace pitwall::replay
