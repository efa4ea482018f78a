// Reader of SocketCAN captures in pcapng (Wireshark, dumpcap, tshark).
//
//   type | length | body | length          0x0A0D0D0A section, 1 interface, 2, 3 and 6 packets
//
//   in     the whole file; sections of either byte order; link types of socketcan_packet.hpp
//   out    CanLog; channels named like the interfaces, else can0 and up; directions if the capture
//          has them. Packets of other link types are counted as other records
//   errors an unreadable block is left out, and reading continues at the next place where a block
//          has the same length at its beginning and its end
//   source IETF draft-ietf-opsawg-pcapng
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "hil/replay/formats/can_log.hpp"

namespace pitwall::replay {

Result<CanLog, Problem> read_pcapng(std::string_view bytes, std::string_view file_name,
                                    const LogWatch& watch = {});

}  // namespace pitwall::replay
