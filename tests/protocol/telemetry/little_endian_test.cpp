// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/little_endian.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace pitwall::telemetry {
namespace {

using Buffer = std::array<std::uint8_t, 12>;

template <class T>
void expect_round_trip(T value) {
  for (std::size_t at = 0; at + sizeof(T) <= Buffer{}.size(); ++at) {
    Buffer bytes;
    bytes.fill(0xA5);
    store(std::span<std::uint8_t>{bytes}, at, value);
    EXPECT_EQ(load<T>(bytes, at), value);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const bool inside = i >= at && i < at + sizeof(T);
      EXPECT_EQ(bytes[i], inside ? static_cast<std::uint8_t>(value >> (8 * (i - at))) : 0xA5);
    }
  }
}

TEST(LittleEndian, LeastSignificantByteFirstAndNothingBeside) {
  expect_round_trip<std::uint8_t>(0x81);
  expect_round_trip<std::uint16_t>(0x8102);
  expect_round_trip<std::uint32_t>(0x81020304);
  expect_round_trip<std::uint64_t>(0x8102030405060708);
  expect_round_trip(std::numeric_limits<std::uint64_t>::max());
}

}  // namespace
}  // namespace pitwall::telemetry
