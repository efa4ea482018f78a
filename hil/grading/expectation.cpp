// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/expectation.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::grading {
namespace {

constexpr std::array<std::string_view, 6> kOps{"<", "<=", ">", ">=", "==", "!="};
constexpr std::array<std::string_view, 8> kKinds{"always",  "never", "within", "after",
                                                 "detects", "until", "rate",   "quantile"};

std::string seconds_text(Duration d) { return formatted("%.10g s", d.seconds()); }

// What is judged, without kind and window.
std::string judged_text(const Expectation& e) {
  const std::string condition = to_string(e.condition);
  switch (e.kind) {
    case Kind::kAlways:
    case Kind::kNever:
      return condition;
    case Kind::kWithin:
    case Kind::kDetects:
      return seconds_text(e.limit) + " " + condition;
    case Kind::kAfter:
      return to_string(e.trigger) + ": " + condition + " within " + seconds_text(e.limit);
    case Kind::kUntil:
      return to_string(e.release) + " within " + seconds_text(e.limit) + ": " + condition;
    case Kind::kRate:
      return condition + " per s" + (e.span.ns > 0 ? " over " + seconds_text(e.span) : "");
    case Kind::kQuantile:
      return formatted("%.10g of ", e.share) + condition;
  }
  CHECK(false);
  return {};
}

template <class Enum, std::size_t N>
std::optional<Enum> find(const std::array<std::string_view, N>& names, std::string_view text) {
  for (std::size_t i = 0; i < N; ++i)
    if (names[i] == text) return static_cast<Enum>(i);
  return std::nullopt;
}

}  // namespace

std::string_view name_of(Op op) { return kOps.at(static_cast<std::size_t>(op)); }
std::optional<Op> op_of(std::string_view text) { return find<Op>(kOps, text); }
std::span<const std::string_view> op_names() { return kOps; }
std::string_view name_of(Kind kind) { return kKinds.at(static_cast<std::size_t>(kind)); }
std::optional<Kind> kind_of(std::string_view text) { return find<Kind>(kKinds, text); }
std::span<const std::string_view> kind_names() { return kKinds; }

bool holds(Op op, double value, double number, double tolerance) {
  switch (op) {
    case Op::kLess:
      return value < number;
    case Op::kLessEqual:
      return value <= number;
    case Op::kGreater:
      return value > number;
    case Op::kGreaterEqual:
      return value >= number;
    case Op::kEqual:
      return value == number || std::abs(value - number) <= tolerance;
    case Op::kNotEqual:
      return value != number && std::abs(value - number) > tolerance;
  }
  CHECK(false);
  return false;
}

double margin(Op op, double value, double number, double tolerance) {
  if (std::isnan(value)) return -std::numeric_limits<double>::infinity();
  const double above = value == number ? 0.0 : value - number;  // infinity - infinity is no number
  switch (op) {
    case Op::kLess:
    case Op::kLessEqual:
      return -above;
    case Op::kGreater:
    case Op::kGreaterEqual:
      return above;
    case Op::kEqual:
      return tolerance - std::abs(above);
    case Op::kNotEqual:
      return std::abs(above) - tolerance;
  }
  CHECK(false);
  return 0.0;
}

bool holds(const Condition& c, double value) { return holds(c.op, value, c.number, c.tolerance); }

double margin(const Condition& c, double value) {
  return margin(c.op, value, c.number, c.tolerance);
}

std::string to_string(const Condition& c) {
  return c.signal + " " + std::string(name_of(c.op)) + " " + formatted("%.10g", c.number);
}

std::vector<Condition> conditions_of(const Expectation& e) {
  std::vector<Condition> conditions{e.condition};
  if (e.kind == Kind::kAfter) conditions.push_back(e.trigger);
  if (e.kind == Kind::kUntil) conditions.push_back(e.release);
  return conditions;
}

bool is_shown_by(const Expectation& e, Instant end) {
  const Instant from = e.from.value_or(Instant{});
  switch (e.kind) {
    case Kind::kAlways:
    case Kind::kNever:
      return from < end;
    case Kind::kRate:
      return from + e.span < end;
    case Kind::kWithin:
    case Kind::kDetects:
    case Kind::kQuantile:
      return from < end && (!e.to || *e.to <= end);
    case Kind::kAfter:
      return e.to && *e.to + e.limit <= end;
    case Kind::kUntil:
      return from + e.limit <= end;
  }
  CHECK(false);
  return false;
}

std::string to_string(const Expectation& e) {
  std::string text = std::string(name_of(e.kind)) + " " + judged_text(e);
  if (e.from) text += ", from " + seconds_text(*e.from - Instant{});
  if (e.to) text += ", to " + seconds_text(*e.to - Instant{});
  return text;
}

}  // namespace pitwall::grading
