// Pass over the vehicle state at one moment: access of the parts of derive() to their inputs and
// outputs.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "basestation/state/known.hpp"

namespace pitwall::state {

struct Pass {
  const VehicleState& vehicle;
  Instant now;
  BaseViews& views;

  FieldView see(telemetry::FieldIndex index) const { return vehicle.view(index, now); }
  double value(telemetry::FieldIndex index) const { return see(index).value; }
  // The last known value, or unset if it is stale.
  double usable(telemetry::FieldIndex index) const {
    const FieldView view = see(index);
    return state::usable(view) ? view.value : kUnset;
  }
  // Stores a value that was computed from these fields: as old as the oldest known one of them.
  void put(BaseField at, double value, std::initializer_list<telemetry::FieldIndex> made_of) const {
    FieldView made{.value = value, .age = {}, .quality = Quality::kFresh};
    for (const telemetry::FieldIndex index : made_of) {
      const FieldView one = see(index);
      if (one.quality == Quality::kNever) continue;
      made.age = std::max(made.age, one.age);
      made.quality = std::max(made.quality, one.quality);
    }
    views[index_of(at)] = std::isnan(value) ? FieldView{} : made;
  }
  void put(BaseField at, double value) const { put(at, value, {}); }
};

}  // namespace pitwall::state
