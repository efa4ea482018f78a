// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/grader.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::grading {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double margin_of(const Condition& c, double value) {
  return margin(c.op, value, c.number, c.tolerance);
}

bool met(const Condition& c, double value) { return holds(c.op, value, c.number, c.tolerance); }

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
  if (const auto defect = defect_of(e.condition, names)) return defect;
  if (e.kind == Kind::kAfter)
    if (const auto defect = defect_of(e.trigger, names)) return defect;
  if (e.kind == Kind::kDetects && !e.from) return "needs the instant of its fault";
  const bool timed = e.kind == Kind::kWithin || e.kind == Kind::kAfter || e.kind == Kind::kDetects;
  if (timed && e.limit.ns <= 0) return "needs a time limit above zero";
  if (e.from && e.to && *e.to < *e.from) return "its window ends before it begins";
  return std::nullopt;
}

void keep_least(std::optional<Duration>& least, Duration d) {
  if (!least || d < *least) least = d;
}

std::string at_text(Instant at) { return formatted(" at %.3f s", at.seconds()); }

}  // namespace

Result<Grader, Problem> Grader::create(std::vector<Expectation> expectations,
                                       std::span<const std::string> signal_names) {
  Grader grader;
  for (std::size_t i = 0; i < expectations.size(); ++i) {
    const Expectation& e = expectations[i];
    std::string place = "expect[" + std::to_string(i) + "]";
    if (!e.name.empty()) place += " (" + e.name + ")";
    if (auto defect = defect_of(e, signal_names))
      return Unexpected{Problem{std::move(place), *std::move(defect)}};
    Track t;
    t.signal = *index_of(signal_names, e.condition.signal);
    if (e.kind == Kind::kAfter) t.trigger_signal = *index_of(signal_names, e.trigger.signal);
    t.worst = kInfinity;
    t.best = -kInfinity;
    grader.tracks_.push_back(t);
  }
  grader.expectations_ = std::move(expectations);
  grader.signals_ = signal_names.size();
  return grader;
}

void Grader::observe(Instant now, std::span<const double> values) {
  CHECK(values.size() == signals_);
  for (std::size_t i = 0; i < expectations_.size(); ++i)
    observe_one(expectations_[i], tracks_[i], now, values);
}

void Grader::observe_one(const Expectation& e, Track& t, Instant now,
                         std::span<const double> values) {
  const double value = values[t.signal];
  const bool before = e.from && now < *e.from;
  const bool past = e.to && now > *e.to;
  if (e.kind == Kind::kAfter) {
    // A trigger of the window may be answered after the window; a level that held before it is not
    // a trigger.
    const bool triggered = met(e.trigger, values[t.trigger_signal]);
    const bool rises = triggered && !t.trigger_was && !before && !past;
    t.trigger_was = triggered;
    return observe_after(e, t, now, value, rises);
  }
  if (e.kind == Kind::kDetects && now <= *e.from) {
    t.held_before |= now >= *e.from - kQuiet && met(e.condition, value);
    return;
  }
  if (before || past) return;
  ++t.ticks;
  if (std::isnan(value)) ++t.undefined;
  if (e.kind == Kind::kWithin || e.kind == Kind::kDetects) return observe_within(e, t, now, value);

  const bool wanted = e.kind == Kind::kAlways;
  const bool good = !std::isnan(value) && met(e.condition, value) == wanted;
  const double m = margin_of(e.condition, value);
  t.worst = std::min(t.worst, wanted || std::isnan(value) ? m : -m);
  if (good) return;
  t.failed = true;
  if (!t.first_violation) t.first_violation = now;
}

void Grader::observe_within(const Expectation& e, Track& t, Instant now, double value) {
  if (t.ticks == 1) t.deadline = e.from.value_or(Instant{}) + e.limit;
  if (now > t.deadline) {
    if (!t.held && !t.failed) {
      t.failed = true;
      t.first_violation = t.deadline;
    }
    return;
  }
  t.best = std::max(t.best, margin_of(e.condition, value));
  if (t.held || !met(e.condition, value)) return;
  t.held = true;
  t.time_left = t.deadline - now;
}

// Only the oldest unanswered trigger is kept: an answer to it answers those that came later too,
// and when it fails the expectation has failed.
void Grader::observe_after(const Expectation& e, Track& t, Instant now, double value, bool rises) {
  if (t.pending && now > t.deadline) {
    t.failed = true;
    t.pending = false;
    ++t.decided;
    t.worst = std::min(t.worst, t.best);
    if (!t.first_violation) t.first_violation = t.deadline;
  }
  if (rises) {
    ++t.triggers;
    if (!t.pending) {
      t.pending = true;
      t.deadline = now + e.limit;
      t.best = -kInfinity;
    }
  }
  if (!t.pending) return;
  ++t.ticks;
  if (std::isnan(value)) ++t.undefined;
  t.best = std::max(t.best, margin_of(e.condition, value));
  if (!met(e.condition, value)) return;
  t.pending = false;
  ++t.decided;
  t.worst = std::min(t.worst, t.best);
  keep_least(t.time_left, t.deadline - now);
}

Verdict Grader::verdict(const Expectation& e, const Track& t) {
  Verdict v;
  v.name = e.name;
  v.text = to_string(e);
  v.time_left = t.time_left;
  v.first_violation = t.first_violation;
  v.ticks = t.ticks;
  v.undefined = t.undefined;
  v.triggers = t.triggers;
  const bool within = e.kind == Kind::kWithin || e.kind == Kind::kDetects;
  if (e.kind == Kind::kDetects && t.held) v.delay = e.limit - *t.time_left;
  v.margin = within ? t.best : t.worst;
  if (t.failed)
    v.reason = std::string(e.kind == Kind::kAlways || e.kind == Kind::kNever ? "violated"
                                                                             : "did not hold by") +
               at_text(*t.first_violation);
  else if (e.kind == Kind::kAfter && t.triggers == 0)
    v.reason = "the trigger never came";
  else if (e.kind == Kind::kAfter && t.decided == 0)
    v.reason = "the run ended before the limit had passed";
  else if (t.held_before)
    v.reason = "it held before the fault began";
  else if (e.kind != Kind::kAfter && t.ticks == 0)
    v.reason = "no tick in its window";
  else if (within && !t.held)
    v.reason = "the run ended and it had not held";
  v.pass = v.reason.empty();
  return v;
}

std::vector<Verdict> Grader::finish() const {
  std::vector<Verdict> verdicts;
  verdicts.reserve(expectations_.size());
  for (std::size_t i = 0; i < expectations_.size(); ++i)
    verdicts.push_back(verdict(expectations_[i], tracks_[i]));
  return verdicts;
}

ExpectationState Grader::state_of(const Expectation& e, const Track& t) {
  if (t.failed || t.held_before) return ExpectationState::kFailed;
  const bool within = e.kind == Kind::kWithin || e.kind == Kind::kDetects;
  const bool seen = within ? t.held : e.kind == Kind::kAfter ? t.decided > 0 : t.ticks > 0;
  return seen ? ExpectationState::kHolds : ExpectationState::kOpen;
}

std::vector<ExpectationState> Grader::expectation_states() const {
  std::vector<ExpectationState> expectation_states;
  expectation_states.reserve(expectations_.size());
  for (std::size_t i = 0; i < expectations_.size(); ++i)
    expectation_states.push_back(state_of(expectations_[i], tracks_[i]));
  return expectation_states;
}

}  // namespace pitwall::grading
