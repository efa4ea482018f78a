// Reader of a bit stream: the fields that a BitWriter wrote, in the same order and widths.
//   in      bytes from any source, not trusted
//   out     values; zero for a missing field
//   errors  reading past the end: from then on ok() is false and every value is zero
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
  // Skips the rest of this byte; false if it is not zero, which a BitWriter never writes.
  constexpr bool align() { return read(static_cast<unsigned>((8 - at_ % 8) % 8)) == 0 && ok_; }

  constexpr bool ok() const { return ok_; }
  constexpr std::size_t bits_left() const { return 8 * bytes_.size() - at_; }

 private:
  // Longest field that always lies within eight bytes, whatever its first bit is.
  static constexpr unsigned kWordBits = 57;

  // Fast path for most fields.
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
