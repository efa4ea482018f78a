// The fields that a BitWriter wrote, in the same order with the same widths.
//   in      bytes from anywhere
//   out     values; zero for a field that is not there
//   errors  reading past the end: ok() is false from then on and every value is zero
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

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
    if (!std::is_constant_evaluated() && bits > 0 && bits <= kWordBits &&
        bytes_.size() - at_ / 8 >= sizeof(std::uint64_t)) {
      return read_word(bits);
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
  // So many bits lie in eight bytes wherever they begin in the first.
  static constexpr unsigned kWordBits = 57;

  // The same for most fields at once.
  std::uint64_t read_word(unsigned bits) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes_.data() + at_ / 8, sizeof word);
    if constexpr (std::endian::native == std::endian::little) word = __builtin_bswap64(word);
    const auto begun = static_cast<unsigned>(at_ % 8);
    at_ += bits;
    return word << begun >> (64U - bits);
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

}  // namespace pitwall::bits
