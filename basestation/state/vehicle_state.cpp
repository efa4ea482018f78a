// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/vehicle_state.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::state {

namespace {

FieldView view_of(double value, Instant sampled, Duration target_age, Instant now) {
  if (sampled == telemetry::kNeverSampled) return {};
  const Duration age = std::max(now - sampled, Duration{});
  return {.value = value, .age = age, .quality = quality_of(age, target_age)};
}

}  // namespace

const char* text_of(Quality quality) {
  switch (quality) {
    case Quality::kFresh:
      return "fresh";
    case Quality::kLate:
      return "late";
    case Quality::kStale:
      return "stale";
    case Quality::kNever:
      return "never";
  }
  return "?";
}

Quality quality_of(Duration age, Duration target_age) {
  if (age <= fresh_until(target_age)) return Quality::kFresh;
  return age <= stale_after(target_age) ? Quality::kLate : Quality::kStale;
}

void VehicleState::update(const telemetry::Snapshot& state, telemetry::GroupSet groups) {
  ever_ = true;
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
    if (groups.has(row.group) && state.ever(row.group)) {
      sampled_[telemetry::index_of(row.group)] = state.at(row.group);
    }
  }
  for (telemetry::FieldIndex i = 0; i < telemetry::kFieldCount; ++i) {
    const telemetry::Group group = telemetry::kFields[i].group;
    const double value = state.values[i];
    if (!groups.has(group) || !state.ever(group) || std::isnan(value)) continue;
    latest_[i] = {.value = value, .sampled = state.at(group)};
  }
}

FieldView VehicleState::view(telemetry::FieldIndex field, Instant now) const {
  const Latest& latest = latest_[field];
  const telemetry::FieldRow& row = telemetry::kFields[field];
  FieldView view = view_of(latest.value, latest.sampled, row.target_age(), now);
  view.unset = latest.sampled != sampled_[telemetry::index_of(row.group)];
  return view;
}

FieldView VehicleState::group(telemetry::Group group, Instant now) const {
  return view_of(kUnset, sampled_[telemetry::index_of(group)], telemetry::row_of(group).target_age,
                 now);
}

}  // namespace pitwall::state
