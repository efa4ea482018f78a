// Judge of `until`, the strong until of temporal logic with a limit: the condition at every tick of
// the window until its release first holds, which it does at most so long after the window opens.
//   margin sup over ticks t of min(margin of the release at t, inf over earlier ticks of the margin
//          of the condition), up to the limit; -infinity without a tick
//   errors a NaN before the release fails; so does a run that ends before the release
//   source robust semantics of the until operator: Fainekos and Pappas 2009
//   cost   constant for each tick
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "hil/grading/expectation.hpp"
#include "hil/grading/verdict.hpp"

namespace pitwall::grading {

class UntilJudge {
 public:
  explicit UntilJudge(const Expectation& expectation);

  void observe(const Tick& tick);
  Verdict verdict() const;
  ExpectationState state() const;

 private:
  Condition condition_, release_;
  Instant deadline_;
  double least_ = std::numeric_limits<double>::infinity();  // of the condition, at earlier ticks
  bool is_late_ = false;                                    // the limit passed without a release
  Verdict so_far_;                                          // time_left: set by the release
};

}  // namespace pitwall::grading
