// SPDX-License-Identifier: Apache-2.0
#include "protocol/bits/bit_writer.hpp"

#include <gtest/gtest.h>

#include <array>

namespace pitwall::bits {
namespace {

constexpr std::array<std::uint8_t, 3> packed() {
  std::array<std::uint8_t, 3> out{};
  BitWriter w{out};
  w.write(0b101, 3);
  w.write(0b1'1100'0011, 9);
  w.write_flag(true);
  w.align();
  return out;
}
// By hand: 101 111000011 1 000, then nothing.
static_assert(packed() == std::array<std::uint8_t, 3>{0b10111100, 0b00111000, 0});

TEST(BitWriter, NeverWritesPastItsBuffer) {
  for (unsigned size = 0; size <= 9; ++size) {
    for (unsigned bits = 1; bits <= 64; ++bits) {
      std::array<std::uint8_t, 10> memory{};
      memory.fill(0x5A);
      BitWriter w{std::span{memory}.first(size)};
      std::size_t written = 0;
      while (w.write(1, bits)) written += bits;
      EXPECT_EQ(written, 8 * size / bits * bits);
      EXPECT_EQ(w.bits(), written);
      EXPECT_FALSE(w.ok());
      EXPECT_FALSE(w.write(0, 0));
      for (std::size_t i = size; i < memory.size(); ++i) EXPECT_EQ(memory[i], 0x5A);
    }
  }
}

TEST(BitWriterDeathTest, AValueWiderThanItsFieldIsOurMistake) {
  std::array<std::uint8_t, 4> memory{};
  BitWriter w{memory};
  EXPECT_DEATH(w.write(4, 2), "CHECK");
  EXPECT_DEATH(w.write(0, 65), "CHECK");
}

}  // namespace
}  // namespace pitwall::bits
