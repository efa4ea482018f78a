// SPDX-License-Identifier: Apache-2.0
#include "protocol/bits/bit_reader.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "protocol/bits/bit_writer.hpp"

namespace pitwall::bits {
namespace {

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
