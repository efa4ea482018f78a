// View of a binary record that reads numbers at an offset, in either byte order.
//   in     bytes; an offset that the caller has checked to be inside
//   out    unsigned numbers of 8 to 64 bits
//   errors CHECK fails for an offset outside: a mistake of our own code
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::replay {

struct ByteRecord {
  std::string_view bytes;
  bool big_endian = false;

  std::size_t size() const { return bytes.size(); }
  std::uint64_t number(std::size_t at, std::size_t width) const {
    CHECK(at <= bytes.size() && width <= bytes.size() - at);
    std::uint64_t out = 0;
    for (std::size_t i = 0; i < width; ++i) {
      const std::size_t place = big_endian ? at + i : at + width - 1 - i;
      out = out << 8U | static_cast<unsigned char>(bytes[place]);
    }
    return out;
  }
  std::uint8_t u8(std::size_t at) const { return static_cast<std::uint8_t>(number(at, 1)); }
  std::uint16_t u16(std::size_t at) const { return static_cast<std::uint16_t>(number(at, 2)); }
  std::uint32_t u32(std::size_t at) const { return static_cast<std::uint32_t>(number(at, 4)); }
  std::uint64_t u64(std::size_t at) const { return number(at, 8); }
};

}  // namespace pitwall::replay
