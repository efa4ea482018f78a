// Judge of `always` and `never`: a condition, or its negation, at every tick of the window.
//   margin the least over the ticks; +infinity without one
//   errors a window without a tick fails, because it proves nothing; a tick with a NaN fails
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/grading/expectation.hpp"
#include "hil/grading/verdict.hpp"

namespace pitwall::grading {

class AlwaysJudge {
 public:
  explicit AlwaysJudge(const Expectation& expectation);

  void observe(const Tick& tick);
  Verdict verdict() const;
  ExpectationState state() const;

 private:
  Condition condition_;
  bool wanted_;  // false: never
  Verdict so_far_;
};

}  // namespace pitwall::grading
