// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/targets/byte_target.hpp"

#include <algorithm>

#include "protocol/ros/names.hpp"
#include "protocol/transport/stream/serial_port.hpp"

namespace pitwall::replay {
namespace {

using transport::SerialDevice;

bool take_front(std::string_view& text, std::string_view front) {
  if (!text.starts_with(front)) return false;
  text.remove_prefix(front.size());
  return true;
}

Result<ByteTarget, Problem> serial_of(std::string_view whole, std::string_view text) {
  auto device = transport::parse_serial_device(text);
  if (!device) return refuse(whole, device.error().what);
  return ByteTarget{*std::move(device)};
}

bool is_ros_type(std::string_view type) {
  return std::ranges::count(type, '/') == 2 && type.find("//") == std::string_view::npos &&
         !type.starts_with('/') && !type.ends_with('/');
}

}  // namespace

Result<ByteTarget, Problem> parse_receiver_target(std::string_view text) {
  std::string_view rest = text;
  if (take_front(rest, "serial:")) return serial_of(text, rest);
  const bool tcp = take_front(rest, "tcp:");
  if (!tcp) take_front(rest, "udp:");
  const auto address = transport::parse_udp_address(rest);
  if (!address || address->port == 0)
    return refuse(text,
                  "expected ADDRESS:PORT, tcp:ADDRESS:PORT (an IPv4 address and a port from 1 to "
                  "65535) or serial:/dev/DEVICE[:BAUD]");
  return tcp ? ByteTarget{TcpPort{*address}} : ByteTarget{*address};
}

Result<RosTopic, Problem> ros_topic(std::string_view topic, std::string_view type) {
  if (!is_ros_type(type))
    return refuse(topic, "expected a type of ROS 2, as sensor_msgs/msg/Imu, instead of \"" +
                             std::string(type) + "\"");
  auto name = ros::dds_topic(topic);
  if (!name) return Unexpected{name.error()};
  return RosTopic{*std::move(name), ros::dds_type(type)};
}

std::string to_string(const ByteTarget& target) {
  if (const auto* ros = std::get_if<RosTopic>(&target)) return ros->topic;
  if (const auto* udp = std::get_if<UdpAddress>(&target)) return to_string(*udp);
  if (const auto* tcp = std::get_if<TcpPort>(&target)) return "tcp:" + to_string(tcp->local);
  const auto& device = std::get<SerialDevice>(target);
  return "serial:" + device.path + ":" + std::to_string(device.baud);
}

bool is_same_place(const ByteTarget& a, const ByteTarget& b) {
  const auto* one = std::get_if<SerialDevice>(&a);
  const auto* other = std::get_if<SerialDevice>(&b);
  if (one != nullptr && other != nullptr) return one->path == other->path;
  return a == b;
}

}  // namespace pitwall::replay
