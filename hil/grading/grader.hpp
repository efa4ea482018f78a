// Grader of a run, tick by tick, against a list of expectations. Each kind has a judge in a file of
// its own, which states its rules.
//   in     create(expectations, names of the signals); observe(now, one value per name) at each
//          tick, in order of time
//   out    finish(): one verdict per expectation, in order
//   errors create(): a Problem that names the expectation: unknown signal, number that is not
//          finite, missing limit, window that ends before it begins
//   cost   observe() does not allocate, but for a `quantile` (quantile_judge.hpp)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "hil/grading/after_judge.hpp"
#include "hil/grading/always_judge.hpp"
#include "hil/grading/detects_judge.hpp"
#include "hil/grading/expectation.hpp"
#include "hil/grading/quantile_judge.hpp"
#include "hil/grading/rate_judge.hpp"
#include "hil/grading/until_judge.hpp"
#include "hil/grading/verdict.hpp"
#include "hil/grading/within_judge.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::grading {

class Grader {
 public:
  static Result<Grader, Problem> create(std::vector<Expectation> expectations,
                                        std::span<const std::string> signal_names);

  void observe(Instant now, std::span<const double> values);
  std::vector<Verdict> finish() const;
  std::vector<ExpectationState> expectation_states() const;  // in order; an undecided one is kOpen

 private:
  using Judge = std::variant<AlwaysJudge, WithinJudge, DetectsJudge, AfterJudge, UntilJudge,
                             RateJudge, QuantileJudge>;
  struct Judged {
    Expectation expectation;
    std::size_t signal;        // index of the condition's
    std::size_t other_signal;  // of trigger or release; else that of the condition
    Judge judge;
  };

  Grader() = default;
  static Judge judge_of(const Expectation& expectation);

  std::vector<Judged> judged_;
  std::size_t signals_ = 0;
};

}  // namespace pitwall::grading
