// Bit stream: unsigned fields of 0 to 64 bits, most significant bit first, no padding. A BitReader
// reads the fields that a BitWriter wrote, in the same order and widths.
//   writer  in      a buffer, and values that fit their field
//           out     the buffer; a byte stays unchanged until its first bit is written
//           errors  a field that does not fit in the buffer is refused, with every field after it:
//                   ok() stays false. A value wider than its field fails a CHECK
//   reader  in      bytes from any source, not trusted
//           out     values; zero for a missing field
//           errors  reading past the end: from then on ok() is false and every value is zero
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

inline constexpr unsigned kMaxFieldBits = 64;

class BitWriter {
 public:
  constexpr explicit BitWriter(std::span<std::uint8_t> buffer) : buffer_(buffer) {}

  constexpr bool write(std::uint64_t value, unsigned bits) {
    CHECK(bits <= kMaxFieldBits && (bits == kMaxFieldBits || value >> bits == 0));
    if (!ok_ || bits > 8 * buffer_.size() - at_) return ok_ = false;
    constexpr unsigned kWhole = 56;  // with the bits of a started byte they fill a register
    if (bits > kWhole) {
      put(value >> kWhole, bits - kWhole);
      value &= (std::uint64_t{1} << kWhole) - 1;
      bits = kWhole;
    }
    put(value, bits);
    return true;
  }
  // Writes zeros up to the next whole byte.
  constexpr bool align() { return write(0, static_cast<unsigned>((8 - at_ % 8) % 8)); }

  constexpr bool ok() const { return ok_; }
  constexpr std::size_t bits() const { return at_; }
  constexpr std::size_t bytes() const { return (at_ + 7) / 8; }

 private:
  static constexpr std::size_t kWord = sizeof(std::uint32_t);

  constexpr void put(std::uint64_t value, unsigned bits) {
    const auto begun = static_cast<unsigned>(at_ % 8);
    const std::size_t first = at_ / 8, bytes = (begun + bits + 7) / 8;
    if (bits == 0) return;
    if (begun != 0) value |= std::uint64_t{buffer_[first]} >> (8 - begun) << bits;
    value <<= 8 * bytes - begun - bits;
    at_ += bits;
    if (!std::is_constant_evaluated() && bytes == kWord) return put_word(value, first);
    for (std::size_t i = bytes; i > 0; --i, value >>= 8U) {
      buffer_[first + i - 1] = static_cast<std::uint8_t>(value);
    }
  }
  // Four bytes without a loop.
  void put_word(std::uint64_t value, std::size_t first) {
    auto word = static_cast<std::uint32_t>(value);
    if constexpr (std::endian::native == std::endian::little) word = __builtin_bswap32(word);
    std::memcpy(buffer_.data() + first, &word, kWord);
  }

  std::span<std::uint8_t> buffer_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

class BitReader {
 public:
  constexpr explicit BitReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  constexpr std::uint64_t read(unsigned bits) {
    CHECK(bits <= kMaxFieldBits);
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
