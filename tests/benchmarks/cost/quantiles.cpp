// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/cost/quantiles.hpp"

#include <algorithm>

#include "protocol/vocabulary/quantile.hpp"

namespace pitwall::benchmarks {

Quantiles quantiles_of(std::vector<double> took_us) {
  if (took_us.empty()) return {};
  std::sort(took_us.begin(), took_us.end());
  const auto at = [&took_us](double q) { return took_us[nearest_rank(q, took_us.size())]; };
  return {at(0.5), at(0.99), took_us.back(), took_us.size()};
}

}  // namespace pitwall::benchmarks
