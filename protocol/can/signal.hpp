// Layout of a signal in a frame, and the plan to read it: one load of eight bytes, one shift, one
// mask. Generated code and run-time decoder use the same functions.
//   in      the layout as in the DBC file (start bit, length, byte order, scale, range)
//   out     raw bits and physical values in DBC units
//   errors  plan() does not check its layout; the parser refuses layouts that do not fit
//   source  Vector, "DBC File Format Documentation" 1.0; Motorola start bit = most significant bit,
//           bits numbered 8 * byte + 7..0
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "protocol/can/frame.hpp"

namespace pitwall::can {

enum class ByteOrder : std::uint8_t { kIntel, kMotorola };
enum class Number : std::uint8_t { kUnsigned, kSigned, kFloat32, kFloat64 };

// As written in the file. min >= max means that no range is given.
struct SignalLayout {
  std::uint16_t start = 0;
  std::uint8_t length = 0;
  ByteOrder order = ByteOrder::kIntel;
  Number number = Number::kUnsigned;
  double scale = 1.0, offset = 0.0;
  double min = 0.0, max = 0.0;
  bool operator==(const SignalLayout&) const = default;
};

struct SignalPlan {
  std::uint8_t first_byte = 0;  // of the eight bytes to load
  std::int8_t shift = 0;        // to the right; negative: the signal extends into a ninth byte
  std::uint8_t length = 0;
  ByteOrder order = ByteOrder::kIntel;
  Number number = Number::kUnsigned;
  std::uint64_t mask = 0;
  double scale = 1.0, offset = 0.0;
  // Limits of the raw values to send: the narrower of the field and the range of the file. For
  // floating-point signals these are limits of the unscaled number.
  double raw_min = 0.0, raw_max = 0.0;
  std::uint64_t raw_min_bits = 0, raw_max_bits = 0;
};

SignalPlan plan(const SignalLayout& layout);

// The bits of the signal, in the order from the start bit; bit k of byte b is 8 * b + k.
std::vector<std::size_t> bits_of(const SignalLayout& layout);
// False if any bit is outside of `bytes` bytes.
bool fits(const SignalLayout& layout, std::size_t bytes);

using FrameBytes = std::array<std::uint8_t, kMaxDataBytes>;

constexpr std::uint64_t load_intel(const FrameBytes& data, std::size_t first = 0) {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < 8; ++i) word |= static_cast<std::uint64_t>(data[first + i]) << 8 * i;
  return word;
}

constexpr std::uint64_t load_motorola(const FrameBytes& data, std::size_t first = 0) {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < 8; ++i) word = word << 8U | data[first + i];
  return word;
}

constexpr void store_intel(FrameBytes& data, std::uint64_t word, std::size_t first = 0) {
  for (std::size_t i = 0; i < 8; ++i) data[first + i] = static_cast<std::uint8_t>(word >> 8 * i);
}

constexpr void store_motorola(FrameBytes& data, std::uint64_t word, std::size_t first = 0) {
  for (std::size_t i = 0; i < 8; ++i) {
    data[first + i] = static_cast<std::uint8_t>(word >> 8 * (7 - i));
  }
}

constexpr std::uint64_t mask_of(unsigned length) {
  return length >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << length) - 1;
}

constexpr std::int64_t sign_extended(std::uint64_t raw, unsigned length) {
  return static_cast<std::int64_t>(raw << (64 - length)) >> (64 - length);
}

// The number of the raw bits, before scale and offset.
constexpr double number_of(std::uint64_t raw, Number number, unsigned length) {
  switch (number) {
    case Number::kUnsigned:
      return static_cast<double>(raw);
    case Number::kSigned:
      return static_cast<double>(sign_extended(raw, length));
    case Number::kFloat32:
      return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(raw)));
    case Number::kFloat64:
      return std::bit_cast<double>(raw);
  }
  return 0.0;
}

constexpr double physical_of(std::uint64_t raw, const SignalPlan& p) {
  return number_of(raw, p.number, p.length) * p.scale + p.offset;
}

std::uint64_t extract(const SignalPlan& p, const FrameBytes& data);
void insert(const SignalPlan& p, FrameBytes& data, std::uint64_t raw);

// Raw bits of a finite physical value: rounded half away from zero, then limited to the raw limits;
// never wraps. Sets `saturated` if it was limited; otherwise leaves it unchanged.
std::uint64_t raw_of(double physical, const SignalPlan& p, bool& saturated);

}  // namespace pitwall::can
