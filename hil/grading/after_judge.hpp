// Judge of `after`: each time that a trigger becomes true in the window, a condition within a
// limit.
//   margin the least over the triggers, of the best up to the answer or the limit; +infinity
//          without a trigger
//   errors fails without any trigger. A level that held before the window is no trigger. One whose
//          limit has not passed at the end of the run does not count, unless it is the only one
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "hil/grading/expectation.hpp"
#include "hil/grading/verdict.hpp"

namespace pitwall::grading {

class AfterJudge {
 public:
  explicit AfterJudge(const Expectation& expectation);

  void observe(const Tick& tick);
  Verdict verdict() const;
  ExpectationState state() const;

 private:
  void begin_trigger(Instant at);
  void decide_trigger();

  Condition condition_, trigger_;
  Duration limit_;
  bool trigger_was_ = false, pending_ = false;
  Instant deadline_{};  // of the oldest trigger without an answer
  double best_ = 0.0;   // since then
  std::uint64_t decided_ = 0;
  Verdict so_far_;
};

}  // namespace pitwall::grading
