// Judge of `detects`: `within`, counted from a fault at the start of the window.
//   errors a tick exactly at the time of the fault counts as before it, and a condition that held
//          at any tick of the kQuiet before the fault fails
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/grading/expectation.hpp"
#include "hil/grading/verdict.hpp"
#include "hil/grading/within_judge.hpp"

namespace pitwall::grading {

class DetectsJudge {
 public:
  // The expectation has a `from`.
  explicit DetectsJudge(const Expectation& expectation);

  void observe(const Tick& tick);
  Verdict verdict() const;
  ExpectationState state() const;

 private:
  Condition condition_;
  Instant fault_;
  Duration limit_;
  WithinJudge within_;
  bool held_before_ = false;
};

}  // namespace pitwall::grading
