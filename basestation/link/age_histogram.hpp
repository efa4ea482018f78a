// Histogram of the age of the newest value, weighted by time. Between two packets the age grows
// evenly, so that each interval is spread over the buckets that it crosses.
//   in     intervals of time, and the age at the beginning of each
//   out    quantiles, to one millisecond, and the largest age
//   bound  ages beyond kBuckets milliseconds share the last bucket
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::link {

class AgeHistogram {
 public:
  static constexpr std::size_t kBuckets = 10'000;
  static constexpr Duration kBucket = milliseconds(1);

  void add(Duration from, Duration length);
  bool empty() const { return total_ns_ == 0; }

  // The age that was not exceeded for this fraction of the time; zero if empty.
  Duration quantile(double fraction) const;
  Duration largest() const { return largest_; }

 private:
  std::array<std::int64_t, kBuckets> time_ns_{};
  std::int64_t total_ns_ = 0;
  Duration largest_{};
};

}  // namespace pitwall::link
