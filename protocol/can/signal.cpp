// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/signal.hpp"

#include <algorithm>
#include <limits>

namespace pitwall::can {
namespace {

constexpr std::size_t kLastWord = kMaxDataBytes - 8;
// Slack, in raw steps, for ranges such as [0, 6553.5] at scale 0.1 that binary cannot divide.
constexpr double kRangeSlack = 1e-6;

// Position of the most significant bit when bits are counted in the order in which they are sent.
std::size_t motorola_position(const SignalLayout& s) {
  return 8U * (s.start / 8U) + (7U - s.start % 8U);
}

void limit_to_field(SignalPlan& p) {
  switch (p.number) {
    case Number::kUnsigned:
      p.raw_min = 0.0;
      p.raw_max = static_cast<double>(p.mask);
      break;
    case Number::kSigned:
      p.raw_min = -std::ldexp(1.0, p.length - 1);
      p.raw_max = static_cast<double>(p.mask >> 1U);
      break;
    case Number::kFloat32:
      p.raw_max = static_cast<double>(std::numeric_limits<float>::max());
      p.raw_min = -p.raw_max;
      break;
    case Number::kFloat64:
      p.raw_max = std::numeric_limits<double>::max();
      p.raw_min = -p.raw_max;
      break;
  }
}

bool is_integer(const SignalPlan& p) {
  return p.number == Number::kUnsigned || p.number == Number::kSigned;
}

void limit_to_range(SignalPlan& p, double min, double max) {
  if (!(min < max)) return;
  double low = (min - p.offset) / p.scale;
  double high = (max - p.offset) / p.scale;
  if (low > high) std::swap(low, high);
  if (is_integer(p)) {
    low = std::ceil(low - kRangeSlack);
    high = std::floor(high + kRangeSlack);
  }
  low = std::max(low, p.raw_min);
  high = std::min(high, p.raw_max);
  if (!(low <= high)) return;  // a range without a single representable value says nothing
  p.raw_min = low;
  p.raw_max = high;
}

// The bits of an unscaled number that is inside the field.
std::uint64_t bits_of(double number, const SignalPlan& p) {
  switch (p.number) {
    case Number::kUnsigned:
      if (number >= 0x1p64) return p.mask;
      return static_cast<std::uint64_t>(number) & p.mask;
    case Number::kSigned:
      if (number >= 0x1p63) return p.mask >> 1U;
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(number)) & p.mask;
    case Number::kFloat32:
      return std::bit_cast<std::uint32_t>(static_cast<float>(number));
    case Number::kFloat64:
      return std::bit_cast<std::uint64_t>(number);
  }
  return 0;
}

}  // namespace

SignalPlan plan(const SignalLayout& s) {
  SignalPlan p;
  p.length = s.length;
  p.order = s.order;
  p.number = s.number;
  p.mask = mask_of(s.length);
  p.scale = s.scale;
  p.offset = s.offset;
  // A signal of the first eight bytes uses the word that starts at byte 0, so that all signals of
  // a classic frame share one load.
  const std::size_t begin = s.order == ByteOrder::kIntel ? s.start : motorola_position(s);
  const std::size_t end = begin + s.length;
  const std::size_t first = end <= 64 ? 0 : std::min<std::size_t>(begin / 8, kLastWord);
  p.first_byte = static_cast<std::uint8_t>(first);
  const int left = static_cast<int>(begin - 8 * first);      // bits before the signal
  const int spare = 64 - left - static_cast<int>(s.length);  // bits after it; negative: ninth byte
  if (spare < 0) {
    p.shift = static_cast<std::int8_t>(spare);
  } else {
    p.shift = static_cast<std::int8_t>(s.order == ByteOrder::kIntel ? left : spare);
  }
  limit_to_field(p);
  limit_to_range(p, s.min, s.max);
  p.raw_min_bits = bits_of(p.raw_min, p);
  p.raw_max_bits = bits_of(p.raw_max, p);
  return p;
}

std::vector<std::size_t> bits_of(const SignalLayout& s) {
  std::vector<std::size_t> out;
  out.reserve(s.length);
  for (std::size_t bit = s.start; out.size() < s.length;) {
    out.push_back(bit);
    if (s.order == ByteOrder::kIntel) {
      ++bit;
    } else {
      bit = bit % 8 == 0 ? bit + 15 : bit - 1;
    }
  }
  return out;
}

bool fits(const SignalLayout& s, std::size_t bytes) {
  if (s.length < 1 || s.length > 64) return false;
  const std::size_t begin = s.order == ByteOrder::kIntel ? s.start : motorola_position(s);
  return begin + s.length <= 8 * bytes;
}

std::uint64_t extract(const SignalPlan& p, const FrameBytes& data) {
  const bool intel = p.order == ByteOrder::kIntel;
  const std::uint64_t word =
      intel ? load_intel(data, p.first_byte) : load_motorola(data, p.first_byte);
  if (p.shift >= 0) return word >> p.shift & p.mask;
  // Nine bytes: -shift bits are in the last one.
  const unsigned beyond = static_cast<unsigned>(-p.shift);
  const std::uint64_t ninth = data[p.first_byte + 8U];
  if (intel) return (word >> (64U - p.length + beyond) | ninth << (p.length - beyond)) & p.mask;
  return (word << beyond | ninth >> (8U - beyond)) & p.mask;
}

void insert(const SignalPlan& p, FrameBytes& data, std::uint64_t raw) {
  const bool intel = p.order == ByteOrder::kIntel;
  raw &= p.mask;
  std::uint64_t word = intel ? load_intel(data, p.first_byte) : load_motorola(data, p.first_byte);
  if (p.shift >= 0) {
    word = (word & ~(p.mask << p.shift)) | raw << p.shift;
  } else {
    const unsigned beyond = static_cast<unsigned>(-p.shift);
    std::uint8_t& ninth = data[p.first_byte + 8U];
    if (intel) {
      const unsigned left = 64U - p.length + beyond;
      word = (word & ~(p.mask << left)) | raw << left;
      ninth = static_cast<std::uint8_t>((ninth & ~mask_of(beyond)) | raw >> (p.length - beyond));
    } else {
      word = (word & ~(p.mask >> beyond)) | raw >> beyond;
      ninth = static_cast<std::uint8_t>((ninth & mask_of(8U - beyond)) | (raw & mask_of(beyond))
                                                                             << (8U - beyond));
    }
  }
  if (intel) {
    store_intel(data, word, p.first_byte);
  } else {
    store_motorola(data, word, p.first_byte);
  }
}

std::uint64_t raw_of(double physical, const SignalPlan& p, bool& saturated) {
  double number = (physical - p.offset) / p.scale;
  if (is_integer(p)) number = std::round(number);
  if (number < p.raw_min) {
    saturated = true;
    return p.raw_min_bits;
  }
  if (number >= p.raw_max) {
    saturated = saturated || number > p.raw_max;
    return p.raw_max_bits;
  }
  return bits_of(number, p);
}

}  // namespace pitwall::can
