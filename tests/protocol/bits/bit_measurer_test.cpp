// SPDX-License-Identifier: Apache-2.0
#include "protocol/bits/bit_measurer.hpp"

#include <gtest/gtest.h>

#include <array>

#include "protocol/bits/bit_writer.hpp"

namespace pitwall::bits {
namespace {

template <class Sink>
constexpr std::size_t layout(Sink& sink, unsigned width) {
  sink.write(1, width);
  sink.write_flag(true);
  sink.write(0, 64);
  sink.align();
  sink.write(3, 2);
  return sink.bits();
}

constexpr std::size_t measured(unsigned width) {
  BitMeasurer m;
  return layout(m, width);
}
static_assert(measured(7) == 7 + 1 + 64 + 2);

TEST(BitMeasurer, CountsWhatTheWriterWrites) {
  for (unsigned width = 1; width <= 64; ++width) {
    std::array<std::uint8_t, 40> memory{};
    BitWriter writer{memory};
    BitMeasurer measurer;
    EXPECT_EQ(layout(measurer, width), layout(writer, width));
    EXPECT_EQ(measurer.bytes(), writer.bytes());
    EXPECT_TRUE(writer.ok() && measurer.ok());
  }
}

}  // namespace
}  // namespace pitwall::bits
