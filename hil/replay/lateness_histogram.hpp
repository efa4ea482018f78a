// Histogram of the lateness of frames in microseconds, of fixed size.
//   in     lateness of one frame at a time; early frames count as on time
//   out    quantiles (upper edge of a cell), latest and earliest exactly
//   units  Duration; cells of 1 us up to 20 ms; of larger values only the maximum is kept
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "protocol/vocabulary/quantile.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::replay {

class LatenessHistogram {
 public:
  static constexpr std::size_t kCells = 20'000;
  void add(Duration lateness);
  // Upper edge of the cell that holds the given share of frames (0 < share <= 1).
  Duration quantile(double share) const;
  Duration latest() const { return latest_; }
  Duration earliest() const { return earliest_; }
  std::uint64_t count() const { return cells_us_.count(); }

 private:
  Histogram cells_us_{kCells + 1};
  Duration latest_{INT64_MIN};
  Duration earliest_{INT64_MAX};
};

}  // namespace pitwall::replay
