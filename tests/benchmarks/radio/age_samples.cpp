// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/age_samples.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/quantile.hpp"

namespace pitwall::link {

void AgeSamples::arrived(Instant made, Instant at) {
  look_until(at);
  newest_ = newest_ ? std::max(*newest_, made) : made;
}

// What came at the very moment of a look is seen by it.
void AgeSamples::look_until(Instant until) {
  for (const Instant end = std::min(until, to_); next_ < end; next_ += kSamplePeriod) {
    if (newest_) {
      ages_us_.push_back(static_cast<std::int32_t>((next_ - *newest_) / microseconds(1)));
    } else {
      ++unknown_;
    }
  }
}

double AgeSamples::quantile_ms(double q) const {
  if (ages_us_.empty()) return std::nan("");
  std::vector<std::int32_t> sorted = ages_us_;
  const auto rank = static_cast<std::ptrdiff_t>(nearest_rank(q, sorted.size()));
  std::nth_element(sorted.begin(), sorted.begin() + rank, sorted.end());
  return sorted[static_cast<std::size_t>(rank)] * 1e-3;
}

}  // namespace pitwall::link
