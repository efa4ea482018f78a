// SPDX-License-Identifier: Apache-2.0
#include "protocol/gnss/little_endian.hpp"

#include <gtest/gtest.h>

#include <array>

namespace pitwall::gnss {
namespace {

TEST(LittleEndian, LeastSignificantByteFirst) {
  std::array<std::uint8_t, 8> bytes{};
  ByteWriter w{bytes};
  w.put<std::uint32_t>(0x04030201);
  w.put<std::int16_t>(-2);
  EXPECT_EQ(bytes, (std::array<std::uint8_t, 8>{1, 2, 3, 4, 0xFE, 0xFF, 0, 0}));
}

TEST(LittleEndian, DoublesAreIeee754) {
  std::array<std::uint8_t, 8> bytes{};
  ByteWriter{bytes}.put(1.0);
  EXPECT_EQ(bytes, (std::array<std::uint8_t, 8>{0, 0, 0, 0, 0, 0, 0xF0, 0x3F}));
  EXPECT_EQ(ByteReader{bytes}.get<double>(), 1.0);
}

TEST(LittleEndian, ReadingPastTheEndGivesZeroAndSaysSo) {
  const std::array<std::uint8_t, 3> bytes{1, 2, 3};
  ByteReader in{bytes};
  EXPECT_EQ(in.get<std::uint16_t>(), 0x0201);
  EXPECT_TRUE(in.ok());
  EXPECT_EQ(in.get<std::uint32_t>(), 0U);
  EXPECT_FALSE(in.ok());
  EXPECT_EQ(in.get<std::uint8_t>(), 0U);
}

TEST(LittleEndianDeath, WritingPastTheEndIsOurOwnMistake) {
  std::array<std::uint8_t, 1> bytes{};
  EXPECT_DEATH(ByteWriter{bytes}.put<std::uint16_t>(1), "CHECK failed");
}

}  // namespace
}  // namespace pitwall::gnss
