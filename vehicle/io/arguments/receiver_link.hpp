// Link of one receiver to the computer, as written on a command line.
//   in     "udp:[ADDRESS:]PORT" (local socket; loopback unless an address of this computer is
//          given), "tcp:ADDRESS:PORT" (connects to it), "serial:/dev/ttyS0[:BAUD]"; with the unit:
//          "0=..." and "1=..."
//   out    the link
//   errors Problem with the text as place
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "protocol/transport/stream/stream_link.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::io {

inline constexpr int kPortMax = 65'535;  // largest UDP or TCP port

struct UdpReceiver {
  UdpAddress local;
};
using ReceiverLink = std::variant<UdpReceiver, transport::TcpAddress, transport::SerialDevice>;
using ReceiverLinks = std::array<ReceiverLink, world::kGnssUnits>;

Result<ReceiverLink, Problem> parse_receiver_link(std::string_view text);
std::string to_string(const ReceiverLink& link);

// Links of all units from the arguments of --receiver ("UNIT=LINK") and the ports of --gnss. Each
// unit must be given once, and all links must differ.
Result<ReceiverLinks, Problem> receiver_links(const std::vector<std::string>& words,
                                              const std::vector<std::uint16_t>& udp_ports);

}  // namespace pitwall::io
