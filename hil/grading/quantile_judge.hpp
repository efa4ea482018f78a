// Judge of `quantile`: a condition on the quantile of a signal over the ticks of the window, exact,
// by nearest rank.
//   in     a condition with < <= > or >=
//   margin that of the quantile; -infinity if it is undefined or there is no tick
//   errors a tick with a NaN counts as one that does not meet the condition: as larger than every
//          number for < and <=, as smaller for > and >=. A window without a tick fails
//   cost   8 bytes for each tick, reserved for the window at 100 Hz; ticks that come more often and
//          a window without an end allocate. verdict() copies and selects, the others are constant
//   source protocol/vocabulary/quantile.hpp
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "hil/grading/expectation.hpp"
#include "hil/grading/verdict.hpp"

namespace pitwall::grading {

class QuantileJudge {
 public:
  explicit QuantileJudge(const Expectation& expectation);

  void observe(const Tick& tick);
  Verdict verdict() const;
  ExpectationState state() const;

 private:
  double quantile() const;  // needs a tick
  bool is_met() const;      // whether the quantile meets the condition; needs a tick

  Condition condition_;
  double share_;
  bool is_upper_;  // < or <=
  std::vector<double> values_;
  std::uint64_t met_ = 0, undefined_ = 0;
};

}  // namespace pitwall::grading
