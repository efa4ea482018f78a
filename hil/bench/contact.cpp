// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/contact.hpp"

#include <string>
#include <utility>
#include <vector>

#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::bench {
namespace {

// Takes out what the run ended too early for.
void end_judging(const scenario::Scenario& scenario, RunResult& result) {
  CHECK(result.verdicts.size() == scenario.expect.size());
  const Duration end = result.outcome.last->at - Instant{};
  std::vector<grading::Verdict> shown;
  for (std::size_t i = 0; i < result.verdicts.size(); ++i) {
    grading::Verdict& verdict = result.verdicts[i];
    const bool at_once = scenario.expect[i].kind == scenario::ExpectKind::kWithin ||
                         scenario.expect[i].kind == scenario::ExpectKind::kDetects;
    if ((at_once && verdict.pass) || scenario::is_shown_by(scenario.expect[i], end))
      shown.push_back(std::move(verdict));
    else
      result.remarks.push_back("not judged, the car hit a wall before: " + verdict.text);
  }
  result.verdicts = std::move(shown);
}

grading::Verdict contact_verdict(const scenario::Scenario& scenario, const Outcome& outcome) {
  const double bound_mps = scenario.contact ? scenario.contact->at_most_mps : 0.0;
  grading::Verdict verdict;
  verdict.name = kContactVerdict;
  verdict.text = "no contact";
  if (scenario.contact) verdict.text = formatted("no contact above %.1f m/s", bound_mps);
  verdict.pass = true;
  verdict.margin = bound_mps;
  verdict.ticks = 1;
  if (!has_contact(outcome)) return verdict;
  verdict.margin = bound_mps - outcome.last->speed_mps;
  verdict.pass = scenario.contact && verdict.margin >= 0.0;
  if (verdict.pass) return verdict;
  verdict.reason = "CONTACT: " + to_text(outcome);
  verdict.first_violation = outcome.last->at;
  return verdict;
}

}  // namespace

void judge_contact(const scenario::Scenario& scenario, RunResult& result) {
  if (has_contact(result.outcome)) end_judging(scenario, result);
  if (has_contact(result.outcome) || scenario.contact)
    result.verdicts.push_back(contact_verdict(scenario, result.outcome));
}

}  // namespace pitwall::bench
