// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/cost/reference_cost.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/transport/clock.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::cost {

double microseconds_of(Duration duration) { return 1e-3 * static_cast<double>(duration.ns); }

double ReferenceCost::take() {
  const Duration begun = transport::thread_time();
  CHECK(std::isfinite(kernel_.run()));
  const Duration warm = transport::thread_time();
  CHECK(std::isfinite(kernel_.run()));
  const Duration took = transport::thread_time() - warm;
  const double unit_us = microseconds_of(took);
  if (next_ == units_us_.size()) units_us_.push_back(unit_us);
  units_us_[next_] = std::min(units_us_[next_], unit_us);
  ++next_;
  spent_ = spent_ + (warm - begun) + took;
  return unit_us;
}

double ReferenceCost::unit_us() const {
  if (units_us_.empty()) return 0.0;
  std::vector<double> sorted = units_us_;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

}  // namespace pitwall::cost
