// The fields that a BitWriter wrote, in the same order with the same widths.
//   in      bytes from anywhere
//   out     values; zero for a field that is not there
//   errors  reading past the end: ok() is false from then on and every value is zero
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::bits {

class BitReader {
 public:
  constexpr explicit BitReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  constexpr std::uint64_t read(unsigned bits) {
    CHECK(bits <= 64);
    if (!ok_ || bits > bits_left()) {
      ok_ = false;
      return 0;
    }
    std::uint64_t value = 0;
    while (bits > 0) {
      const unsigned left = 8U - static_cast<unsigned>(at_ % 8);
      const unsigned now = bits < left ? bits : left;
      const unsigned byte = bytes_[at_ / 8];
      const unsigned part = byte >> (left - now) & ((1U << now) - 1U);
      value = value << now | part;
      at_ += now;
      bits -= now;
    }
    return value;
  }
  constexpr bool read_flag() { return read(1) != 0; }
  // Past the rest of this byte; false where it is not zero, which no BitWriter makes.
  constexpr bool align() { return read(static_cast<unsigned>((8 - at_ % 8) % 8)) == 0 && ok_; }

  constexpr bool ok() const { return ok_; }
  constexpr std::size_t bits_left() const { return 8 * bytes_.size() - at_; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

}  // namespace pitwall::bits
