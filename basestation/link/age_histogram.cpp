// SPDX-License-Identifier: Apache-2.0
#include "basestation/link/age_histogram.hpp"

#include <algorithm>

namespace pitwall::link {

void AgeHistogram::add(Duration from, Duration length) {
  if (length.ns <= 0) return;
  from = std::max(from, Duration{});
  const Duration to = from + length;
  largest_ = std::max(largest_, to);
  total_ns_ += length.ns;
  auto bucket =
      static_cast<std::size_t>(std::min(from / kBucket, static_cast<std::int64_t>(kBuckets - 1)));
  for (Duration at = from; at < to; ++bucket) {
    const Duration end =
        bucket + 1 >= kBuckets ? to : std::min(to, kBucket * static_cast<std::int64_t>(bucket + 1));
    time_ns_[bucket] += (end - at).ns;
    at = end;
  }
}

Duration AgeHistogram::quantile(double fraction) const {
  const double wanted_ns = fraction * static_cast<double>(total_ns_);
  std::int64_t below_ns = 0;
  for (std::size_t i = 0; i < kBuckets; ++i) {
    below_ns += time_ns_[i];
    if (time_ns_[i] > 0 && static_cast<double>(below_ns) >= wanted_ns) {
      return std::min(largest_, kBucket * static_cast<std::int64_t>(i + 1));
    }
  }
  return largest_;
}

}  // namespace pitwall::link
