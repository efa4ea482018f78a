// Quantiles of measured durations: median, 99th percentile, maximum.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace pitwall::benchmarks {

// All zeros for an empty list.
struct Quantiles {
  double p50_us = 0.0, p99_us = 0.0, worst_us = 0.0;
  std::size_t count = 0;
};
Quantiles quantiles_of(std::vector<double> took_us);

}  // namespace pitwall::benchmarks
