// Cyclic redundancy checks: CRC-32 of IEEE 802.3 (zip, MCAP), CRC-32 of NovAtel, and those of CAN
// messages: CRC-8 of SAE J1850, the same with initial value 0 (AUTOSAR E2E profile 1), CRC-8H2F
// (profile 2), CRC-16 CCITT-FALSE (profile 5).
//   in      bytes
//   out     the checksum; the test has the check values over "123456789"
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

// `continued`: the result over the preceding bytes.
constexpr std::uint32_t crc32_ieee(std::span<const std::uint8_t> data,
                                   std::uint32_t continued = 0) {
  return ~detail::crc32_raw(data, ~continued);
}

// The same polynomial with initial value 0 and without the final inversion.
constexpr std::uint32_t crc32_novatel(std::span<const std::uint8_t> data,
                                      std::uint32_t continued = 0) {
  return detail::crc32_raw(data, continued);
}

namespace detail {

// The remainder of every first byte; Register has the width of the checksum.
template <class Register, Register kPolynomial>
constexpr std::array<Register, 256> crc_table() {
  constexpr unsigned kShift = 8 * (sizeof(Register) - 1);
  constexpr std::uint32_t kTop = 0x80U << kShift;
  std::array<Register, 256> table{};
  for (std::uint32_t b = 0; b < 256; ++b) {
    std::uint32_t crc = b << kShift;
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc << 1U) ^ ((crc & kTop) != 0 ? std::uint32_t{kPolynomial} : 0U);
    }
    table[b] = static_cast<Register>(crc);
  }
  return table;
}

inline constexpr auto kCrc8J1850Table = crc_table<std::uint8_t, 0x1D>();
inline constexpr auto kCrc8H2fTable = crc_table<std::uint8_t, 0x2F>();
inline constexpr auto kCrc16Table = crc_table<std::uint16_t, 0x1021>();

constexpr std::uint8_t crc8_raw(const std::array<std::uint8_t, 256>& table,
                                std::span<const std::uint8_t> data, std::uint8_t crc) {
  for (const std::uint8_t byte : data) crc = table[static_cast<std::uint8_t>(crc ^ byte)];
  return crc;
}

constexpr std::uint8_t inverted(std::uint8_t crc) { return static_cast<std::uint8_t>(~crc); }

}  // namespace detail

// Polynomial 0x1D, initial value 0xFF, final inversion.
constexpr std::uint8_t crc8_sae_j1850(std::span<const std::uint8_t> data,
                                      std::uint8_t continued = 0) {
  return detail::inverted(
      detail::crc8_raw(detail::kCrc8J1850Table, data, detail::inverted(continued)));
}

// The same polynomial with initial value 0 and without inversion (CRC-8/GSM-A of the catalogue).
constexpr std::uint8_t crc8_j1850_from_zero(std::span<const std::uint8_t> data,
                                            std::uint8_t continued = 0) {
  return detail::crc8_raw(detail::kCrc8J1850Table, data, continued);
}

// Polynomial 0x2F, initial value 0xFF, final inversion.
constexpr std::uint8_t crc8_h2f(std::span<const std::uint8_t> data, std::uint8_t continued = 0) {
  return detail::inverted(
      detail::crc8_raw(detail::kCrc8H2fTable, data, detail::inverted(continued)));
}

// Polynomial 0x1021, most significant bit first, initial value 0xFFFF.
constexpr std::uint16_t crc16_ccitt_false(std::span<const std::uint8_t> data,
                                          std::uint16_t continued = 0xFFFF) {
  std::uint32_t crc = continued;
  for (const std::uint8_t byte : data) {
    crc = (crc << 8U & 0xFFFFU) ^ detail::kCrc16Table[crc >> 8U ^ byte];
  }
  return static_cast<std::uint16_t>(crc);
}

}  // namespace pitwall::bits
