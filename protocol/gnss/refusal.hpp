// Reasons to refuse a complete log, and a counter per reason.
//   invariants
//          a log is decoded completely or refused with one reason; no value is repaired
//   order  if several reasons apply, the one that occurs first in the log counts
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string_view>

namespace pitwall::gnss {

enum class DecodeError : std::uint8_t {
  kUnknownId,          // a log without a decoder
  kResponse,           // a response to a command
  kNotBinary,          // a binary header that announces another format
  kTooShort,           // fewer bytes or fields than the log has
  kBadText,            // ASCII: a field that cannot be read
  kNotFinite,          // NaN or infinite
  kNegativeDeviation,  // a standard deviation or uncertainty below zero
  kLatitude,           // beyond +-90 degrees
  kLongitude,          // beyond +-180 degrees (VectorNav and NovAtel both count from -180)
  kTimeOfWeek,         // seconds outside the week
  kTooMany,            // more entries of a list than supported
};

inline constexpr std::array<std::string_view, 11> kDecodeErrorText{
    "log that is not decoded",
    "response to a command",
    "binary header that announces another format",
    "shorter than the log is",
    "ASCII field that cannot be read",
    "number that is not finite",
    "negative standard deviation",
    "latitude beyond 90 degrees",
    "longitude beyond 180 degrees",
    "time outside the week",
    "more entries than are read",
};

constexpr std::string_view text(DecodeError e) {
  return kDecodeErrorText[static_cast<std::size_t>(e)];
}

// Number of refusals by reason.
struct Refusals {
  std::array<std::uint64_t, kDecodeErrorText.size()> counts{};

  void count(DecodeError e) { ++counts[static_cast<std::size_t>(e)]; }
  std::uint64_t of(DecodeError e) const { return counts[static_cast<std::size_t>(e)]; }
  std::uint64_t total() const {
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  }
  bool operator==(const Refusals&) const = default;
};

}  // namespace pitwall::gnss
