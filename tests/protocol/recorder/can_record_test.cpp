// SPDX-License-Identifier: Apache-2.0
#include "protocol/recorder/can_record.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace pitwall::recorder {
namespace {

TEST(CanRecord, AFrameOfAnyLengthComesBack) {
  for (std::size_t length = 0; length <= can::kMaxDataBytes; ++length) {
    can::Frame frame{.id = static_cast<std::uint32_t>(0x123 + length),
                     .extended = length % 2 == 1,
                     .remote = length % 3 == 1,
                     .fd = length > 8,
                     .length = static_cast<std::uint8_t>(length)};
    for (std::size_t i = 0; i < length; ++i) frame.data[i] = static_cast<std::uint8_t>(i * 7);
    CanBytes bytes{};
    CanRecord back;
    ASSERT_TRUE(recording::from_cdr(encode(frame, bytes), back)) << length;
    EXPECT_EQ(back.id, frame.id);
    EXPECT_EQ(back.extended, frame.extended);
    EXPECT_EQ(back.remote, frame.remote);
    EXPECT_EQ(back.fd, frame.fd);
    EXPECT_TRUE(std::ranges::equal(back.data.span(), frame.payload())) << length;
    EXPECT_EQ(decode_frame(encode(frame, bytes)).value(), frame);
  }
}

TEST(CanRecord, WhatIsNoFrameSaysWhy) {
  CanBytes bytes{};
  EXPECT_STREQ(decode_frame({}).error(), "CAN frame that cannot be read");
  for (const bool extended : {false, true}) {
    const std::uint32_t most = extended ? can::kMaxExtendedId : can::kMaxStandardId;
    EXPECT_TRUE(decode_frame(encode({.id = most, .extended = extended}, bytes)));
    EXPECT_STREQ(decode_frame(encode({.id = most + 1, .extended = extended}, bytes)).error(),
                 "CAN frame: identifier out of range");
  }
}

}  // namespace
}  // namespace pitwall::recorder
