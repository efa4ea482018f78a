// Bit-exact length of a classic CAN frame on the wire: the CRC-15 is computed and every stuff bit
// is counted.
//   in     a data or remote frame, 11 or 29 bit identifier, not CAN FD (CHECKed)
//   out    bits from start of frame to the end of the 3 bits of interframe space
//   invariants
//          47 + 8n <= bits <= 55 + 10n for 11 bit identifiers, 67 + 8n .. 80 + 10n for 29 bit
//   source Bosch CAN 2.0 part B, sections 3.1 (frame), 3.1.1 (CRC), 5 (stuffing)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/can/frame.hpp"

namespace pitwall::can_bus {

inline constexpr std::uint32_t kInterframeBits = 3;

// CRC delimiter, acknowledge slot and delimiter, 7 bits end of frame: never stuffed.
inline constexpr std::uint32_t kUnstuffedTailBits = 10;

struct FrameLength {
  std::uint32_t bits = 0;  // stuff bits, tail and interframe space included
  std::uint32_t stuff_bits = 0;
  std::uint16_t crc15 = 0;
};

FrameLength frame_length(const can::Frame& frame);

// Key of arbitration: the frame with the smaller key wins. Identifier, RTR, IDE in bit order, so a
// data frame wins against a remote frame, and an 11 bit identifier against a 29 bit one with the
// same first bits.
std::uint32_t arbitration_key(const can::Frame& frame);

}  // namespace pitwall::can_bus
