// StateSource for tests, with the values that the test sets.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "basestation/publishers/console/snapshots.hpp"

namespace pitwall::publishers::console {

struct FakeStateSource : StateSource {
  state::VehicleState vehicle;
  alarms::Evaluation evaluation = alarms::Evaluation::kNone;
  telemetry::Snapshot state;

  void show(telemetry::FieldIndex field, double value, Instant at) {
    const telemetry::Group group = telemetry::kFields[field].group;
    state.values[field] = value;
    state.at(group) = at;
    telemetry::GroupSet groups;
    groups.add(group);
    vehicle.update(state, groups);
  }
  state::FieldView view(state::FieldId field, Instant now) const override {
    return state::is_base(field) ? state::FieldView{} : vehicle.view(field, now);
  }
  alarms::Evaluation evaluate(state::FieldId, const state::FieldView&) const override {
    return evaluation;
  }
  std::vector<state::TrendPoint> past(state::FieldId, Instant from, Instant,
                                      std::size_t) const override {
    return {{.time_s = static_cast<double>(from.ns) * 1e-9, .value = 1.0F}};
  }
  state::LapLog laps_driven{1'000.0};
  const state::LapLog* laps() const override { return &laps_driven; }
};

}  // namespace pitwall::publishers::console
