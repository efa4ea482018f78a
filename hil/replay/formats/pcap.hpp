// Reader of SocketCAN captures in the format of libpcap (tcpdump, Wireshark, dumpcap -P).
//
//   magic | version | zone, digits | snap length | link type | records: s, us or ns, lengths, data
//
//   in     the whole file, either byte order, microseconds or nanoseconds; link types of
//          socketcan_packet.hpp
//   out    CanLog; one channel can0, or with LINUX_SLL2 one for each interface index
//   errors an unreadable record is left out, and reading continues at the next place where two
//          records follow each other; a capture of another link type is refused
//   source IETF draft-ietf-opsawg-pcap
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "hil/replay/formats/can_log.hpp"

namespace pitwall::replay {

inline constexpr std::size_t kMaxPacketBytes = 262'144;  // largest packet that libpcap writes

Result<CanLog, Problem> read_pcap(std::string_view bytes, std::string_view file_name,
                                  const LogWatch& watch = {});

}  // namespace pitwall::replay
