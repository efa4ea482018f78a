// Reader and writer of little-endian numbers, on any machine. Both stay within their span: reading
// past the end gives zeros and clears ok(); writing past the end fails a CHECK.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::gnss {

template <class T>
using BitsOf = std::conditional_t<
    sizeof(T) == 1, std::uint8_t,
    std::conditional_t<sizeof(T) == 2, std::uint16_t,
                       std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>>;

class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  template <class T>
  T get() {
    if (bytes_.size() - at_ < sizeof(T)) {
      ok_ = false;
      at_ = bytes_.size();
      return T{};
    }
    std::uint64_t raw = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      raw |= static_cast<std::uint64_t>(bytes_[at_ + i]) << (8 * i);
    }
    at_ += sizeof(T);
    return std::bit_cast<T>(static_cast<BitsOf<T>>(raw));
  }

  bool ok() const { return ok_; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

class ByteWriter {
 public:
  explicit ByteWriter(std::span<std::uint8_t> bytes) : bytes_(bytes) {}

  template <class T>
  void put(T value) {
    CHECK(bytes_.size() - at_ >= sizeof(T));
    const std::uint64_t raw = std::bit_cast<BitsOf<T>>(value);
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bytes_[at_ + i] = static_cast<std::uint8_t>(raw >> (8 * i));
    }
    at_ += sizeof(T);
  }

  std::size_t size() const { return at_; }

 private:
  std::span<std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

}  // namespace pitwall::gnss
