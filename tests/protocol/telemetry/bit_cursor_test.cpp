#include "protocol/telemetry/bit_cursor.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace pitwall::telemetry {
namespace {

TEST(BitCursor, MostSignificantBitFirst) {
  std::array<std::uint8_t, 2> bytes{};
  BitWriter out{bytes};
  out.put(0b101, 3);
  out.put(0b1, 1);
  out.put(0b00001111'0, 9);
  out.align();
  EXPECT_EQ(out.bytes(), 2U);
  EXPECT_EQ(bytes, (std::array<std::uint8_t, 2>{0b1011'0000, 0b11110'000}));
}

TEST(BitCursor, WhatIsWrittenInAnyWidthsIsRead) {
  std::uint64_t state = 88'172'645'463'325'252ULL;
  const auto next = [&] {
    state ^= state << 13U, state ^= state >> 7U, state ^= state << 17U;
    return state;
  };
  for (int round = 0; round < 200; ++round) {
    std::vector<std::pair<std::uint64_t, unsigned>> written;
    std::array<std::uint8_t, 1'000> bytes{};
    BitWriter out{bytes};
    for (int i = 0; i < 100; ++i) {
      const auto bits = static_cast<unsigned>(1 + next() % 57);
      const std::uint64_t value = next() & ((std::uint64_t{1} << bits) - 1);
      out.put(value, bits);
      written.emplace_back(value, bits);
    }
    out.align();
    BitReader in{std::span{bytes}.first(out.bytes())};
    for (const auto& [value, bits] : written) ASSERT_EQ(in.get(bits), value);
    EXPECT_EQ(in.rest_of_byte(), 0U);
    EXPECT_TRUE(in.ok());
  }
}

TEST(BitCursor, ReadingPastTheEndGivesZerosAndSaysSo) {
  const std::array<std::uint8_t, 1> bytes{0xFF};
  BitReader in{bytes};
  EXPECT_EQ(in.get(8), 0xFFU);
  EXPECT_TRUE(in.ok());
  EXPECT_EQ(in.get(8), 0U);
  EXPECT_FALSE(in.ok());
}

TEST(BitCursorDeath, AValueThatDoesNotFitOrNoRoomIsOurOwnMistake) {
  std::array<std::uint8_t, 1> bytes{};
  EXPECT_DEATH((BitWriter{bytes}.put(8, 3)), "CHECK failed");
  EXPECT_DEATH((BitWriter{bytes}.put(0, 16)), "CHECK failed");
}

}  // namespace
}  // namespace pitwall::telemetry
