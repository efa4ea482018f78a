// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/lateness_histogram.hpp"

#include <algorithm>

namespace pitwall::replay {

void LatenessHistogram::add(Duration lateness) {
  cells_us_.add(static_cast<double>(lateness.ns) / 1e3);
  latest_ = std::max(latest_, lateness);
  earliest_ = std::min(earliest_, lateness);
}

Duration LatenessHistogram::quantile(double share) const {
  if (count() == 0) return {};
  const auto edge_us = static_cast<std::int64_t>(cells_us_.quantile(share));
  return edge_us > static_cast<std::int64_t>(kCells) ? latest_ : microseconds(edge_us);
}

}  // namespace pitwall::replay
