// Random number generator with the same sequence on every platform: xoshiro256** seeded by
// splitmix64, normal deviates by the polar method. The distributions of the standard library differ
// between implementations.
//   source Blackman and Vigna, "Scrambled linear pseudorandom number generators" (2021);
//          Marsaglia and Bray (1964)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "protocol/vocabulary/random.hpp"

namespace pitwall::sensors {

class Noise {
 public:
  Noise() : Noise(0, 0) {}
  // Streams of one seed are independent of each other.
  Noise(std::uint64_t seed, std::uint64_t stream) {
    Random seeds{seed ^ (stream * 0xD1342543DE82EF95ULL + 0x2545F4914F6CDD1DULL)};
    for (std::uint64_t& word : word_) word = seeds.next();
  }

  std::uint64_t next() {
    const std::uint64_t result = std::rotl(word_[1] * 5, 7) * 9;
    const std::uint64_t shifted = word_[1] << 17;
    word_[2] ^= word_[0];
    word_[3] ^= word_[1];
    word_[1] ^= word_[2];
    word_[0] ^= word_[3];
    word_[2] ^= shifted;
    word_[3] = std::rotl(word_[3], 45);
    return result;
  }

  // In [0, 1).
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

  // Mean 0, standard deviation 1. Discards the second deviate of each pair, so that the state is
  // only the four words.
  double normal() {
    for (;;) {
      const double u = 2.0 * uniform() - 1.0, v = 2.0 * uniform() - 1.0;
      const double q = u * u + v * v;
      if (q > 0.0 && q < 1.0) return u * std::sqrt(-2.0 * std::log(q) / q);
    }
  }

 private:
  std::array<std::uint64_t, 4> word_;
};

}  // namespace pitwall::sensors
