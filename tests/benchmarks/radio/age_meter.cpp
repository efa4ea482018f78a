// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/age_meter.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::radio {

void AgeMeter::reset() {
  state_ = {};
  ages_.fill(state_);
}

void AgeMeter::add(Ages& ages, Duration age) {
  ages.bins_ms.add(age.milliseconds());
  ages.worst = std::max(ages.worst, age);
}

Duration AgeMeter::quantile(const Ages& ages, double q) {
  return milliseconds(static_cast<std::int64_t>(ages.bins_ms.quantile(q)));
}

}  // namespace pitwall::radio
