// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/e2e.hpp"

#include <algorithm>
#include <span>

#include "protocol/bits/crc.hpp"
#include "protocol/can/signal.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::can {
namespace {

constexpr unsigned kNibbleBits = 4;

// The eight bytes that hold the field; the last eight of the frame hold the last fields.
unsigned first_byte_of(unsigned start) {
  return std::min(start / 8U, unsigned{kMaxDataBytes} - 8U);
}

std::uint32_t field(const FrameBytes& data, unsigned start, unsigned bits) {
  const unsigned first = first_byte_of(start);
  return static_cast<std::uint32_t>(load_intel(data, first) >> (start - 8 * first) & mask_of(bits));
}

void set_field(FrameBytes& data, unsigned start, unsigned bits, std::uint32_t value) {
  const unsigned first = first_byte_of(start), shift = start - 8 * first;
  const std::uint64_t kept = load_intel(data, first) & ~(mask_of(bits) << shift);
  store_intel(data, kept | (value & mask_of(bits)) << shift, first);
}

std::uint8_t low(std::uint16_t id) { return static_cast<std::uint8_t>(id); }
std::uint8_t high(std::uint16_t id) { return static_cast<std::uint8_t>(id >> 8U); }
std::uint8_t sent_nibble(const ProtectionRule& rule) { return high(rule.data_id) & 0xFU; }

unsigned crc_bytes(const ProtectionRule& rule) { return rule.profile == Protection::kP05 ? 2 : 1; }

// The bytes before the checksum, and those after it.
struct Covered {
  std::span<const std::uint8_t> before, after;
};

Covered covered(const ProtectionRule& rule, const Frame& frame) {
  const auto all = frame.payload();
  return {all.first(rule.crc_byte), all.subspan(rule.crc_byte + crc_bytes(rule))};
}

std::uint8_t crc_of_data_id(const ProtectionRule& rule, const Frame& frame) {
  const std::array<std::uint8_t, 2> both{low(rule.data_id), high(rule.data_id)};
  const std::array<std::uint8_t, 2> nibble{low(rule.data_id), 0};
  switch (rule.data_id_mode) {
    case DataIdMode::kBoth:
      return bits::crc8_j1850_from_zero(both);
    case DataIdMode::kAlternating: {
      const std::size_t odd = field(frame.data, rule.counter_start, 1);
      return bits::crc8_j1850_from_zero(std::span{both}.subspan(odd, 1));
    }
    case DataIdMode::kLow:
      return bits::crc8_j1850_from_zero(std::span{both}.first(1));
    case DataIdMode::kNibble:
      return bits::crc8_j1850_from_zero(nibble);
  }
  return 0;
}

std::uint8_t crc_p01(const ProtectionRule& rule, const Frame& frame) {
  const Covered data = covered(rule, frame);
  const std::uint8_t crc = bits::crc8_j1850_from_zero(data.before, crc_of_data_id(rule, frame));
  return bits::crc8_j1850_from_zero(data.after, crc);
}

std::uint8_t crc_p02(const ProtectionRule& rule, const Frame& frame) {
  const Covered data = covered(rule, frame);
  const std::uint32_t counter = field(frame.data, rule.counter_start, kNibbleBits);
  const std::uint8_t crc = bits::crc8_h2f(data.after, bits::crc8_h2f(data.before));
  return bits::crc8_h2f(std::span{rule.data_ids}.subspan(counter, 1), crc);
}

std::uint16_t crc_p05(const ProtectionRule& rule, const Frame& frame) {
  const Covered data = covered(rule, frame);
  const std::array<std::uint8_t, 2> id{low(rule.data_id), high(rule.data_id)};
  const std::uint16_t crc = bits::crc16_ccitt_false(data.before);
  return bits::crc16_ccitt_false(id, bits::crc16_ccitt_false(data.after, crc));
}

std::uint16_t crc_of(const ProtectionRule& rule, const Frame& frame) {
  switch (rule.profile) {
    case Protection::kNone:
      return 0;
    case Protection::kJ1850: {
      const Covered data = covered(rule, frame);
      return bits::crc8_sae_j1850(data.after, bits::crc8_sae_j1850(data.before));
    }
    case Protection::kP01:
      return crc_p01(rule, frame);
    case Protection::kP02:
      return crc_p02(rule, frame);
    case Protection::kP05:
      return crc_p05(rule, frame);
  }
  return 0;
}

bool sends_nibble(const ProtectionRule& rule) {
  return rule.profile == Protection::kP01 && rule.data_id_mode == DataIdMode::kNibble;
}

}  // namespace

void protect(const ProtectionRule& rule, ProtectState& state, Frame& frame) {
  if (rule.profile == Protection::kNone) return;
  CHECK(frame.length == rule.length);
  if (rule.counter_bits > 0) {
    set_field(frame.data, rule.counter_start, rule.counter_bits, state.counter);
    state.counter = state.counter >= counter_top(rule) ? 0 : state.counter + 1;
  }
  if (sends_nibble(rule)) {
    set_field(frame.data, rule.nibble_start, kNibbleBits, sent_nibble(rule));
  }
  set_field(frame.data, 8U * rule.crc_byte, 8 * crc_bytes(rule), crc_of(rule, frame));
}

FrameCheck check(const ProtectionRule& rule, const Frame& frame) {
  if (rule.profile == Protection::kNone) return FrameCheck::kOk;
  if (frame.length != rule.length) return FrameCheck::kWrongLength;
  if (field(frame.data, 8U * rule.crc_byte, 8 * crc_bytes(rule)) != crc_of(rule, frame)) {
    return FrameCheck::kWrongCrc;
  }
  if (sends_nibble(rule) &&
      field(frame.data, rule.nibble_start, kNibbleBits) != sent_nibble(rule)) {
    return FrameCheck::kWrongDataId;
  }
  const bool is_counted = rule.counter_bits > 0;
  if (is_counted && field(frame.data, rule.counter_start, rule.counter_bits) > counter_top(rule)) {
    return FrameCheck::kWrongCounter;
  }
  return FrameCheck::kOk;
}

// A checksum is linear: what it does with a flip in one frame it does in every frame with the same
// counter, so frames of zeros stand for all.
bool hides_a_flip(const ProtectionRule& rule) {
  const bool has_ids = rule.profile == Protection::kP01 || rule.profile == Protection::kP02;
  if (!has_ids) return false;
  for (std::uint32_t counter = 0; counter <= counter_top(rule); ++counter) {
    ProtectState state{counter};
    Frame frame{.length = rule.length, .data = {}};
    protect(rule, state, frame);
    for (unsigned bit = 0; bit < rule.counter_bits; ++bit) {
      Frame flipped = frame;
      const unsigned place = rule.counter_start + bit;
      set_field(flipped.data, place, 1, ~field(frame.data, place, 1));
      if (check(rule, flipped) == FrameCheck::kOk) return true;
    }
  }
  return false;
}

}  // namespace pitwall::can
