// Unsigned numbers of any width up to 57 bits, packed without gaps, most significant bit first.
//   errors writing past the end is our own mistake; reading past it gives zeros and clears ok
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {

class BitWriter {
 public:
  explicit BitWriter(std::span<std::uint8_t> bytes) : bytes_(bytes) {}

  void put(std::uint64_t value, unsigned bits) {
    CHECK(bits <= 57 && (value >> bits) == 0);
    pending_ = (pending_ << bits) | value;
    pending_bits_ += bits;
    while (pending_bits_ >= 8) {
      pending_bits_ -= 8;
      push(static_cast<std::uint8_t>(pending_ >> pending_bits_));
    }
    pending_ &= (std::uint64_t{1} << pending_bits_) - 1;
  }
  // Zeros up to the next whole byte.
  void align() {
    if (pending_bits_ > 0) put(0, 8 - pending_bits_);
  }
  std::size_t bytes() const { return at_; }

 private:
  void push(std::uint8_t byte) {
    CHECK(at_ < bytes_.size());
    bytes_[at_++] = byte;
  }

  std::span<std::uint8_t> bytes_;
  std::size_t at_ = 0;
  std::uint64_t pending_ = 0;
  unsigned pending_bits_ = 0;
};

class BitReader {
 public:
  explicit BitReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint64_t get(unsigned bits) {
    CHECK(bits <= 57);
    while (held_bits_ < bits) {
      if (at_ == bytes_.size()) ok_ = false;
      held_ = (held_ << 8U) | (at_ < bytes_.size() ? bytes_[at_++] : 0U);
      held_bits_ += 8;
    }
    held_bits_ -= bits;
    const std::uint64_t value = held_ >> held_bits_;
    held_ &= (std::uint64_t{1} << held_bits_) - 1;
    return value;
  }
  // What is left of the current byte; a sender writes zeros there.
  std::uint64_t rest_of_byte() { return get(held_bits_); }
  bool ok() const { return ok_; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  std::uint64_t held_ = 0;
  unsigned held_bits_ = 0;
  bool ok_ = true;
};

}  // namespace pitwall::telemetry
