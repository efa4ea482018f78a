// Link of one receiver to the computer, as a command line writes it.
//   in     "udp:[ADDRESS:]PORT" (received there; on loopback where no address of this computer is
//          given), "tcp:ADDRESS:PORT" (called there), "serial:/dev/ttyS0[:BAUD]"; of the two units
//          "0=..." and "1=..."
//   errors Problem with what was written
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

inline constexpr int kPortMax = 65'535;  // of a UDP or TCP port

// Enough for an IMU at 200 Hz beside everything else.
inline constexpr int kDefaultBaud = 460'800;

struct UdpReceiver {
  transport::UdpAddress local;
};
using ReceiverLink = std::variant<UdpReceiver, transport::TcpAddress, transport::SerialDevice>;
using ReceiverLinks = std::array<ReceiverLink, world::kGnssUnits>;

Result<ReceiverLink, Problem> parse_receiver_link(std::string_view text);
std::string to_string(const ReceiverLink& link);

// The links of all units from the words of --receiver ("UNIT=LINK") and the ports of --gnss; each
// unit once, and no two alike.
Result<ReceiverLinks, Problem> receiver_links(const std::vector<std::string>& words,
                                              const std::vector<std::uint16_t>& udp_ports);

}  // namespace pitwall::io
