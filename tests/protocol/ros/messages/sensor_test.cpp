// SPDX-License-Identifier: Apache-2.0
#include "protocol/ros/messages/sensor.hpp"

#include <gtest/gtest.h>

#include "protocol/ros/cdr.hpp"
#include "protocol/ros/describe.hpp"

namespace pitwall::ros {
namespace {

// Counted by hand: the stamp, a frame of "gps" with its NUL, up to 2 and to 8.
TEST(RosSensor, AFixLiesWhereTheRulesOfCdrPutIt) {
  NavSatFix fix;
  fix.header.frame_id = "gps";
  fix.status = {.status = -1, .service = 9};
  fix.latitude = 1.0;
  fix.position_covariance_type = 3;
  std::vector<std::uint8_t> bytes;
  encode(fix, bytes);
  const std::size_t status = kCdrHeader + 8 + 4 + 4, latitude = kCdrHeader + 24;
  EXPECT_EQ(bytes[status], 0xFF);
  EXPECT_EQ(bytes[status + 2], 9);
  EXPECT_EQ(bytes[latitude + 7], 0x3F);
  EXPECT_EQ(bytes.size(), latitude + 3 * 8 + 9 * 8 + 1);
  EXPECT_EQ(bytes.back(), 3);
}

TEST(RosSensor, TheConstantsAreThoseOfTheMessageFiles) {
  const std::string text = message_text(describe<NavSatFix>());
  EXPECT_NE(text.find("int8 STATUS_NO_FIX=-1\n"), text.npos);
  EXPECT_NE(text.find("uint16 SERVICE_GALILEO=8\n"), text.npos);
  EXPECT_NE(text.find("uint8 COVARIANCE_TYPE_KNOWN=3\n"), text.npos);
}

}  // namespace
}  // namespace pitwall::ros
