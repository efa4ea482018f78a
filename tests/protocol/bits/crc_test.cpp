// SPDX-License-Identifier: Apache-2.0
#include "protocol/bits/crc.hpp"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace pitwall::bits {
namespace {

constexpr std::array<std::uint8_t, 9> kCheck{'1', '2', '3', '4', '5', '6', '7', '8', '9'};

// Check values of the CRC catalogue (reveng): CRC-32/ISO-HDLC, CRC-8/SAE-J1850, CRC-8/GSM-A,
// CRC-8/AUTOSAR, CRC-16/IBM-3740.
static_assert(crc32_ieee(kCheck) == 0xCBF43926);
static_assert(crc8_sae_j1850(kCheck) == 0x4B);
static_assert(crc8_j1850_from_zero(kCheck) == 0x37);
static_assert(crc8_h2f(kCheck) == 0xDF);
static_assert(crc16_ccitt_false(kCheck) == 0x29B1);

std::vector<std::uint8_t> noise(std::size_t size, std::uint64_t seed) {
  std::vector<std::uint8_t> bytes(size);
  for (auto& b : bytes) {
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    b = static_cast<std::uint8_t>(seed >> 56U);
  }
  return bytes;
}

// NovAtel's own code, "32-bit CRC" of the OEM7 manual, bit by bit.
std::uint32_t novatel_by_bit(std::span<const std::uint8_t> data) {
  std::uint32_t crc = 0;
  for (const std::uint8_t byte : data) {
    std::uint32_t low = (crc ^ byte) & 0xFFU;
    for (int j = 8; j > 0; --j) low = (low & 1U) != 0 ? (low >> 1U) ^ 0xEDB88320U : low >> 1U;
    crc = ((crc >> 8U) & 0x00FFFFFFU) ^ low;
  }
  return crc;
}

TEST(Crc, NovatelEqualsTheCodeOfTheManual) {
  for (std::size_t size = 0; size < 70; ++size) {
    const auto data = noise(size, size + 1);
    EXPECT_EQ(crc32_novatel(data), novatel_by_bit(data)) << size;
  }
}

// "#BESTPOSA,COM1,0,78.0,FINESTEERING,1427,325298.000,..." with its checksum, OEM manual example.
TEST(Crc, NovatelAgreesWithAPublishedLog) {
  constexpr std::string_view kLog =
      "BESTPOSA,COM1,0,78.0,FINESTEERING,1427,325298.000,00000000,6145,2748;SOL_COMPUTED,SINGLE,"
      "51.11678928753,-114.03886216575,1064.3470,-16.2708,WGS84,2.3434,1.3043,4.7300,\"\",0.000,0."
      "000,7,7,0,0,0,06,0,03";
  const std::vector<std::uint8_t> bytes(kLog.begin(), kLog.end());
  EXPECT_EQ(crc32_novatel(bytes), 0x9C9A92BBU);
}

TEST(Crc, PiecesGiveTheWhole) {
  const auto data = noise(200, 7);
  const std::span<const std::uint8_t> all{data};
  for (std::size_t cut = 0; cut <= data.size(); ++cut) {
    EXPECT_EQ(crc32_ieee(all.subspan(cut), crc32_ieee(all.first(cut))), crc32_ieee(all)) << cut;
    EXPECT_EQ(crc32_novatel(all.subspan(cut), crc32_novatel(all.first(cut))), crc32_novatel(all));
    const auto head = all.first(cut), tail = all.subspan(cut);
    EXPECT_EQ(crc8_sae_j1850(tail, crc8_sae_j1850(head)), crc8_sae_j1850(all));
    EXPECT_EQ(crc8_j1850_from_zero(tail, crc8_j1850_from_zero(head)), crc8_j1850_from_zero(all));
    EXPECT_EQ(crc8_h2f(tail, crc8_h2f(head)), crc8_h2f(all));
    EXPECT_EQ(crc16_ccitt_false(tail, crc16_ccitt_false(head)), crc16_ccitt_false(all));
  }
}

// Polynomial division, a bit at a time: a remainder of `width` bits.
std::uint32_t divided(std::span<const std::uint8_t> data, unsigned width, std::uint32_t polynomial,
                      std::uint32_t start) {
  std::uint32_t crc = start;
  for (const std::uint8_t byte : data) {
    for (int bit = 7; bit >= 0; --bit) {
      const bool carry = ((crc >> (width - 1) ^ static_cast<std::uint32_t>(byte) >> bit) & 1U) != 0;
      crc = (crc << 1U & ((1U << width) - 1)) ^ (carry ? polynomial : 0U);
    }
  }
  return crc;
}

TEST(Crc, TablesEqualTheDivision) {
  for (std::size_t size = 0; size < 70; ++size) {
    const auto data = noise(size, size + 1);
    EXPECT_EQ(crc8_sae_j1850(data), divided(data, 8, 0x1D, 0xFF) ^ 0xFFU);
    EXPECT_EQ(crc8_j1850_from_zero(data), divided(data, 8, 0x1D, 0));
    EXPECT_EQ(crc8_h2f(data), divided(data, 8, 0x2F, 0xFF) ^ 0xFFU);
    EXPECT_EQ(crc16_ccitt_false(data), divided(data, 16, 0x1021, 0xFFFF));
  }
}

TEST(Crc, NoSingleOrDoubleBitErrorPasses) {
  auto data = noise(12, 99);
  const auto c32 = crc32_ieee(data);
  const auto c16 = crc16_ccitt_false(data);
  const auto c8 = crc8_sae_j1850(data);
  const auto flip = [&](std::size_t bit) {
    data[bit / 8] = static_cast<std::uint8_t>(data[bit / 8] ^ (1U << (bit % 8)));
  };
  for (std::size_t a = 0; a < data.size() * 8; ++a) {
    flip(a);
    EXPECT_NE(crc8_sae_j1850(data), c8) << a;
    for (std::size_t b = a + 1; b < data.size() * 8; ++b) {
      flip(b);
      EXPECT_NE(crc32_ieee(data), c32) << a << " " << b;
      EXPECT_NE(crc16_ccitt_false(data), c16) << a << " " << b;
      flip(b);
    }
    flip(a);
  }
}

TEST(Crc, NothingHasAKnownValue) {
  EXPECT_EQ(crc32_ieee({}), 0U);
  EXPECT_EQ(crc32_novatel({}), 0U);
  EXPECT_EQ(crc8_sae_j1850({}), 0x00);
  EXPECT_EQ(crc8_j1850_from_zero({}), 0x00);
  EXPECT_EQ(crc8_h2f({}), 0x00);
  EXPECT_EQ(crc16_ccitt_false({}), 0xFFFF);
}

}  // namespace
}  // namespace pitwall::bits
