// Where a replay sends the bytes of a receiver, as a command line writes it: in the words of the
// car's own `--receiver`, so that one string configures both ends.
//   in     "[udp:][ADDRESS:]PORT": datagrams are sent there
//          "tcp:[ADDRESS:]PORT": whoever connects to it gets the bytes, as with a real receiver
//          "serial:/dev/ttyUSB0[:BAUD]": the other end of the line
//   errors Problem with what was written
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "protocol/transport/stream/stream_link.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::replay {

inline constexpr int kReceiverBaud = 460'800;  // what the car takes where none is given

struct TcpPort {
  transport::TcpAddress local;

  bool operator==(const TcpPort&) const = default;
};
using ReceiverTarget = std::variant<transport::UdpAddress, TcpPort, transport::SerialDevice>;

Result<ReceiverTarget, Problem> parse_receiver_target(std::string_view text);
std::string to_string(const ReceiverTarget& target);

// Bytes of two receivers that go there would mix.
bool is_same_place(const ReceiverTarget& a, const ReceiverTarget& b);

}  // namespace pitwall::replay
