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
  }
}

}  // namespace
}  // namespace pitwall::recorder
