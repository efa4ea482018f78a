// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/station_addresses.hpp"

#include <algorithm>
#include <string_view>

#include "protocol/telemetry/session/association.hpp"

namespace pitwall::io {
namespace {

constexpr std::size_t kAddressesPerPathMax = 1 + telemetry::kSpares;
constexpr unsigned kFirstByte = 24;
constexpr std::uint32_t kLoopbackNet = 127;  // 127.0.0.0/8, RFC 1122 3.2.1.3

Unexpected<Problem> refuse_radio(std::string_view place, const std::string& what) {
  return Unexpected{Problem{"--radio " + std::string{place}, what}};
}

Result<UdpAddress, Problem> parse_address(std::string_view text) {
  if (text.find(':') == std::string_view::npos) {
    return refuse_radio(text, "has no port, expected ADDRESS:PORT with an IPv4 address");
  }
  const auto address = transport::parse_udp_address(text);
  if (!address) return refuse_radio(text, address.error().what + ", expected ADDRESS:PORT");
  if (address->port == 0)
    return refuse_radio(text, "the base station has no port, expected 1 to 65535");
  return address;
}

Result<StationAddresses, Problem> parse_list(const std::string& list) {
  StationAddresses addresses;
  for (std::string_view rest = list;;) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    const auto address = parse_address(rest.substr(0, comma));
    if (!address) return Unexpected{address.error()};
    addresses.push_back(*address);
    if (comma == rest.size()) break;
    rest.remove_prefix(comma + 1);
  }
  if (addresses.size() > kAddressesPerPathMax) {
    return refuse_radio(list, std::to_string(addresses.size()) + " addresses, expected one to " +
                                  std::to_string(kAddressesPerPathMax) + " of a path");
  }
  if (std::ranges::any_of(addresses, is_loopback) && !std::ranges::all_of(addresses, is_loopback)) {
    return refuse_radio(
        list,
        "loopback beside an address of another machine, expected all on this machine or "
        "none: one socket does not reach both");
  }
  return addresses;
}

}  // namespace

bool is_loopback(UdpAddress address) { return address.ip >> kFirstByte == kLoopbackNet; }

Result<std::vector<StationAddresses>, Problem> parse_station_addresses(
    std::span<const std::string> paths) {
  if (paths.empty() || paths.size() > telemetry::kPaths) {
    return Unexpected{Problem{"--radio", std::to_string(paths.size()) + " paths, expected one or " +
                                             std::to_string(telemetry::kPaths)}};
  }
  std::vector<StationAddresses> all;
  StationAddresses seen;
  for (const std::string& path : paths) {
    auto addresses = parse_list(path);
    if (!addresses) return Unexpected{addresses.error()};
    for (const UdpAddress& address : *addresses) {
      if (std::ranges::find(seen, address) != seen.end()) {
        return refuse_radio(to_string(address), "is named twice, expected each address once");
      }
      seen.push_back(address);
    }
    all.push_back(*std::move(addresses));
  }
  return all;
}

}  // namespace pitwall::io
