// Sequence numbers that wrap around: which of two is newer, and the whole number of one of which
// only the low bits are sent.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pitwall {

// Of the `size` numbers, the half that follows `than` is newer.
constexpr bool is_newer(std::uint32_t number, std::uint32_t than, std::uint32_t size) {
  const std::uint32_t ahead = (number + size - than) % size;
  return ahead != 0 && ahead <= size / 2;
}

// The number nearest to `near` with these low 32 bits; never negative.
constexpr std::uint64_t whole_number(std::uint32_t low, std::uint64_t near) {
  constexpr std::uint64_t kTurn = std::uint64_t{1} << 32, kHalf = kTurn / 2;
  const std::uint64_t same_turn = (near & ~(kTurn - 1)) | low;
  if (same_turn + kHalf < near) return same_turn + kTurn;
  if (same_turn > near + kHalf && same_turn >= kTurn) return same_turn - kTurn;
  return same_turn;
}

}  // namespace pitwall
