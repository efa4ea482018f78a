// Bus of 500 kbit/s for tests: the length of a bit, and frames.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::can_bus {

inline constexpr Duration kBit = nanoseconds(2000);

inline can::Frame frame_of(std::uint32_t id, std::uint8_t length = 8, std::uint8_t fill = 0x5A) {
  can::Frame f;
  f.id = id;
  f.length = length;
  std::fill_n(f.data.begin(), length, fill);
  return f;
}

}  // namespace pitwall::can_bus
