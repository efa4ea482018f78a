// A sweep with results that no bench made, for tests of its page.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "hil/report/sweep/parameter_axis.hpp"
#include "hil/report/sweep/sweep_run.hpp"
#include "tests/hil/sweep/plan_text.hpp"

namespace pitwall::report {

inline const std::string kGrip = "always grip < 1", kWind = "never wind > 2";

inline sweep::Cases cases_of(const std::string& plan) {
  return sweep::Cases{*sweep::read_plan(plan, "p.yaml")};
}

inline sweep::Cases some_cases(std::size_t count = 40) {
  return cases_of(
      sweep::spoilt(sweep::drawn_plan(), "cases: 40", "cases: " + std::to_string(count)));
}

// The margin of kGrip is the friction less `least_friction`; kWind always holds, by 3.
inline std::vector<sweep::CaseResult> some_results(const sweep::Cases& cases,
                                                   double least_friction = 0.7) {
  std::vector<sweep::CaseResult> results;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const double margin = number_of(cases.at(i).settings[0].value) - least_friction;
    results.push_back(
        {.number = i,
         .verdict = margin < 0.0 ? sweep::CaseVerdict::kFailed : sweep::CaseVerdict::kPassed,
         .digest = "d" + std::to_string(margin),
         .simulated_s = 36.0,
         .margins = {{kGrip, margin, margin >= 0.0}, {kWind, 3.0, true}}});
  }
  return results;
}

inline std::size_t failures_of(const std::vector<sweep::CaseResult>& results) {
  std::size_t count = 0;
  for (const sweep::CaseResult& of : results) count += of.verdict != sweep::CaseVerdict::kPassed;
  return count;
}

// How often the part is in the text.
inline std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

}  // namespace pitwall::report
