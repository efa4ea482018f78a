// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/checks/stamp_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pitwall::localization {

double StampWatch::spacing_s(Instant at) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < size; ++i)
    least = std::min(least, std::abs((at - used[i]).seconds()));
  return least;
}

double StampWatch::after_newest_s(Instant at) const {
  return size == 0 ? std::numeric_limits<double>::infinity() : (at - newest).seconds();
}

void StampWatch::use(Instant at) {
  newest = size == 0 ? at : std::max(newest, at);
  used[next] = at;
  next = (next + 1) % kStampsKept;
  size = std::min(size + 1, kStampsKept);
}

}  // namespace pitwall::localization
