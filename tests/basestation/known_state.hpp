// Vehicle state that a test publishes field by field.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "basestation/state/vehicle_state.hpp"
#include "protocol/telemetry/registry/registry.hpp"

namespace pitwall {

inline constexpr Instant kStart{seconds(100).ns};

struct KnownState {
  telemetry::Snapshot snapshot;
  state::VehicleState vehicle;

  // The group of the field is sampled at this time; its other fields keep their values.
  void publish(telemetry::FieldIndex field, double value, Instant at) {
    snapshot.values[field] = value;
    touch(telemetry::kFields[field].group, at);
  }
  void touch(telemetry::Group group, Instant at) {
    snapshot.at(group) = at;
    telemetry::GroupSet groups;
    groups.add(group);
    vehicle.update(snapshot, groups);
  }
  // All groups published before are sampled again, as by a car that keeps sending.
  void touch_all(Instant at) {
    telemetry::GroupSet groups;
    for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
      if (!snapshot.ever(row.group)) continue;
      snapshot.at(row.group) = at;
      groups.add(row.group);
    }
    vehicle.update(snapshot, groups);
  }
};

}  // namespace pitwall
