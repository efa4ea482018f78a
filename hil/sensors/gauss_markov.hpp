// Wandering error: a first-order Gauss-Markov process of unit variance, sampled at any intervals.
//   invariants
//          w' = k w + sqrt(1 - k^2) n, k = exp(-dt / tau): stationary; its correlation falls to 1/e
//          within tau for any step lengths
//   source Gelb (ed.), Applied Optimal Estimation (1974), section 3.8
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "hil/sensors/noise.hpp"

namespace pitwall::sensors {

template <std::size_t Size>
struct GaussMarkov {
  std::array<double, Size> value{};

  void begin(Noise& noise) {
    for (double& v : value) v = noise.normal();
  }
  void advance(Noise& noise, double dt_s, double correlation_s) {
    const double decay = std::exp(-dt_s / correlation_s);
    const double noise_gain = std::sqrt(1.0 - decay * decay);
    for (double& v : value) v = decay * v + noise_gain * noise.normal();
  }
};

}  // namespace pitwall::sensors
