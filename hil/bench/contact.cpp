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
void end_judging(const scenario::Scenario& scenario, RunResult& result, Instant at,
                 const char* what) {
  CHECK(result.verdicts.size() == scenario.expect.size());
  std::vector<grading::Verdict> shown;
  for (std::size_t i = 0; i < result.verdicts.size(); ++i) {
    grading::Verdict& verdict = result.verdicts[i];
    const grading::Expectation& asked = scenario.expect[i];
    const bool is_final =
        verdict.pass ? grading::is_met_once(asked.kind) : verdict.first_violation.has_value();
    if (is_final || grading::is_shown_by(asked, at))
      shown.push_back(std::move(verdict));
    else
      result.remarks.push_back(std::string{"not judged, the car "} + what +
                               " before: " + verdict.text);
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

grading::Verdict car_contact_verdict(const std::optional<CarContact>& contact) {
  grading::Verdict verdict;
  verdict.name = kCarContactVerdict;
  verdict.text = "no contact with another car that this car causes";
  verdict.pass = !contact || !contact->is_caused;
  verdict.margin = verdict.pass ? 0.0 : -contact->closing_mps;
  verdict.ticks = 1;
  if (verdict.pass) return verdict;
  verdict.reason = "CONTACT: " + to_text(*contact);
  verdict.first_violation = contact->at;
  return verdict;
}

}  // namespace

void judge_contact(const scenario::Scenario& scenario, RunResult& result) {
  if (has_contact(result.outcome))
    end_judging(scenario, result, result.outcome.last->at, "hit a wall");
  else if (result.car_contact)
    end_judging(scenario, result, result.car_contact->at, "had a contact with another one");
  if (has_contact(result.outcome) || scenario.contact)
    result.verdicts.push_back(contact_verdict(scenario, result.outcome));
  if (result.other_cars > 0) result.verdicts.push_back(car_contact_verdict(result.car_contact));
}

}  // namespace pitwall::bench
