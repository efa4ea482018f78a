// Expectations of a scenario as values: conditions on named signals, and when they have to hold.
//   units  of a number: those of its signal; instants since the start of the scenario
//   invariants
//          margin(c, x) >= 0 if c holds for x, <= 0 if not; its size is the distance of x from the
//          limit (for == and !=: from the edge of the tolerance)
//   errors a NaN value meets neither a condition nor its negation: margin -infinity
//   source robustness of temporal logic: Fainekos and Pappas 2009
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::grading {

enum class Op : std::uint8_t { kLess, kLessEqual, kGreater, kGreaterEqual, kEqual, kNotEqual };

std::string_view name_of(Op op);  // "<" "<=" ">" ">=" "==" "!="
std::optional<Op> op_of(std::string_view text);

struct Condition {
  std::string signal;
  Op op = Op::kLess;
  double number = 0.0;
  double tolerance = 1e-9;  // for == and != only
};

bool holds(Op op, double value, double number, double tolerance);
double margin(Op op, double value, double number, double tolerance);

enum class Kind : std::uint8_t {
  kAlways,  // `condition` at every tick of the window
  kNever,   // at no tick of the window
  kWithin,  // at some tick at most `limit` after the window opens
  kAfter,   // each time that `trigger` becomes true in the window, `condition` within `limit`
  kDetects  // as kWithin, for a fault at `from`: after `from`, and not during kQuiet before it
};

// A condition that held shortly before the fault is not its detection.
inline constexpr Duration kQuiet = seconds(2);

std::string_view name_of(Kind kind);  // "always" "never" "within" "after" "detects"
std::optional<Kind> kind_of(std::string_view text);

struct Expectation {
  std::string name{};  // as in the report; may be empty
  Kind kind = Kind::kAlways;
  Condition condition{};
  Condition trigger{};                  // kAfter only
  Duration limit{};                     // kWithin, kAfter, kDetects
  std::optional<Instant> from{}, to{};  // window; absent: the whole run
};

// "after brake_kpa > 100: speed_mps < 1 within 5 s, from 10 s"
std::string to_string(const Expectation& expectation);

}  // namespace pitwall::grading
