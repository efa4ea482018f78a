// Destination of bytes in a replay: of a receiver, written as in the car's own option `--receiver`,
// so that one string configures both ends; or of a ROS 2 topic.
//   in     "[udp:][ADDRESS:]PORT": datagrams are sent there
//          "tcp:[ADDRESS:]PORT": a client that connects there gets the bytes, as from a real
//          receiver
//          "serial:/dev/ttyUSB0[:BAUD]": the other end of the line
//   errors Problem with the text as given
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "protocol/transport/stream/stream_link.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::replay {

struct TcpPort {
  transport::TcpAddress local;

  bool operator==(const TcpPort&) const = default;
};
// Names as in DDS.
struct RosTopic {
  std::string topic, type;

  bool operator==(const RosTopic&) const = default;
};
using ByteTarget = std::variant<UdpAddress, TcpPort, transport::SerialDevice, RosTopic>;

Result<ByteTarget, Problem> parse_receiver_target(std::string_view text);
// From topic and type as ROS 2 names them: "/imu", "sensor_msgs/msg/Imu".
Result<RosTopic, Problem> ros_topic(std::string_view topic, std::string_view type);
std::string to_string(const ByteTarget& target);

// True if the bytes of two receivers would mix there.
bool is_same_place(const ByteTarget& a, const ByteTarget& b);

}  // namespace pitwall::replay
