// Age of the newest value at a receiver, sampled each millisecond.
//   in     arrivals in order of time: when the value was made, when it arrived; the time span
//   out    quantiles of the age over all samples; samples before the first arrival count as
//          `unknown`
//   invariants
//          an older value that arrives late does not lower the age
//   units  ms, nearest-rank quantiles
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::link {

inline constexpr Duration kSamplePeriod = milliseconds(1);

class AgeSamples {
 public:
  AgeSamples(Instant from, Instant to) : next_(from), to_(to) {}

  // In order of arrival.
  void arrived(Instant made, Instant at);
  // Takes the samples from the last arrival to the end.
  void finish() { look_until(to_); }

  double quantile_ms(double q) const;
  double max_ms() const { return quantile_ms(1.0); }
  std::size_t looks() const { return ages_us_.size(); }
  std::size_t unknown() const { return unknown_; }

 private:
  void look_until(Instant until);

  Instant next_, to_;
  std::optional<Instant> newest_;  // when the newest value was made
  std::vector<std::int32_t> ages_us_;
  std::size_t unknown_ = 0;
};

}  // namespace pitwall::link
