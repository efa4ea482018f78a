// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/lateness_histogram.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::replay {

void LatenessHistogram::add(Duration lateness) {
  const std::int64_t cell_us = std::max<std::int64_t>(lateness.ns, 0) / 1'000;
  ++cells_[std::min(static_cast<std::size_t>(cell_us), kCells)];
  ++count_;
  latest_ = std::max(latest_, lateness);
  earliest_ = std::min(earliest_, lateness);
}

Duration LatenessHistogram::quantile(double share) const {
  const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
  std::uint64_t seen = 0;
  for (std::size_t cell = 0; cell < kCells; ++cell) {
    seen += cells_[cell];
    if (seen >= wanted && seen > 0) return microseconds(static_cast<std::int64_t>(cell) + 1);
  }
  return count_ == 0 ? Duration{} : latest_;
}

}  // namespace pitwall::replay
