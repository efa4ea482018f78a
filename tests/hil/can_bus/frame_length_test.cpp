// The oracle writes the frame as text, divides polynomials as on paper and inserts stuff bits one
// by one; it shares no code with the subject.
// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/frame_length.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/hil/can_bus/random_words.hpp"

namespace pitwall::can_bus {
namespace {

std::string binary(std::uint32_t value, int bits) {
  std::string text;
  for (int i = bits - 1; i >= 0; --i) text += ((value >> i) & 1U) != 0 ? '1' : '0';
  return text;
}

std::string crc_by_long_division(const std::string& message) {
  const std::string divisor = "1100010110011001";  // x^15 + 0x4599
  std::string rest = message + std::string(15, '0');
  for (std::size_t i = 0; i < message.size(); ++i) {
    if (rest[i] == '0') continue;
    for (std::size_t k = 0; k < divisor.size(); ++k)
      rest[i + k] = rest[i + k] == divisor[k] ? '0' : '1';
  }
  return rest.substr(message.size());
}

std::string stuffed(const std::string& bits) {
  std::string wire;
  for (const char bit : bits) {
    wire += bit;
    if (wire.size() >= 5 && wire.substr(wire.size() - 5) == std::string(5, bit))
      wire += bit == '0' ? '1' : '0';
  }
  return wire;
}

std::string header_and_data(const can::Frame& f) {
  std::string bits = "0";
  if (f.extended)
    bits +=
        binary(f.id >> 18, 11) + "11" + binary(f.id & 0x3FFFF, 18) + (f.remote ? "1" : "0") + "00";
  else
    bits += binary(f.id, 11) + (f.remote ? "1" : "0") + "00";
  bits += binary(f.length, 4);
  if (!f.remote)
    for (const std::uint8_t byte : f.payload()) bits += binary(byte, 8);
  return bits;
}

can::Frame random_frame(RandomWords& rng) {
  can::Frame f;
  f.extended = rng() % 4 == 0;
  f.id = rng() & (f.extended ? can::kMaxExtendedId : can::kMaxStandardId);
  f.length = static_cast<std::uint8_t>(rng() % 9);
  const std::uint32_t kind = rng() % 3;  // zeros and ones stuff most
  for (std::size_t i = 0; i < f.length; ++i)
    f.data[i] = static_cast<std::uint8_t>(kind == 0 ? 0 : kind == 1 ? 0xFF : rng());
  return f;
}

TEST(FrameLength, EqualsTheFrameWrittenOutBitByBit) {
  RandomWords rng{std::mt19937{1}};
  for (int i = 0; i < 100'000; ++i) {
    const can::Frame f = random_frame(rng);
    const std::string bits = header_and_data(f);
    const std::string crc = crc_by_long_division(bits);
    const std::string wire = stuffed(bits + crc);
    const FrameLength length = frame_length(f);
    ASSERT_EQ(binary(length.crc15, 15), crc) << "frame " << i;
    ASSERT_EQ(length.bits, wire.size() + 10 + 3) << "frame " << i;
    ASSERT_EQ(length.stuff_bits, wire.size() - bits.size() - 15) << "frame " << i;
  }
}

TEST(FrameLength, LiesBetweenTheUnstuffedAndTheWorstCase) {
  RandomWords rng{std::mt19937{2}};
  for (int i = 0; i < 50'000; ++i) {
    const can::Frame f = random_frame(rng);
    const std::uint32_t least = (f.extended ? 67U : 47U) + 8U * f.length;
    const std::uint32_t most = (f.extended ? 80U : 55U) + 10U * f.length;
    const FrameLength length = frame_length(f);
    ASSERT_EQ(length.bits - length.stuff_bits, least);
    ASSERT_GE(length.bits, least);
    ASSERT_LE(length.bits, most);
  }
}

TEST(FrameLength, ItsOracleHasThePublishedCheckValue) {
  // CRC-15/CAN in the catalogue of parametrised CRC algorithms: 0x059E for "123456789".
  std::string bits;
  for (const char c : std::string("123456789")) bits += binary(static_cast<std::uint8_t>(c), 8);
  EXPECT_EQ(crc_by_long_division(bits), binary(0x059E, 15));
}

TEST(FrameLength, ARemoteFrameCarriesNoData) {
  can::Frame f;
  f.id = 0x555;
  f.remote = true;
  f.length = 8;
  const FrameLength length = frame_length(f);
  EXPECT_EQ(length.bits - length.stuff_bits, 47U);
}

TEST(ArbitrationKey, OrdersAsTheWiredAndOfTheBitsDoes) {
  // The oracle compares the arbitration fields as text, dominant '0' first.
  const auto field = [](const can::Frame& f) {
    const std::string r = f.remote ? "1" : "0";
    return f.extended ? binary(f.id >> 18, 11) + "11" + binary(f.id & 0x3FFFF, 18) + r
                      : binary(f.id, 11) + r + "0" + std::string(19, '0');
  };
  RandomWords rng{std::mt19937{3}};
  for (int i = 0; i < 100'000; ++i) {
    can::Frame a = random_frame(rng), b = random_frame(rng);
    if (rng() % 2 == 0) b.id = b.extended ? (a.id << 18) & can::kMaxExtendedId : a.id & 0x7FF;
    a.remote = rng() % 2 == 0;
    b.remote = rng() % 2 == 0;
    ASSERT_EQ(arbitration_key(a) < arbitration_key(b), field(a) < field(b));
  }
}

}  // namespace
}  // namespace pitwall::can_bus
