// SPDX-License-Identifier: Apache-2.0
#include "protocol/recorder/raw_record.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/allocation_guard.hpp"

namespace pitwall::recorder {
namespace {

// The bytes that channels.hpp and every reader outside rely on.
TEST(RawRecord, ADatagramHasItsHeadAndItsBytes) {
  const std::vector<std::uint8_t> air{0xAA, 0xBB};
  DatagramBytes bytes{};
  const auto record = encode({.path = 1, .ip = 0x7F000001, .port = 23'431, .bytes = air}, bytes);
  const std::vector<std::uint8_t> wanted{1, 1, 0x87, 0x5B, 1, 0, 0, 0x7F, 0xAA, 0xBB};
  EXPECT_EQ(std::vector<std::uint8_t>(record.begin(), record.end()), wanted);
}

TEST(RawRecord, DecodingIsTheInverseForEveryLength) {
  std::vector<std::uint8_t> air;
  DatagramBytes bytes{};
  for (std::size_t length = 0; length <= kDatagramMax; length += 1 + length / 3) {
    air.resize(length, static_cast<std::uint8_t>(length));
    const RadioDatagram one{.path = static_cast<std::uint8_t>(length),
                            .ip = 0x0A000000U + static_cast<std::uint32_t>(length),
                            .port = static_cast<std::uint16_t>(65'535 - length),
                            .bytes = air};
    const auto back = decode_datagram(encode(one, bytes));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->path, one.path);
    EXPECT_EQ(back->ip, one.ip);
    EXPECT_EQ(back->port, one.port);
    EXPECT_TRUE(std::ranges::equal(back->bytes, air)) << length;
  }
}

TEST(RawRecord, WhatIsNoDatagramGivesNothing) {
  DatagramBytes bytes{};
  const auto record = encode({}, bytes);
  EXPECT_FALSE(decode_datagram(record.first(kDatagramHead - 1)));
  bytes[0] = 2;
  EXPECT_FALSE(decode_datagram(record));
}

TEST(RawRecord, WhatIsTooLongIsCutAndNothingIsAllocated) {
  const std::vector<std::uint8_t> air(kDatagramMax + 1, 7);
  DatagramBytes bytes{};
  std::size_t length = 0;
  EXPECT_EQ(testing::allocations_of([&] { length = encode({.bytes = air}, bytes).size(); }), 0U);
  EXPECT_EQ(length, bytes.size());
}

}  // namespace
}  // namespace pitwall::recorder
