// SPDX-License-Identifier: Apache-2.0
#include "protocol/bits/bit_stream.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace pitwall::bits {
namespace {

constexpr std::array<std::uint8_t, 3> packed() {
  std::array<std::uint8_t, 3> out{};
  BitWriter w{out};
  w.write(0b101, 3);
  w.write(0b1'1100'0011, 9);
  w.write(1, 1);
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

struct Field {
  std::uint64_t value;
  unsigned bits;
};

std::vector<Field> random_fields(std::uint64_t seed) {
  std::vector<Field> fields;
  const auto next = [&] { return (seed = seed * 6364136223846793005ULL + 1442695040888963407ULL); };
  for (int i = 0; i < 40; ++i) {
    const auto bits = static_cast<unsigned>((next() >> 33U) % 65);
    const std::uint64_t noise = next() ^ next() >> 32U;
    fields.push_back({bits == 0 ? 0 : noise >> (64 - bits), bits});
  }
  return fields;
}

TEST(BitReader, GivesBackWhatWasWritten) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    std::array<std::uint8_t, 400> buffer{};
    buffer.fill(0xA5);
    BitWriter writer{buffer};
    const auto fields = random_fields(seed);
    for (const Field& f : fields) ASSERT_TRUE(writer.write(f.value, f.bits));
    const std::size_t payload = writer.bits();
    ASSERT_TRUE(writer.align());
    BitReader reader{std::span{buffer}.first(writer.bytes())};
    for (const Field& f : fields) EXPECT_EQ(reader.read(f.bits), f.value) << "seed " << seed;
    EXPECT_EQ(reader.bits_left(), 8 * writer.bytes() - payload);
    EXPECT_TRUE(reader.align());
    EXPECT_TRUE(reader.ok());
    EXPECT_EQ(reader.read(1), 0U);
    EXPECT_FALSE(reader.ok());
  }
}

TEST(BitReader, PastTheEndEverythingIsZero) {
  const std::array<std::uint8_t, 2> bytes{0xFF, 0xFF};
  BitReader reader{bytes};
  EXPECT_EQ(reader.read(9), 0x1FFU);
  EXPECT_EQ(reader.read(8), 0U);
  EXPECT_FALSE(reader.ok());
  EXPECT_EQ(reader.read(1), 0U);  // although seven bits are left
  EXPECT_FALSE(reader.align());
}

TEST(BitReader, PaddingThatIsNotZeroIsNoticed) {
  const std::array<std::uint8_t, 1> bytes{0b10100001};
  BitReader reader{bytes};
  EXPECT_EQ(reader.read(3), 5U);
  EXPECT_FALSE(reader.align());
}

}  // namespace
}  // namespace pitwall::bits
