// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/arguments/receiver_link.hpp"

#include "protocol/transport/stream/serial_port.hpp"

namespace pitwall::io {
namespace {

constexpr std::string_view kForms =
    "not udp:[ADDRESS:]PORT, tcp:ADDRESS:PORT or serial:/dev/DEVICE[:BAUD]";

bool take_front(std::string_view& text, std::string_view front) {
  if (!text.starts_with(front)) return false;
  text.remove_prefix(front.size());
  return true;
}

Result<UdpAddress, Problem> address_of(std::string_view whole, std::string_view text) {
  const auto address = transport::parse_udp_address(text);
  if (!address) return refuse(whole, address.error().what);
  if (address->port == 0) return refuse(whole, "not a port between 1 and 65535");
  return *address;
}

Result<ReceiverLink, Problem> serial_of(std::string_view whole, std::string_view text) {
  auto device = transport::parse_serial_device(text);
  if (!device) return refuse(whole, device.error().what);
  return ReceiverLink{*std::move(device)};
}

bool is_unit(std::string_view word) {
  return word.size() == 1 && word[0] >= '0' &&
         static_cast<std::size_t>(word[0] - '0') < world::kGnssUnits;
}

}  // namespace

Result<ReceiverLink, Problem> parse_receiver_link(std::string_view text) {
  std::string_view rest = text;
  if (take_front(rest, "serial:")) return serial_of(text, rest);
  const bool udp = take_front(rest, "udp:");
  if (!udp && !take_front(rest, "tcp:")) return refuse(text, kForms);
  const auto address = address_of(text, rest);
  if (!address) return Unexpected{address.error()};
  return udp ? ReceiverLink{UdpReceiver{*address}} : ReceiverLink{*address};
}

std::string to_string(const ReceiverLink& link) {
  if (const auto* udp = std::get_if<UdpReceiver>(&link)) return "udp:" + to_string(udp->local);
  if (const auto* tcp = std::get_if<transport::TcpAddress>(&link)) return "tcp:" + to_string(*tcp);
  const auto& device = std::get<transport::SerialDevice>(link);
  return "serial:" + device.path + ":" + std::to_string(device.baud);
}

Result<ReceiverLinks, Problem> receiver_links(const std::vector<std::string>& words,
                                              const std::vector<std::uint16_t>& udp_ports) {
  std::array<std::optional<ReceiverLink>, world::kGnssUnits> given;
  for (std::size_t unit = 0; unit < std::min(udp_ports.size(), given.size()); ++unit)
    given[unit] = UdpReceiver{{.port = udp_ports[unit]}};
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos || !is_unit(std::string_view(word).substr(0, equals)))
      return refuse(word, "expected 0=LINK or 1=LINK");
    std::optional<ReceiverLink>& of_unit = given[static_cast<std::size_t>(word[0] - '0')];
    if (of_unit) return refuse(word, "this unit has a link already: " + to_string(*of_unit));
    auto link = parse_receiver_link(std::string_view(word).substr(equals + 1));
    if (!link) return Unexpected{link.error()};
    of_unit = *std::move(link);
  }
  for (std::size_t unit = 0; unit < given.size(); ++unit)
    if (!given[unit])
      return refuse("unit " + std::to_string(unit), "expected a link for this receiver");
  if (to_string(*given[0]) == to_string(*given[1]))
    return refuse(to_string(*given[0]), "the receivers need two different links");
  return ReceiverLinks{*given[0], *given[1]};
}

}  // namespace pitwall::io
