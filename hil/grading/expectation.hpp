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
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::grading {

enum class Op : std::uint8_t { kLess, kLessEqual, kGreater, kGreaterEqual, kEqual, kNotEqual };

std::string_view name_of(Op op);  // "<" "<=" ">" ">=" "==" "!="
std::optional<Op> op_of(std::string_view text);
std::span<const std::string_view> op_names();

// True for < <= > >=.
constexpr bool is_ordering(Op op) { return op < Op::kEqual; }

struct Condition {
  std::string signal;
  Op op = Op::kLess;
  double number = 0.0;
  double tolerance = 1e-9;  // for == and != only
};

bool holds(Op op, double value, double number, double tolerance);
double margin(Op op, double value, double number, double tolerance);
bool holds(const Condition& condition, double value);
double margin(const Condition& condition, double value);
std::string to_string(const Condition& condition);  // "speed_mps < 1"

enum class Kind : std::uint8_t {
  kAlways,   // `condition` at every tick of the window
  kNever,    // at no tick of the window
  kWithin,   // at some tick at most `limit` after the window opens
  kAfter,    // each time that `trigger` becomes true in the window, `condition` within `limit`
  kDetects,  // as kWithin, for a fault at `from`: after `from`, and not during kQuiet before it
  kUntil,    // `release` at most `limit` after the window opens, and at every tick before it
             // `condition`
  kRate,     // at every tick of the window, of the absolute change per second since `span` earlier
  kQuantile  // of the `share` quantile of the values in the window
};

// The condition holds once, and what comes later changes nothing.
constexpr bool is_met_once(Kind kind) {
  return kind == Kind::kWithin || kind == Kind::kDetects || kind == Kind::kUntil;
}

// A condition that held shortly before the fault is not its detection.
inline constexpr Duration kQuiet = seconds(2);

std::string_view name_of(Kind kind);  // the word of a scenario: "always" ...
std::optional<Kind> kind_of(std::string_view text);
std::span<const std::string_view> kind_names();

struct Expectation {
  std::string name{};  // as in the report; may be empty
  Kind kind = Kind::kAlways;
  Condition condition{};
  Condition trigger{};                  // kAfter only
  Condition release{};                  // kUntil only
  Duration limit{};                     // kWithin, kAfter, kDetects, kUntil
  Duration span{};                      // kRate only; zero: from one tick to the next
  double share = kUnset;                // kQuantile only; (0, 1]
  std::optional<Instant> from{}, to{};  // window; absent: the whole run
};

// `condition`, and `trigger` or `release` if the kind has one. Allocates.
std::vector<Condition> conditions_of(const Expectation& expectation);

// Whether a run that is ended early, at `end`, can show the expectation: what has to hold at every
// tick if its window has begun, else if its window and the time for an answer are over. An absent
// `to` is the end of the run, whenever that is; then a trigger might still have come.
bool is_shown_by(const Expectation& expectation, Instant end);

// "after brake_kpa > 100: speed_mps < 1 within 5 s, from 10 s"
std::string to_string(const Expectation& expectation);

}  // namespace pitwall::grading
