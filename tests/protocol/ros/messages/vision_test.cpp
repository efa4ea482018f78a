// SPDX-License-Identifier: Apache-2.0
#include "protocol/ros/messages/vision.hpp"

#include <gtest/gtest.h>

#include "protocol/ros/cdr.hpp"
#include "protocol/ros/describe.hpp"

namespace pitwall::ros {
namespace {

// As rosidl_generator_c of Jazzy has them in vision_msgs: names, types and order of every field,
// also of the messages inside.
TEST(RosVision, TheHashesAreThoseOfRosidl) {
  EXPECT_EQ(type_hash(describe<Detection3DArray>()),
            "RIHS01_793f5eab9595ac1c0da07873cc859db42eae51f0ee76056db8562515d830e018");
  EXPECT_EQ(type_hash(describe<Detection2DArray>()),
            "RIHS01_214274120007f4a683866481336b70310268cfa107aebe9d594a6acf75bda968");
}

// The least size of a detection is 100 bytes.
TEST(RosVision, MoreDetectionsThanTheBytesCanHoldAreRefusedByTheirCount) {
  std::vector<std::uint8_t> bytes;
  encode(Detection3DArray{}, bytes);
  constexpr std::size_t kCount = kCdrHeader + 16;  // behind the stamp and an empty frame
  ASSERT_EQ(bytes.size(), kCount + 4);
  bytes.resize(bytes.size() + 10'000);
  const auto refusal = [&](std::uint8_t count) {
    bytes[kCount] = count;
    const auto decoded = decode<Detection3DArray>(bytes);
    return decoded ? "none" : decoded.error().what;
  };
  EXPECT_EQ(refusal(101), "101 elements do not fit into 10000 bytes");
  EXPECT_TRUE(refusal(100).starts_with("ends ")) << "without the padding they would fit";
}

}  // namespace
}  // namespace pitwall::ros
