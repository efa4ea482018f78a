// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/age_meter.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::radio {

void AgeMeter::reset() {
  state_ = {.bins = std::vector<std::uint32_t>(kBins, 0), .looks = 0, .worst = {}};
  ages_.fill(state_);
}

void AgeMeter::add(Ages& ages, Duration age) {
  const std::int64_t bin = std::clamp<std::int64_t>(age / milliseconds(1), 0, kBins - 1);
  ++ages.bins[static_cast<std::size_t>(bin)];
  ++ages.looks;
  ages.worst = std::max(ages.worst, age);
}

Duration AgeMeter::quantile(const Ages& ages, double q) {
  const auto wanted = static_cast<std::uint64_t>(std::ceil(q * static_cast<double>(ages.looks)));
  std::uint64_t seen = 0;
  for (std::size_t bin = 0; bin < kBins && wanted > 0; ++bin) {
    seen += ages.bins[bin];
    if (seen >= wanted) return milliseconds(static_cast<std::int64_t>(bin) + 1);
  }
  return {};
}

}  // namespace pitwall::radio
