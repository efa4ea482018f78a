// Bytes of a text, and of unsigned numbers, the least significant byte first.
//   in     load: any bytes. store: the value, and bytes that have room for it
//   out    the value, or its bytes and none beside them
//   errors none: the caller has checked the length
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace pitwall {

inline std::span<const std::uint8_t> as_bytes(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

// Numbers of one to eight bytes: all of `bytes`. Higher bytes of a value are not stored.
constexpr std::uint64_t load(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) value |= std::uint64_t{bytes[i]} << (8 * i);
  return value;
}
constexpr void store(std::span<std::uint8_t> bytes, std::uint64_t value) {
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<std::uint8_t>(value >> (8 * i));
  }
}

// Numbers of an unsigned type, from byte `at` on.
template <class T>
constexpr T load(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<T>(load(bytes.subspan(at, sizeof(T))));
}
template <class T>
constexpr void store(std::span<std::uint8_t> bytes, std::size_t at, T value) {
  store(bytes.subspan(at, sizeof(T)), value);
}

}  // namespace pitwall
