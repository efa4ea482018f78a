// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/ros_message.hpp"

#include <algorithm>
#include <array>

#include "protocol/ros/cdr.hpp"
#include "protocol/ros/messages/nav.hpp"
#include "protocol/ros/messages/sensor.hpp"
#include "protocol/ros/messages/std.hpp"

namespace pitwall::traffic {
namespace {

struct ClassicCan {
  ros::Header header;
  std::uint32_t id = 0;
  bool is_rtr = false, is_extended = false, is_error = false;
  std::uint8_t dlc = 0;
  std::array<std::uint8_t, 8> data{};

  static constexpr std::string_view kType = "can_msgs/msg/Frame";
  static constexpr auto members() {
    return std::tuple{ros::field("header", &ClassicCan::header),
                      ros::field("id", &ClassicCan::id),
                      ros::field("is_rtr", &ClassicCan::is_rtr),
                      ros::field("is_extended", &ClassicCan::is_extended),
                      ros::field("is_error", &ClassicCan::is_error),
                      ros::field("dlc", &ClassicCan::dlc),
                      ros::field("data", &ClassicCan::data)};
  }
};

struct FdCan {
  ros::Header header;
  std::uint32_t id = 0;
  bool is_extended = false, is_error = false;
  std::uint8_t len = 0;
  std::vector<std::uint8_t> data;  // at most 64

  static constexpr std::string_view kType = "ros2_socketcan_msgs/msg/FdFrame";
  static constexpr auto members() {
    return std::tuple{ros::field("header", &FdCan::header),
                      ros::field("id", &FdCan::id),
                      ros::field("is_extended", &FdCan::is_extended),
                      ros::field("is_error", &FdCan::is_error),
                      ros::field("len", &FdCan::len),
                      ros::field("data", &FdCan::data)};
  }
};

constexpr bool is_fd_length(std::size_t n) {
  return n <= 8 || n == 12 || n == 16 || n == 20 || n == 24 || n == 32 || n == 48 || n == 64;
}

Unexpected<std::string> no(std::string_view type, std::string_view what) {
  return {std::string{type}.append(": ").append(what)};
}

template <class M>
std::optional<std::string> fault_in(Bytes cdr) {
  const auto message = ros::decode<M>(cdr);
  if (message) return std::nullopt;
  return std::string{M::kType}.append(" that cannot be read");
}

// CDR of either version and byte order, as plain structs or parameter lists.
bool is_encapsulated(Bytes cdr) {
  constexpr std::uint8_t kLastRepresentation = 0x0B;
  return cdr.size() >= ros::kCdrHeader && cdr[0] == 0 && cdr[1] <= kLastRepresentation;
}

Result<RosCanFrame, std::string> frame_of(const ClassicCan& message) {
  if (message.dlc > message.data.size()) return no(ClassicCan::kType, "more than 8 bytes");
  RosCanFrame out{.frame = {.id = message.id,
                            .extended = message.is_extended,
                            .remote = message.is_rtr,
                            .length = message.dlc},
                  .is_error = message.is_error};
  if (!message.is_rtr) std::copy_n(message.data.begin(), message.dlc, out.frame.data.begin());
  return out;
}

Result<RosCanFrame, std::string> frame_of(const FdCan& message) {
  if (!is_fd_length(message.len) || message.len > message.data.size())
    return no(FdCan::kType, "length that CAN FD has not");
  RosCanFrame out{.frame = {.id = message.id,
                            .extended = message.is_extended,
                            .remote = false,
                            .fd = true,
                            .length = message.len},
                  .is_error = message.is_error};
  std::copy_n(message.data.begin(), message.len, out.frame.data.begin());
  return out;
}

template <class M>
Result<RosCanFrame, std::string> read_as(Bytes cdr) {
  const auto message = ros::decode<M>(cdr);
  if (!message) return no(M::kType, "message that cannot be read");
  const std::uint32_t most = message->is_extended ? can::kMaxExtendedId : can::kMaxStandardId;
  if (!message->is_error && message->id > most) return no(M::kType, "identifier out of range");
  return frame_of(*message);
}

}  // namespace

bool is_ros_can(std::string_view type) { return type == ClassicCan::kType || type == FdCan::kType; }

Result<RosCanFrame, std::string> read_ros_can(std::string_view type, Bytes cdr) {
  return type == FdCan::kType ? read_as<FdCan>(cdr) : read_as<ClassicCan>(cdr);
}

std::optional<std::string> fault_of(std::string_view type, Bytes cdr) {
  if (!is_encapsulated(cdr)) return "ROS 2 message that is not CDR";
  if (type == ros::NavSatFix::kType) return fault_in<ros::NavSatFix>(cdr);
  if (type == ros::Imu::kType) return fault_in<ros::Imu>(cdr);
  if (type == ros::Odometry::kType) return fault_in<ros::Odometry>(cdr);
  if (type == ros::PointCloud2::kType) return fault_in<ros::PointCloud2>(cdr);
  return std::nullopt;
}

}  // namespace pitwall::traffic
