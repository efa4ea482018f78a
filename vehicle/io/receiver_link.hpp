// How the bytes of one receiver reach the computer, as a person writes it.
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

#include "protocol/transport/stream_link.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::io {

// Enough for an IMU at 200 Hz beside everything else.
inline constexpr int kDefaultBaud = 460'800;

struct UdpIntake {
  transport::UdpAddress local;
};
using ReceiverLink = std::variant<UdpIntake, transport::TcpAddress, transport::SerialDevice>;
using ReceiverLinks = std::array<ReceiverLink, world::kGnssUnits>;

Result<ReceiverLink, Problem> parse_receiver_link(std::string_view text);
std::string to_string(const ReceiverLink& link);

// The links of all units from the words of --receiver ("UNIT=LINK") and the ports of --gnss; each
// unit once, and no two alike.
Result<ReceiverLinks, Problem> receiver_links(const std::vector<std::string>& words,
                                              const std::vector<std::uint16_t>& udp_ports);

}  // namespace pitwall::io
