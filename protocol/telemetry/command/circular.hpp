// Comparison of sequence numbers that wrap around: which of two is newer.
//   invariants
//          of `size` numbers the half that follows `than` is newer
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pitwall::telemetry {

constexpr bool is_newer(std::uint32_t number, std::uint32_t than, std::uint32_t size) {
  const std::uint32_t ahead = (number + size - than) % size;
  return ahead != 0 && ahead <= size / 2;
}

}  // namespace pitwall::telemetry
