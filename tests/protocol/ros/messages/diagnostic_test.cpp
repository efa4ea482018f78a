// SPDX-License-Identifier: Apache-2.0
#include "protocol/ros/messages/diagnostic.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "protocol/ros/cdr.hpp"
#include "protocol/ros/describe.hpp"

namespace pitwall::ros {
namespace {

// rosidl's `byte` is an octet, not a uint8: other text, other hash, the same bytes.
TEST(RosDiagnostic, TheLevelIsAByte) {
  const TypeDescription type = describe<DiagnosticStatus>();
  EXPECT_EQ(type.type.fields.front().type, TypeId::kByte);
  EXPECT_NE(message_text(type).find("byte STALE=3\n"), std::string::npos);
  DiagnosticStatus status;
  status.level = Byte{3};
  status.name = "a";
  std::vector<std::uint8_t> bytes;
  encode(status, bytes);
  const std::vector<std::uint8_t> begins{0, 1, 0, 0, 3, 0, 0, 0, 2, 0, 0, 0, 'a', 0};
  EXPECT_TRUE(std::equal(begins.begin(), begins.end(), bytes.begin()));
}

}  // namespace
}  // namespace pitwall::ros
