// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/targets/receiver_target.hpp"

#include <charconv>

#include "protocol/transport/stream/serial_port.hpp"

namespace pitwall::replay {
namespace {

using transport::SerialDevice;
using transport::UdpAddress;

bool take_front(std::string_view& text, std::string_view front) {
  if (!text.starts_with(front)) return false;
  text.remove_prefix(front.size());
  return true;
}

Result<ReceiverTarget, Problem> serial_of(std::string_view whole, std::string_view text) {
  SerialDevice device{.path = std::string(text), .baud = kReceiverBaud};
  if (const std::size_t colon = text.rfind(':'); colon != std::string_view::npos) {
    const std::string_view rate = text.substr(colon + 1);
    const auto [end, error] = std::from_chars(rate.data(), rate.data() + rate.size(), device.baud);
    if (error != std::errc{} || end != rate.data() + rate.size())
      return refuse(whole, "\"" + std::string(rate) + "\" is not a baud rate");
    if (!transport::is_serial_rate(device.baud))
      return refuse(whole, "no tty has the rate " + std::string(rate));
    device.path = text.substr(0, colon);
  }
  if (!device.path.starts_with('/'))
    return refuse(whole, "expected the path of a device, as serial:/dev/ttyUSB0");
  return ReceiverTarget{std::move(device)};
}

}  // namespace

Result<ReceiverTarget, Problem> parse_receiver_target(std::string_view text) {
  std::string_view rest = text;
  if (take_front(rest, "serial:")) return serial_of(text, rest);
  const bool tcp = take_front(rest, "tcp:");
  if (!tcp) take_front(rest, "udp:");
  const auto address = transport::parse_udp_address(rest);
  if (!address || address->port == 0)
    return refuse(text,
                  "expected ADDRESS:PORT, tcp:ADDRESS:PORT (an IPv4 address and a port from 1 to "
                  "65535) or serial:/dev/DEVICE[:BAUD]");
  return tcp ? ReceiverTarget{TcpPort{*address}} : ReceiverTarget{*address};
}

std::string to_string(const ReceiverTarget& target) {
  if (const auto* udp = std::get_if<UdpAddress>(&target)) return transport::to_string(*udp);
  if (const auto* tcp = std::get_if<TcpPort>(&target))
    return "tcp:" + transport::to_string(tcp->local);
  const auto& device = std::get<SerialDevice>(target);
  return "serial:" + device.path + ":" + std::to_string(device.baud);
}

bool is_same_place(const ReceiverTarget& a, const ReceiverTarget& b) {
  const auto* one = std::get_if<SerialDevice>(&a);
  const auto* other = std::get_if<SerialDevice>(&b);
  if (one != nullptr && other != nullptr) return one->path == other->path;
  return a == b;
}

}  // namespace pitwall::replay
