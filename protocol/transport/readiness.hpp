// Wait for readable descriptors with a deadline, and reads without waiting.
//   in     at most kMaxWatched descriptors; negative ones are ignored; a deadline of the clock in
//          use, and the longest wait by the wall clock, because no deadline passes while bench time
//          stands
//   out    bit i set: descriptor i is readable or at its end
//   errors a descriptor that cannot be read counts as ended
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::transport {

inline constexpr std::size_t kMaxWatched = 32;

inline constexpr Duration kNoTimeout{INT64_MAX};

std::uint32_t wait_readable(std::span<const int> descriptors, Instant deadline,
                            Duration longest = kNoTimeout);

struct ReadOutcome {
  std::size_t bytes = 0;
  bool ended = false;  // the other end is closed and everything has been read
};

// Reads the bytes that are available now, without waiting.
ReadOutcome read_available(int descriptor, std::span<std::uint8_t> into);
// The same for a non-blocking descriptor: one system call.
ReadOutcome read_now(int descriptor, std::span<std::uint8_t> into);

}  // namespace pitwall::transport
