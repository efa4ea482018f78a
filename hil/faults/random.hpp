// The bench's own random numbers: the same on every machine and at every optimisation level.
//   invariants
//          one seed, one sequence; uniform() lies in [0, 1)
//   source SplitMix64 (Steele, Lea, Flood 2014)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pitwall::faults {

struct Random {
  std::uint64_t state = 0;

  constexpr std::uint64_t next() {
    state += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = state;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }
  constexpr double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  // 0 .. n-1; the bias of the modulus is below 2^-50 for the small n used here.
  constexpr std::uint64_t below(std::uint64_t n) { return next() % n; }
};

}  // namespace pitwall::faults
