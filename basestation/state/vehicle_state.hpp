// Latest value and age of every field: what all publishers show.
//   in     the state as received by radio, and which of its groups are new
//   out    value, age and quality of each field at any later time
//   age    since the sample was taken in the car, transmission included: never below the true age
//          while the clocks of car and base are being compared
//   unset  a field that the car no longer knows keeps its last value, ages, and is marked so
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::state {

enum class Quality : std::uint8_t {
  kFresh,  // up to one and a half times the field's target age
  kLate,   // up to five times that age, but at most 2 s, or twice that age for the slowest fields
  kStale,  // too old to describe the present
  kNever
};
inline constexpr Duration kStaleAfter = seconds(2);
constexpr Duration fresh_until(Duration target_age) { return 3 * target_age / 2; }
constexpr Duration stale_after(Duration target_age) {
  return std::min(5 * target_age, std::max(kStaleAfter, 2 * target_age));
}
const char* text_of(Quality quality);
Quality quality_of(Duration age, Duration target_age);

struct FieldView {
  double value = kUnset;
  Duration age{};
  Quality quality = Quality::kNever;
  bool unset = false;  // the car reports it as unknown: the value is the last known one
};

// Valid for use: fresh, or late and shown with its age.
constexpr bool usable(const FieldView& view) {
  return view.quality == Quality::kFresh || view.quality == Quality::kLate;
}

class VehicleState {
 public:
  void update(const telemetry::Snapshot& state, telemetry::GroupSet groups);

  FieldView view(telemetry::FieldIndex field, Instant now) const;
  // Age of the group's newest sample; kNever if it was never sampled.
  FieldView group(telemetry::Group group, Instant now) const;
  bool ever() const { return ever_; }

 private:
  struct Latest {
    double value = kUnset;
    Instant sampled = telemetry::kNeverSampled;
  };

  std::array<Latest, telemetry::kFieldCount> latest_{};
  std::array<Instant, telemetry::kGroups> sampled_ = telemetry::Snapshot{}.sampled_at;
  bool ever_ = false;
};

}  // namespace pitwall::state
