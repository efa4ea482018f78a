// Waits until one of a few descriptors has something to read, or a deadline passes.
//   in     at most kMaxWatched descriptors; negative ones are ignored
//   out    bit i set: descriptor i is readable or at its end
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::transport {

inline constexpr std::size_t kMaxWatched = 32;

std::uint32_t wait_readable(std::span<const int> descriptors, Instant deadline);

}  // namespace pitwall::transport
