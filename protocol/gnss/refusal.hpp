// Why a log that arrived whole is not used, and how often that happened.
//   invariants
//          a log is decoded whole or refused with one reason; no value is ever repaired
//   order  where several reasons hold, the one that occurs first in the log
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string_view>

namespace pitwall::gnss {

enum class DecodeError : std::uint8_t {
  kUnknownId,          // a log that we do not decode
  kResponse,           // an answer to a command
  kNotBinary,          // a binary header that announces another format
  kTooShort,           // fewer bytes or fields than the log has
  kBadText,            // ASCII: a field that is not what it has to be
  kNotFinite,          // NaN or infinite
  kNegativeDeviation,  // a standard deviation or uncertainty below zero
  kLatitude,           // beyond +-90 degrees
  kLongitude,          // beyond +-180 degrees (VectorNav and NovAtel both count from -180)
  kTimeOfWeek,         // seconds outside the week
  kTooMany,            // more entries of a list than we know of
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

// How often, by reason.
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
