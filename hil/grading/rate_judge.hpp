// Judge of `rate`: a condition on how fast a signal changes, at every tick of the window. The rate
// at a tick is the absolute change per second since the newest tick of the window that is at least
// `span` earlier; zero: since the one before.
//   margin the least over the ticks that have such an earlier one, in the unit of the signal per
//          second; +infinity without one
//   errors a tick with a NaN fails, with the margin -infinity, earlier one or not: across it nobody
//          knows how fast the signal changed. A window without two ticks that far apart fails
//   cost   constant for each tick on average; 16 bytes for each millisecond of `span`. Ticks that
//          come more often are compared, but not all kept to compare with
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "hil/grading/expectation.hpp"
#include "hil/grading/verdict.hpp"

namespace pitwall::grading {

class RateJudge {
 public:
  explicit RateJudge(const Expectation& expectation);

  void observe(const Tick& tick);
  Verdict verdict() const;
  ExpectationState state() const;

 private:
  struct Sample {
    Instant at{};
    double value = kUnset;
  };

  const Sample* earlier_than(Instant now);
  void keep(const Tick& tick);
  const Sample& kept(std::size_t age_rank) const;  // 0: the oldest

  Condition condition_;
  Duration span_;
  std::vector<Sample> ring_;
  std::size_t oldest_ = 0, count_ = 0;
  Verdict so_far_;
};

}  // namespace pitwall::grading
