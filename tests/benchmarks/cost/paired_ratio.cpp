// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/cost/paired_ratio.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::cost {

double paired_ratio(std::span<const double> ours, std::span<const double> theirs) {
  CHECK(ours.size() == theirs.size());
  if (ours.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> ratios;
  for (std::size_t i = 0; i < ours.size(); ++i) ratios.push_back(ours[i] / theirs[i]);
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  return *middle;
}

}  // namespace pitwall::cost
