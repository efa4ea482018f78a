// Pseudo-random number generator with the same numbers on every machine and at every optimisation
// level.
//   invariants
//          one seed gives one sequence; uniform() is in [0, 1)
//   source SplitMix64 (Steele, Lea, Flood 2014)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pitwall {

// The output function of SplitMix64: every bit of the result depends on every bit of `z`.
constexpr std::uint64_t mix_bits(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

struct Random {
  std::uint64_t state = 0;

  constexpr std::uint64_t next() {
    state += 0x9E3779B97F4A7C15ULL;
    return mix_bits(state);
  }
  constexpr double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  constexpr double between(double low, double high) { return low + (high - low) * uniform(); }
  // 0 .. n-1; the bias of the modulus is below 2^-50 for the small n used here.
  constexpr std::uint64_t below(std::uint64_t n) { return next() % n; }
  constexpr bool one_in(std::uint64_t n) { return below(n) == 0; }
};

}  // namespace pitwall
