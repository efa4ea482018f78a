// Grader of a run, tick by tick, against a list of expectations.
//   in     create(expectations, names of the signals); observe(now, one value per name) at each
//          tick, in order of time
//   out    finish(): one verdict per expectation, in order
//   rules  always, never: a window without a tick fails, because it proves nothing
//          within: fails at the first tick after the limit, or at the end if it never held
//          detects: likewise; a tick exactly at the time of the fault counts as before it, and a
//          condition that held at any tick of the kQuiet before the fault fails
//          after: fails without any trigger. A trigger whose limit has not passed at the end of the
//          run does not count, unless it is the only one
//   margin the smallest over ticks (always, never) or over triggers (after), of the best within the
//          time limit (within, after); +-infinity without a tick
//   errors create(): a Problem that names the expectation: unknown signal, number that is not
//          finite, missing limit, window that ends before it begins
//   cost   observe() does not allocate
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hil/grading/expectation.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::grading {

struct Verdict {
  std::string name, text;  // name and sentence of the expectation
  std::string reason;      // empty when passed
  bool pass = false;
  double margin = 0.0;                // in the unit of the signal; negative is a violation
  std::optional<Duration> time_left;  // within, after: smallest time left between success and limit
  std::optional<Instant> first_violation;
  std::uint64_t ticks = 0;        // graded
  std::uint64_t undefined = 0;    // of these, ticks with a NaN
  std::uint64_t triggers = 0;     // after: number of triggers
  std::optional<Duration> delay;  // detects: from the fault to the first tick that detects it
};

// State of an expectation during the run: undecided, held so far, failed for good.
enum class ExpectationState : std::uint8_t { kOpen, kHolds, kFailed };

class Grader {
 public:
  static Result<Grader, Problem> create(std::vector<Expectation> expectations,
                                        std::span<const std::string> signal_names);

  void observe(Instant now, std::span<const double> values);
  std::vector<Verdict> finish() const;
  std::vector<ExpectationState> expectation_states() const;  // in order; an undecided one is kOpen

 private:
  struct Track {
    std::size_t signal = 0, trigger_signal = 0;
    double worst = 0.0;  // always, never: smallest so far; after: smallest over decided triggers
    double best = 0.0;   // within, after: best since the window or trigger opened
    bool held = false, failed = false, pending = false, trigger_was = false;
    bool held_before = false;
    Instant deadline{};
    std::optional<Duration> time_left;
    std::optional<Instant> first_violation;
    std::uint64_t ticks = 0, undefined = 0, triggers = 0, decided = 0;
  };

  Grader() = default;
  void observe_one(const Expectation& e, Track& t, Instant now, std::span<const double> values);
  void observe_within(const Expectation& e, Track& t, Instant now, double value);
  void observe_after(const Expectation& e, Track& t, Instant now, double value, bool rises);
  static Verdict verdict(const Expectation& e, const Track& t);
  static ExpectationState state_of(const Expectation& e, const Track& t);

  std::vector<Expectation> expectations_;
  std::vector<Track> tracks_;
  std::size_t signals_ = 0;
};

}  // namespace pitwall::grading
