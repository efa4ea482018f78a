// Counts what a BitWriter would write: the same calls give the size of a packet without a buffer,
// also at compile time for budgets.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::bits {

class BitMeasurer {
 public:
  constexpr bool write(std::uint64_t value, unsigned bits) {
    CHECK(bits <= 64 && (bits == 64 || value >> bits == 0));
    bits_ += bits;
    return true;
  }
  constexpr bool write_flag(bool value) { return write(value ? 1 : 0, 1); }
  constexpr bool align() { return write(0, static_cast<unsigned>((8 - bits_ % 8) % 8)); }

  constexpr bool ok() const { return true; }
  constexpr std::size_t bits() const { return bits_; }
  constexpr std::size_t bytes() const { return (bits_ + 7) / 8; }

 private:
  std::size_t bits_ = 0;
};

}  // namespace pitwall::bits
