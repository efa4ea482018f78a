// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/grader.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::grading {
namespace {

std::optional<std::size_t> index_of(std::span<const std::string> names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

std::optional<std::string> defect_of(const Condition& c, std::span<const std::string> names) {
  if (!index_of(names, c.signal)) return "unknown signal \"" + c.signal + "\"";
  if (!std::isfinite(c.number)) return "the number of \"" + c.signal + "\" is not finite";
  if (!(c.tolerance >= 0.0)) return "the tolerance of \"" + c.signal + "\" is negative";
  return std::nullopt;
}

std::optional<std::string> defect_of(const Expectation& e, std::span<const std::string> names) {
  for (const Condition& condition : conditions_of(e))
    if (const auto defect = defect_of(condition, names)) return defect;
  if (e.kind == Kind::kDetects && !e.from) return "needs the instant of its fault";
  if ((is_met_once(e.kind) || e.kind == Kind::kAfter) && e.limit.ns <= 0)
    return "needs a time limit above zero";
  if (e.span.ns < 0) return "its span is negative";
  if (e.kind == Kind::kQuantile && !(e.share > 0.0 && e.share <= 1.0))
    return "needs a share above 0 and at most 1";
  if (e.kind == Kind::kQuantile && !is_ordering(e.condition.op)) return "needs one of: < <= > >=";
  if (e.from && e.to && *e.to < *e.from) return "its window ends before it begins";
  return std::nullopt;
}

}  // namespace

Grader::Judge Grader::judge_of(const Expectation& e) {
  switch (e.kind) {
    case Kind::kAlways:
    case Kind::kNever:
      return AlwaysJudge{e};
    case Kind::kWithin:
      return WithinJudge{e};
    case Kind::kAfter:
      return AfterJudge{e};
    case Kind::kDetects:
      return DetectsJudge{e};
    case Kind::kUntil:
      return UntilJudge{e};
    case Kind::kRate:
      return RateJudge{e};
    case Kind::kQuantile:
      return QuantileJudge{e};
  }
  CHECK(false);
}

Result<Grader, Problem> Grader::create(std::vector<Expectation> expectations,
                                       std::span<const std::string> signal_names) {
  Grader grader;
  grader.signals_ = signal_names.size();
  for (std::size_t i = 0; i < expectations.size(); ++i) {
    Expectation& e = expectations[i];
    std::string place = "expect[" + std::to_string(i) + "]";
    if (!e.name.empty()) place += " (" + e.name + ")";
    if (auto defect = defect_of(e, signal_names))
      return Unexpected{Problem{std::move(place), *std::move(defect)}};
    const std::vector<Condition> conditions = conditions_of(e);
    const std::size_t signal = *index_of(signal_names, conditions.front().signal);
    const std::size_t other_signal = *index_of(signal_names, conditions.back().signal);
    Judge judge = judge_of(e);
    grader.judged_.push_back({std::move(e), signal, other_signal, std::move(judge)});
  }
  return grader;
}

void Grader::observe(Instant now, std::span<const double> values) {
  CHECK(values.size() == signals_);
  for (Judged& one : judged_) {
    const Expectation& e = one.expectation;
    const bool before = e.from && now < *e.from;
    const bool past = e.to && now > *e.to;
    const Tick tick{now, values[one.signal], values[one.other_signal], !before && !past};
    std::visit([&tick](auto& judge) { judge.observe(tick); }, one.judge);
  }
}

std::vector<Verdict> Grader::finish() const {
  std::vector<Verdict> verdicts;
  verdicts.reserve(judged_.size());
  for (const Judged& one : judged_) {
    Verdict verdict = std::visit([](const auto& judge) { return judge.verdict(); }, one.judge);
    verdict.name = one.expectation.name;
    verdict.text = to_string(one.expectation);
    verdict.pass = verdict.reason.empty();
    verdicts.push_back(std::move(verdict));
  }
  return verdicts;
}

std::vector<ExpectationState> Grader::expectation_states() const {
  std::vector<ExpectationState> states;
  states.reserve(judged_.size());
  for (const Judged& one : judged_)
    states.push_back(std::visit([](const auto& judge) { return judge.state(); }, one.judge));
  return states;
}

}  // namespace pitwall::grading
