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

#include "protocol/vocabulary/bytes.hpp"
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
    const auto raw = load<BitsOf<T>>(bytes_, at_);
    at_ += sizeof(T);
    return std::bit_cast<T>(raw);
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
    store(bytes_, at_, std::bit_cast<BitsOf<T>>(value));
    at_ += sizeof(T);
  }

  std::size_t size() const { return at_; }

 private:
  std::span<std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

}  // namespace pitwall::gnss
