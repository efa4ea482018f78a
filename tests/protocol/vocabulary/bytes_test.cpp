// SPDX-License-Identifier: Apache-2.0
#include "protocol/vocabulary/bytes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace pitwall {
namespace {

using Buffer = std::array<std::uint8_t, 12>;
constexpr std::uint8_t kBeside = 0xA5;

// `size` bytes from `at` on are those of the value, and those beside them are as before.
void expect_stored(const Buffer& bytes, std::size_t at, std::size_t size, std::uint64_t value) {
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const bool inside = i >= at && i < at + size;
    EXPECT_EQ(bytes[i], inside ? static_cast<std::uint8_t>(value >> (8 * (i - at))) : kBeside);
  }
}

template <class T>
void expect_round_trip(T value) {
  for (std::size_t at = 0; at + sizeof(T) <= Buffer{}.size(); ++at) {
    Buffer bytes;
    bytes.fill(kBeside);
    store(bytes, at, value);
    EXPECT_EQ(load<T>(bytes, at), value);
    expect_stored(bytes, at, sizeof(T), value);
  }
}

TEST(Bytes, ANumberHasItsLeastSignificantByteFirstAndNothingBeside) {
  expect_round_trip<std::uint8_t>(0x81);
  expect_round_trip<std::uint16_t>(0x8102);
  expect_round_trip<std::uint32_t>(0x81020304);
  expect_round_trip<std::uint64_t>(0x8102030405060708);
  expect_round_trip(std::numeric_limits<std::uint64_t>::max());
}

TEST(Bytes, ANumberOfAnyLengthKeepsItsLowBytes) {
  constexpr std::uint64_t kValue = 0x8102030405060708;
  for (std::size_t size = 0; size <= sizeof kValue; ++size) {
    Buffer bytes;
    bytes.fill(kBeside);
    const auto part = std::span(bytes).subspan(2, size);
    store(part, kValue);
    expect_stored(bytes, 2, size, kValue);
    EXPECT_EQ(load(part), size == sizeof kValue ? kValue : kValue % (1ULL << (8 * size)));
  }
}

}  // namespace
}  // namespace pitwall
