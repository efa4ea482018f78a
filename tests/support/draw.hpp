// Random numbers of a distribution, the same with every standard library.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace pitwall::testing {

// [0, 1)
inline double draw_uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

inline double draw_uniform(std::mt19937_64& random, double from, double to) {
  return from + (to - from) * draw_uniform(random);
}

inline double draw_exponential(std::mt19937_64& random, double mean) {
  return -mean * std::log1p(-draw_uniform(random));
}

// Of the mean 0 (Box and Muller).
inline double draw_normal(std::mt19937_64& random, double sigma) {
  const double radius = std::sqrt(-2.0 * std::log1p(-draw_uniform(random)));
  return sigma * radius * std::cos(2.0 * std::numbers::pi * draw_uniform(random));
}

}  // namespace pitwall::testing
