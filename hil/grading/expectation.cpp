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
constexpr std::array<std::string_view, 5> kKinds{"always", "never", "within", "after", "detects"};

std::string condition_text(const Condition& c) {
  return c.signal + " " + std::string(name_of(c.op)) + " " + formatted("%.10g", c.number);
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
std::string_view name_of(Kind kind) { return kKinds.at(static_cast<std::size_t>(kind)); }
std::optional<Kind> kind_of(std::string_view text) { return find<Kind>(kKinds, text); }

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

std::string to_string(const Expectation& e) {
  const std::string within = " within " + formatted("%.10g", e.limit.seconds()) + " s";
  std::string text = std::string(name_of(e.kind)) + " ";
  if (e.kind == Kind::kWithin || e.kind == Kind::kDetects)
    text += formatted("%.10g", e.limit.seconds()) + " s ";
  if (e.kind == Kind::kAfter) text += condition_text(e.trigger) + ": ";
  text += condition_text(e.condition);
  if (e.kind == Kind::kAfter) text += within;
  if (e.from) text += ", from " + formatted("%.10g", (*e.from - Instant{}).seconds()) + " s";
  if (e.to) text += ", to " + formatted("%.10g", (*e.to - Instant{}).seconds()) + " s";
  return text;
}

}  // namespace pitwall::grading
