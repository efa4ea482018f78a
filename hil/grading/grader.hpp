// Grader of a run, tick by tick, against a list of expectations.
//   in     create(expectations, names of the signals); observe(now, one value per name)
//          at each tick, in order of time
//   out    finish(): one verdict per expectation, in order
//   rules  always, never: a window without a tick fails (nothing was shown)
//          within: fails at the first tick after the limit, or at the end if it never held
//          detects: likewise; a tick at the very instant of the fault comes before it, and what
//          held at any tick of the kQuiet before fails it
//          after: the trigger must come at least once, else it fails; a trigger whose limit had
//          not passed when the run ended does not count, unless it was the only one
//   margin the least over ticks (always, never) or over triggers (after), of the best in the time
//          allowed (within, after); +-infinity where no tick was seen
//   errors create(): unknown signal, number that is not finite, missing limit, window that ends
//          before it begins: a Problem that names the expectation
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
  std::string name, text;  // the expectation's name and its sentence
  std::string reason;      // empty when passed
  bool pass = false;
  double margin = 0.0;                // in the unit of the signal; negative is a violation
  std::optional<Duration> time_left;  // within, after: least time between success and limit
  std::optional<Instant> first_violation;
  std::uint64_t ticks = 0;        // judged
  std::uint64_t undefined = 0;    // of these with a NaN
  std::uint64_t triggers = 0;     // after: how often it came
  std::optional<Duration> delay;  // detects: from the fault to the first tick that sees it
};

// Of an expectation while the run goes on: nothing seen yet, held so far, failed for good.
enum class Standing : std::uint8_t { kOpen, kHolds, kFailed };

class Grader {
 public:
  static Result<Grader, Problem> create(std::vector<Expectation> expectations,
                                        std::span<const std::string> signal_names);

  void observe(Instant now, std::span<const double> values);
  std::vector<Verdict> finish() const;
  std::vector<Standing> standings() const;  // in order; what finish() would make of kOpen is open

 private:
  struct Track {
    std::size_t signal = 0, trigger_signal = 0;
    double worst = 0.0;  // always, never: least so far; after: least over decided triggers
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
  static Standing standing(const Expectation& e, const Track& t);

  std::vector<Expectation> expectations_;
  std::vector<Track> tracks_;
  std::size_t signals_ = 0;
};

}  // namespace pitwall::grading
