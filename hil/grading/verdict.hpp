// What the judge of an expectation gets at each tick, and what it says of it. A judge is a class
// with observe(Tick), verdict() and state(); it leaves name, text and pass of its verdict to the
// grader.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "protocol/vocabulary/text.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::grading {

struct Tick {
  Instant at{};
  double value = kUnset;  // of the condition's signal
  double other = kUnset;  // of the signal of trigger or release; else as `value`
  bool in_window = false;
};

struct Verdict {
  std::string name, text;  // name and sentence of the expectation
  std::string reason;      // empty when passed
  bool pass = false;
  double margin = 0.0;                // in the unit of the signal; negative is a violation
  std::optional<Duration> time_left;  // within, after: smallest time left between success and limit
  std::optional<Instant> first_violation;  // from here on it has failed, whatever comes
  std::uint64_t ticks = 0;                 // graded
  std::uint64_t undefined = 0;             // of these, ticks with a NaN
  std::uint64_t triggers = 0;              // after: number of triggers
  std::optional<Duration> delay;  // detects: from the fault to the first tick that detects it
};

// State of an expectation during the run: undecided, held so far, failed for good.
enum class ExpectationState : std::uint8_t { kOpen, kHolds, kFailed };

// "3.010 s"
inline std::string at_text(Instant at) { return formatted("%.3f s", at.seconds()); }

inline constexpr const char* kNoTick = "no tick in its window";

}  // namespace pitwall::grading
