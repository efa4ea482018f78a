// End-to-end protection of one CAN message: a checksum over its bytes, its counter and a data id
// that only its sender and its receivers have. It detects a damaged frame and a frame of another
// sender.
//   in      a rule, a frame; for the sender also its counter
//   out     the frame with counter and checksum; or a verdict on the checksum (message_monitor
//           evaluates the counter for lost frames)
//   errors  protect() CHECKs the length, which the sender sets; check() returns a verdict
//   invariants
//           check(protect(x)) is good. Any single flipped bit is detected, and any burst within the
//           data that is no wider than the checksum. For this, hides_a_flip() of the rule must be
//           false: it can be true if the data id depends on the counter
//   cost    no allocation, one table look-up per byte
//   source  AUTOSAR FO PRS E2EProtocol R23-11, profiles 1 (data id modes both, alternating, low,
//           nibble), 2 and 5; SAE J1850
//
//   profile      checksum                        counter          bytes added to the data
//   kJ1850       CRC-8 0x1D, FF/FF, one byte     any or none      none
//   kP01         CRC-8 0x1D, 00/00, one byte     nibble, 0 to 14  before them: id low, id high
//   kP02         CRC-8 0x2F, FF/FF, one byte     nibble, 0 to 15  after them: the id of the counter
//   kP05         CRC-16 0x1021, low byte first   byte after it    after them: id low, id high
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/can/frame.hpp"

namespace pitwall::can {

enum class Protection : std::uint8_t { kNone, kJ1850, kP01, kP02, kP05 };

// Part of the 16-bit data id that enters the checksum of profile 1.
enum class DataIdMode : std::uint8_t {
  kBoth,         // low byte, high byte
  kAlternating,  // low byte with even counters, high byte with odd ones
  kLow,          // low byte
  kNibble        // low byte, zero; the low nibble of the high byte is sent
};

// Bit positions as for an Intel signal: bit k of byte b is 8 b + k.
struct ProtectionRule {
  Protection profile = Protection::kNone;
  DataIdMode data_id_mode = DataIdMode::kBoth;  // kP01
  std::uint8_t length = 0;                      // bytes of the message
  std::uint8_t crc_byte = 0;                    // the first of two for kP05
  std::uint16_t counter_start = 0;
  std::uint8_t counter_bits = 0;            // 0: none (kJ1850)
  std::uint16_t nibble_start = 0;           // kNibble
  std::uint16_t data_id = 0;                // kP01, kP05
  std::array<std::uint8_t, 16> data_ids{};  // kP02

  bool operator==(const ProtectionRule&) const = default;
};

// The largest value of the counter; the next one is 0.
constexpr std::uint32_t counter_top(const ProtectionRule& rule) {
  return rule.profile == Protection::kP01 ? 14U : (1U << rule.counter_bits) - 1U;
}

struct ProtectState {
  std::uint32_t counter = 0;  // of the next frame
};

enum class FrameCheck : std::uint8_t {
  kOk,
  kWrongLength,
  kWrongCrc,
  kWrongCounter,  // a value that no sender uses (profile 1: 15)
  kWrongDataId    // wrong nibble of the data id
};

// Overwrites counter, nibble and checksum in the frame. kNone changes nothing.
void protect(const ProtectionRule& rule, ProtectState& state, Frame& frame);

FrameCheck check(const ProtectionRule& rule, const Frame& frame);

// True if, by the choice of the data ids, one flipped bit of the counter only selects another id
// with the same checksum, so that check() does not detect the flip.
bool hides_a_flip(const ProtectionRule& rule);

}  // namespace pitwall::can
