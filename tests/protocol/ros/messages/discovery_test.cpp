// SPDX-License-Identifier: Apache-2.0
#include "protocol/ros/messages/discovery.hpp"

#include <gtest/gtest.h>

#include "protocol/ros/cdr.hpp"
#include "protocol/ros/describe.hpp"

namespace pitwall::ros {
namespace {

// As `ros2 topic info -v /ros_discovery_info` shows it on Iron and Jazzy.
TEST(RosDiscovery, TheHashIsThatOfIronAndLater) {
  EXPECT_EQ(type_hash(describe<ParticipantEntitiesInfo<kGidOfIron>>()),
            "RIHS01_91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e");
}

TEST(RosDiscovery, NamesHaveABound) {
  EXPECT_TRUE(file_text(describe<NodeEntitiesInfo<kGidOfIron>>().type)
                  .starts_with("string<=256 node_namespace\nstring<=256 node_name\n"));
  NodeEntitiesInfo<kGidOfIron> node;
  for (const std::size_t length : {256U, 257U}) {
    node.node_name = std::string(length, 'a');
    std::vector<std::uint8_t> bytes;
    encode(node, bytes);
    EXPECT_EQ(decode<NodeEntitiesInfo<kGidOfIron>>(bytes).has_value(), length == 256);
  }
}

template <std::size_t N>
std::vector<std::uint8_t> some_bytes() {
  ParticipantEntitiesInfo<N> info;
  info.gid.data[0] = 1;
  NodeEntitiesInfo<N> node;
  node.node_name = "pitwall_base";
  node.writer_gid_seq.resize(2);
  info.node_entities_info_seq.push_back(node);
  std::vector<std::uint8_t> bytes;
  encode(info, bytes);
  return bytes;
}

TEST(RosDiscovery, TheTwoFormsDoNotReadEachOther) {
  EXPECT_TRUE(decode<ParticipantEntitiesInfo<kGidOfHumble>>(some_bytes<kGidOfHumble>()));
  EXPECT_TRUE(decode<ParticipantEntitiesInfo<kGidOfIron>>(some_bytes<kGidOfIron>()));
  EXPECT_FALSE(decode<ParticipantEntitiesInfo<kGidOfIron>>(some_bytes<kGidOfHumble>()));
  EXPECT_FALSE(decode<ParticipantEntitiesInfo<kGidOfHumble>>(some_bytes<kGidOfIron>()));
}

}  // namespace
}  // namespace pitwall::ros
