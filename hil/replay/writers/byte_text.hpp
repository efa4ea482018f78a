// Append functions for little-endian and big-endian numbers in a binary file in memory.
//   in     unsigned numbers
//   out    bytes at the end of the string
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace pitwall::replay {

template <class Number>
void append_little(std::string& out, Number value) {
  for (std::size_t i = 0; i < sizeof(Number); ++i)
    out += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xFFU);
}

inline void append_big(std::string& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8)
    out += static_cast<char>(value >> static_cast<unsigned>(shift) & 0xFFU);
}

inline void pad_to(std::string& out, std::size_t size) {
  if (out.size() < size) out.resize(size, '\0');
}

}  // namespace pitwall::replay
