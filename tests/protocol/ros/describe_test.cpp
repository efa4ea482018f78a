// SPDX-License-Identifier: Apache-2.0
#include "protocol/ros/describe.hpp"

#include <gtest/gtest.h>

#include "protocol/ros/cdr.hpp"
#include "tests/protocol/ros/sample_messages.hpp"
#include "tests/support/ros_oracle.hpp"

namespace pitwall::ros {
namespace {

template <class M>
std::string hash_of() {
  return type_hash(describe<M>());
}

// As ROS 2 Jazzy ships them in /opt/ros/jazzy/share/PACKAGE/msg/TYPE.json.
TEST(RosTypeHash, EqualsThePublicOnes) {
  EXPECT_EQ(hash_of<String>(),
            "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18");
  EXPECT_EQ(hash_of<Float32>(),
            "RIHS01_7170d3d8f841f7be3172ce5f4f59f3a4d7f63b0447e8b33327601ad64d83d6e2");
  EXPECT_EQ(hash_of<Time>(),
            "RIHS01_b106235e25a4c5ed35098aa0a61a3ee9c9b18d197f398b0e4206cea9acf9c197");
  EXPECT_EQ(hash_of<Header>(),
            "RIHS01_f49fb3ae2cf070f793645ff749683ac6b06203e41c891e17701b1cb597ce6a01");
  EXPECT_EQ(hash_of<PoseWithCovariance>(),
            "RIHS01_9a7c0fd234b7f45c6098745ecccd773ca1085670e64107135397aee31c02e1bb");
  EXPECT_EQ(hash_of<TwistWithCovariance>(),
            "RIHS01_49f574f033f095d8b6cd1beaca5ca7925e296e84af1716d16c89d38b059c8c18");
  EXPECT_EQ(hash_of<TFMessage>(),
            "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087");
  EXPECT_EQ(hash_of<Odometry>(),
            "RIHS01_3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0");
  EXPECT_EQ(hash_of<Path>(),
            "RIHS01_1957a5bb3cee5da65c4e52e52b65a93df227efce4c20f8458b36e73066ca334b");
  EXPECT_EQ(hash_of<NavSatStatus>(),
            "RIHS01_d1ed3befa628e09571bd273b888ba1c1fd187c9a5e0006b385d7e5e9095a3204");
  EXPECT_EQ(hash_of<NavSatFix>(),
            "RIHS01_62223ab3fe210a15976021da7afddc9e200dc9ec75231c1b6a557fc598a65404");
  EXPECT_EQ(hash_of<Imu>(),
            "RIHS01_7d9a00ff131080897a5ec7e26e315954b8eae3353c3f995c55faf71574000b5b");
  EXPECT_EQ(hash_of<Image>(),
            "RIHS01_d31d41a9a4c4bc8eae9be757b0beed306564f7526c88ea6a4588fb9582527d47");
  EXPECT_EQ(hash_of<PointCloud2>(),
            "RIHS01_9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5");
  EXPECT_EQ(hash_of<DiagnosticArray>(),
            "RIHS01_5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e");
}

TEST(RosTypeHash, ChangesWithEveryNameTypeAndOrderAndWithNothingElse) {
  const TypeDescription path = describe<Path>();
  const std::string hash = type_hash(path);
  TypeDescription other = path;
  other.type.constants.push_back({"uint8", "A", "1"});
  EXPECT_EQ(type_hash(other), hash);
  other = path, other.type.fields[1].name += "_";
  EXPECT_NE(type_hash(other), hash);
  other = path, std::swap(other.type.fields[0], other.type.fields[1]);
  EXPECT_NE(type_hash(other), hash);
  other = path, other.referenced.at("geometry_msgs/msg/Point").fields[0].type = TypeId::kFloat;
  EXPECT_NE(type_hash(other), hash);
}

TEST(RosMessageText, ACommentStandsBehindItsFieldAndTheHashDoesNotSeeIt) {
  TypeDescription header = describe<Header>();
  const std::string hash = type_hash(header);
  header.type.fields[1].comment = "of REP 105";
  EXPECT_EQ(file_text(header.type),
            "builtin_interfaces/Time stamp\nstring frame_id  # of REP 105\n");
  EXPECT_EQ(type_hash(header), hash);
}

TEST(RosMessageText, OfAMessageWithOthersInside) {
  EXPECT_EQ(message_text(describe<Header>()),
            "builtin_interfaces/Time stamp\n"
            "string frame_id\n"
            "================================================================================\n"
            "MSG: builtin_interfaces/Time\n"
            "int32 sec\n"
            "uint32 nanosec\n");
}

// Foxglove's libraries read our text, find in it what ROS 2 Jazzy has, and decode our bytes.
TEST(RosMessageText, FoxglovesReadersFindTheMessagesOfRosAndOurValues) {
  NEEDS_ORACLES();
  testing::Random random{3};
  pitwall::testing::RosOracle oracle;
  testing::for_each_message([&]<class M>() {
    for (int i = 0; i < 5; ++i) {
      M message;
      testing::fill(random, message);
      std::vector<std::uint8_t> bytes;
      encode(message, bytes);
      std::string output;
      testing::append_json(output, message);
      oracle.add(M::kType, message_text(describe<M>()), bytes, output);
    }
  });
  oracle.expect_agreement();
}

}  // namespace
}  // namespace pitwall::ros
