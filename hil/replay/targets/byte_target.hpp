// Where a replay sends bytes: those of a receiver, as a command line writes it, in the words of the
// car's own `--receiver`, so that one string configures both ends; or those of a ROS 2 topic.
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
// By its names in DDS.
struct RosTopic {
  std::string topic, type;

  bool operator==(const RosTopic&) const = default;
};
using ByteTarget = std::variant<transport::UdpAddress, TcpPort, transport::SerialDevice, RosTopic>;

Result<ByteTarget, Problem> parse_receiver_target(std::string_view text);
// Of a topic and its type as ROS 2 calls them: "/imu", "sensor_msgs/msg/Imu".
Result<RosTopic, Problem> ros_topic(std::string_view topic, std::string_view type);
std::string to_string(const ByteTarget& target);

// Bytes of two receivers that go there would mix.
bool is_same_place(const ByteTarget& a, const ByteTarget& b);

}  // namespace pitwall::replay
