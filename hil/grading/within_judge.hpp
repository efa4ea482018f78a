// Judge of `within`: a condition at some tick of the window, at most so long after it opens.
//   margin the best up to the limit; -infinity without a tick
//   errors fails at the first tick of the window after the limit, or at the end of the run if it
//          never held
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/grading/expectation.hpp"
#include "hil/grading/verdict.hpp"

namespace pitwall::grading {

class WithinJudge {
 public:
  explicit WithinJudge(const Expectation& expectation);

  void observe(const Tick& tick);
  Verdict verdict() const;
  ExpectationState state() const;

 private:
  Condition condition_;
  Instant deadline_;
  Verdict so_far_;  // time_left: set once it has held
};

}  // namespace pitwall::grading
