// Record of the waits of bench time: number, length, and the process of the longest one.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::transport {

struct ClockWaits {
  std::uint64_t count = 0;
  Duration total{}, longest{};  // by the wall clock
  Instant longest_at{};         // bench time
  std::string longest_for;      // name of the process; empty: the bench itself had no processor
};

}  // namespace pitwall::transport
