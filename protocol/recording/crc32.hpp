// CRC-32 (IEEE 802.3, reflected, as zlib's and MCAP's): continue one over several pieces by giving
// the last result back.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace pitwall::recording {

constexpr std::array<std::uint32_t, 256> crc32_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    std::uint32_t c = i;
    for (int bit = 0; bit < 8; ++bit) c = (c >> 1) ^ ((c & 1U) != 0U ? 0xEDB88320U : 0U);
    table[i] = c;
  }
  return table;
}

constexpr std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t continued = 0) {
  constexpr auto kTable = crc32_table();
  std::uint32_t c = ~continued;
  for (const std::uint8_t byte : bytes) c = (c >> 8) ^ kTable[(c ^ byte) & 0xFFU];
  return ~c;
}

}  // namespace pitwall::recording
