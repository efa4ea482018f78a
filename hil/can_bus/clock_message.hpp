// Message between the bench times of a guest and its host. The guest sends its present time, or
// Instant::max() at the end of the run; the host returns the time that it has followed.
//   units  eight bytes, least significant first: nanoseconds of the guest's bench time
//   errors nullopt for a message of another length
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/vocabulary/bytes.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::can_bus {

// Device of the guest.
inline constexpr const char* kClockLine = "/dev/ttyS3";

using ClockMessage = std::array<std::uint8_t, 8>;

constexpr ClockMessage encode_clock(Instant at) {
  ClockMessage word{};
  store(word, static_cast<std::uint64_t>(at.ns));
  return word;
}

constexpr std::optional<Instant> decode_clock(std::span<const std::uint8_t> word) {
  if (word.size() != ClockMessage{}.size()) return std::nullopt;
  return Instant{static_cast<std::int64_t>(load(word))};
}

}  // namespace pitwall::can_bus
