// Kind of a field in a receiver message: its illegal values and, for NovAtel ASCII, its notation.
//   in     the kind and the value of a field, as sent
//   out    the reason of a refusal; nullopt if the value is accepted
//   invariants
//          a value is refused or accepted unchanged; nothing is clamped, wrapped or replaced
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "protocol/gnss/refusal.hpp"

namespace pitwall::gnss {

enum class Kind : std::uint8_t {
  kNumber,     // finite
  kSigma,      // finite, not negative
  kLatitude,   // degrees
  kLongitude,  // degrees
  kSeconds,    // of the week
  kReserved,   // any value
  kEntries,    // length of the list that follows: at most kMostEntries
  kHex,
  kSolution,  // from here on: names from NovAtel's tables (novatel_names.hpp)
  kPosition,
  kInsStatus,
  kDatum,
  kClock,
  kUtc,
  kImuType,
  kProfile,
  kAlignment,
  kOutputFrame,
  kOffsetFrame,
  kOffset,
  kOffsetSource,
  kTruth,
  kLetter,
  kText,
};

inline constexpr std::size_t kMostEntries = 6;

inline std::optional<DecodeError> check_field(Kind kind, double value) {
  constexpr double kMaxLatitude_deg = 90.0, kMaxLongitude_deg = 180.0, kWeek_s = 604'800.0;
  if (kind == Kind::kReserved) return std::nullopt;
  if (!std::isfinite(value)) return DecodeError::kNotFinite;
  if (kind == Kind::kSigma && value < 0.0) return DecodeError::kNegativeDeviation;
  if (kind == Kind::kLatitude && std::fabs(value) > kMaxLatitude_deg) return DecodeError::kLatitude;
  if (kind == Kind::kLongitude && std::fabs(value) > kMaxLongitude_deg) {
    return DecodeError::kLongitude;
  }
  if (kind == Kind::kSeconds && (value < 0.0 || value > kWeek_s)) return DecodeError::kTimeOfWeek;
  return std::nullopt;
}

// Keeps the first reason to refuse a message while its fields are visited.
class FieldCheck {
 public:
  template <class T>
  void add(Kind kind, T value) {
    if constexpr (std::is_floating_point_v<T>) {
      if (!refusal_) refusal_ = check_field(kind, static_cast<double>(value));
    } else if constexpr (std::is_same_v<T, std::uint32_t>) {
      if (kind == Kind::kEntries && value > kMostEntries) refuse(DecodeError::kTooMany);
    }
  }
  void refuse(DecodeError reason) {
    if (!refusal_) refusal_ = reason;
  }
  const std::optional<DecodeError>& refusal() const { return refusal_; }

 private:
  std::optional<DecodeError> refusal_;
};

}  // namespace pitwall::gnss
