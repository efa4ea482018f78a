// Cyclic redundancy checks: CRC-32 of IEEE 802.3 (zip, MCAP), CRC-32 of NovAtel, CRC-8 of SAE J1850
// and CRC-16 CCITT-FALSE (AUTOSAR E2E profiles 1 and 5).
//   in      bytes
//   out     the checksum; check values over "123456789" are in the test
//   source  Williams, "A painless guide to CRC error detection algorithms", 1993; NovAtel OEM7
//           Commands and Logs Reference Manual, "32-bit CRC"; AUTOSAR SWS CRC Library
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace pitwall::bits {

namespace detail {

constexpr std::uint32_t reflected_step(std::uint32_t crc) {
  constexpr std::uint32_t kPolynomial = 0xEDB88320;  // 0x04C11DB7 with its bits reversed
  return (crc >> 1U) ^ ((crc & 1U) != 0 ? kPolynomial : 0U);
}

// Slicing by four: table[k][b] is the effect of byte b that is k bytes away from the end.
constexpr std::array<std::array<std::uint32_t, 256>, 4> crc32_tables() {
  std::array<std::array<std::uint32_t, 256>, 4> tables{};
  for (std::uint32_t b = 0; b < 256; ++b) {
    std::uint32_t crc = b;
    for (int bit = 0; bit < 8; ++bit) crc = reflected_step(crc);
    tables[0][b] = crc;
  }
  for (std::size_t k = 1; k < 4; ++k) {
    for (std::size_t b = 0; b < 256; ++b) {
      const std::uint32_t before = tables[k - 1][b];
      tables[k][b] = (before >> 8U) ^ tables[0][before & 0xFFU];
    }
  }
  return tables;
}

inline constexpr auto kCrc32Tables = crc32_tables();

constexpr std::uint32_t crc32_raw(std::span<const std::uint8_t> data, std::uint32_t crc) {
  const auto& t = kCrc32Tables;
  std::size_t i = 0;
  for (; i + 4 <= data.size(); i += 4) {
    const std::uint32_t word = static_cast<std::uint32_t>(data[i]) |
                               static_cast<std::uint32_t>(data[i + 1]) << 8U |
                               static_cast<std::uint32_t>(data[i + 2]) << 16U |
                               static_cast<std::uint32_t>(data[i + 3]) << 24U;
    crc ^= word;
    crc = t[3][crc & 0xFFU] ^ t[2][(crc >> 8U) & 0xFFU] ^ t[1][(crc >> 16U) & 0xFFU] ^
          t[0][crc >> 24U];
  }
  for (; i < data.size(); ++i) crc = (crc >> 8U) ^ t[0][(crc ^ data[i]) & 0xFFU];
  return crc;
}

}  // namespace detail

// `continued` is the result over the bytes before these.
constexpr std::uint32_t crc32_ieee(std::span<const std::uint8_t> data,
                                   std::uint32_t continued = 0) {
  return ~detail::crc32_raw(data, ~continued);
}

// The same polynomial, starting from zero and without the final inversion.
constexpr std::uint32_t crc32_novatel(std::span<const std::uint8_t> data,
                                      std::uint32_t continued = 0) {
  return detail::crc32_raw(data, continued);
}

// Polynomial 0x1D, starting and ending with an inversion.
constexpr std::uint8_t crc8_sae_j1850(std::span<const std::uint8_t> data) {
  std::uint32_t crc = 0xFF;
  for (const std::uint8_t byte : data) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc << 1U) ^ ((crc & 0x80U) != 0 ? 0x11DU : 0U);
  }
  return static_cast<std::uint8_t>(crc ^ 0xFFU);
}

// Polynomial 0x1021, most significant bit first, starting from all ones.
constexpr std::uint16_t crc16_ccitt_false(std::span<const std::uint8_t> data) {
  std::uint32_t crc = 0xFFFF;
  for (const std::uint8_t byte : data) {
    crc ^= static_cast<std::uint32_t>(byte) << 8U;
    for (int bit = 0; bit < 8; ++bit) crc = (crc << 1U) ^ ((crc & 0x8000U) != 0 ? 0x11021U : 0U);
  }
  return static_cast<std::uint16_t>(crc);
}

}  // namespace pitwall::bits
