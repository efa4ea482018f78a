// Limits that rate a value as good, warning or bad; operators can change them.
//   in     a field's value and quality; limits by field, defaults from kDefaultLimits
//   out    the evaluation; kNone without a limit, without a value or for a stale value, so that an
//          old value has no colour
//   invariants
//          a value at a limit is still on the good side of it. Bits and enumerations have sets of
//          values instead of bounds
//   errors edit(): Problem for an unknown field, bounds that are not numbers or are out of order
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "basestation/state/station_field.hpp"
#include "basestation/state/vehicle_state.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::alarms {

enum class Evaluation : std::uint8_t { kNone, kGood, kWarning, kBad };
std::string_view text_of(Evaluation evaluation);

// Unset bounds are not checked. In the sets, bit k stands for the value k.
struct Limit {
  double warning_low = kUnset, warning_high = kUnset;
  double bad_low = kUnset, bad_high = kUnset;
  std::uint64_t warning_values = 0, bad_values = 0;

  bool bounded() const;
  bool any() const { return bounded() || warning_values != 0 || bad_values != 0; }
  bool operator==(const Limit&) const = default;
};
Evaluation evaluate(const Limit& limit, double value);

struct LimitEdit {
  state::FieldId field = 0;
  Limit limit;
  std::string author, reason;
};

class Limits {
 public:
  Limits();  // the defaults

  const Limit& of(state::FieldId field) const;
  Evaluation evaluate(state::FieldId field, const state::FieldView& view) const;
  Result<bool, Problem> edit(const LimitEdit& edit);
  // Newest last; the settings file is written from them.
  const std::vector<LimitEdit>& edits() const { return edits_; }

 private:
  std::vector<Limit> car_, base_;
  std::vector<LimitEdit> edits_;
};

}  // namespace pitwall::alarms
