// One CAN or CAN FD data frame as a value; the layout of the kernel is in protocol/transport.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::can {

inline constexpr std::uint32_t kMaxStandardId = 0x7FF;
inline constexpr std::uint32_t kMaxExtendedId = 0x1FFFFFFF;
inline constexpr std::size_t kMaxDataBytes = 64;  // CAN FD; classic CAN carries 8

struct Frame {
  std::uint32_t id = 0;     // arbitration id without flag bits
  bool extended = false;    // 29-bit identifier
  bool remote = false;      // RTR: a request, no data
  bool fd = false;          // CAN FD frame
  std::uint8_t length = 0;  // bytes of data in use
  std::array<std::uint8_t, kMaxDataBytes> data{};

  std::span<const std::uint8_t> payload() const { return {data.data(), length}; }
  bool operator==(const Frame&) const = default;
};

struct ReceivedFrame {
  Frame frame;
  Instant at;  // time of delivery by the kernel or the bus model
};

}  // namespace pitwall::can
