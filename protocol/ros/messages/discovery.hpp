// Messages of the topic `ros_discovery_info`, in which each ROS 2 participant lists its nodes, so
// that `ros2 node list` shows them.
//   invariants
//          a Gid has 24 bytes up to Humble and 16 from Iron on, under the same type name, so the
//          two sides cannot read each other's message. The first 16 bytes are the GUID of the
//          endpoint
//   source ros2/rmw_dds_common: msg/{Gid,NodeEntitiesInfo,ParticipantEntitiesInfo}.msg, before and
//          after commit 5ab4f59
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/ros/message.hpp"

namespace pitwall::ros {

inline constexpr std::size_t kGidOfHumble = 24, kGidOfIron = 16;
inline constexpr std::size_t kNodeNameMax = 256;

template <std::size_t N>
struct Gid {
  std::array<std::uint8_t, N> data{};

  static constexpr std::string_view kType = "rmw_dds_common/msg/Gid";
  static constexpr auto members() { return std::tuple{field("data", &Gid::data)}; }
};

template <std::size_t N>
struct NodeEntitiesInfo {
  BoundedString<kNodeNameMax> node_namespace;
  BoundedString<kNodeNameMax> node_name;
  std::vector<Gid<N>> reader_gid_seq;
  std::vector<Gid<N>> writer_gid_seq;

  static constexpr std::string_view kType = "rmw_dds_common/msg/NodeEntitiesInfo";
  static constexpr auto members() {
    return std::tuple{field("node_namespace", &NodeEntitiesInfo::node_namespace),
                      field("node_name", &NodeEntitiesInfo::node_name),
                      field("reader_gid_seq", &NodeEntitiesInfo::reader_gid_seq),
                      field("writer_gid_seq", &NodeEntitiesInfo::writer_gid_seq)};
  }
};

template <std::size_t N>
struct ParticipantEntitiesInfo {
  Gid<N> gid;
  std::vector<NodeEntitiesInfo<N>> node_entities_info_seq;

  static constexpr std::string_view kType = "rmw_dds_common/msg/ParticipantEntitiesInfo";
  static constexpr auto members() {
    return std::tuple{
        field("gid", &ParticipantEntitiesInfo::gid),
        field("node_entities_info_seq", &ParticipantEntitiesInfo::node_entities_info_seq)};
  }
};

}  // namespace pitwall::ros
