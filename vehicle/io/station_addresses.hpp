// Addresses of the base stations by radio path, from --radio.
//   in     one text per path, "ADDRESS:PORT[,ADDRESS:PORT...]", the preferred address first, then
//          those of standby base stations
//   out    the addresses in that order
//   errors Problem with --radio and the address or list as place: no path or too many, no IPv4
//          address, no port, too many addresses of one path, an address given twice, loopback
//          together with other addresses of a path (one socket does not reach both)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::io {

using StationAddresses = std::vector<UdpAddress>;

Result<std::vector<StationAddresses>, Problem> parse_station_addresses(
    std::span<const std::string> paths);

// Whether the address is on the loopback interface.
bool is_loopback(UdpAddress address);

}  // namespace pitwall::io
