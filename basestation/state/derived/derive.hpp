// Derived fields, computed from those of the car in one pass over the vehicle state.
//   in     the vehicle state, link and base figures, monitors with memory (fuel, corrections, link)
//   out    a view of each base field, as old as the oldest value that it needs, and no better
//   invariants
//          a value that needs a field which was never received is absent; one from a stale field is
//          stale. Fields with a judgement keep their last value like the car's
//   cost   about forty views of the vehicle state; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "basestation/state/course.hpp"
#include "basestation/state/derived/attempt.hpp"
#include "basestation/state/derived/corrections.hpp"
#include "basestation/state/derived/link_state.hpp"
#include "basestation/state/derived/tyre_gate.hpp"
#include "basestation/state/known.hpp"
#include "protocol/rules/fuel.hpp"

namespace pitwall::state {

struct DeriveParams {
  TyreGate tyres;
  rules::FuelPlan fuel;
};

// Monitors that keep a memory of earlier values.
struct MonitorState {
  rules::FuelEstimator fuel;
  CorrectionMonitor corrections;
  LinkStateMonitor link;
  AttemptTracker attempts;

  // Processes each new sample of the groups that the monitors need; call it each step of the grid.
  void step(const VehicleState& vehicle, const Known& known, Instant now);
  // Call it each step of the grid; without a course, whole laps are counted and gaps are unknown.
  void step_race(const VehicleState& vehicle, const rules::FuelPlan& plan, const Course* course,
                 Instant now);

 private:
  void step_fuel(const VehicleState& vehicle, const Expectations& expectations, Instant now);
  bool sampled_anew(const VehicleState& vehicle, telemetry::Group group, Instant now,
                    Instant& newest);

  std::uint64_t fuel_entries_ = 0;
  Instant fuel_at_ = telemetry::kNeverSampled, engine_at_ = telemetry::kNeverSampled;
  std::array<Instant, CorrectionMonitor::kUnits> gnss_at_{telemetry::kNeverSampled,
                                                          telemetry::kNeverSampled};
};

void derive(const DeriveParams& params, const VehicleState& vehicle, const Known& known,
            const MonitorState& monitors, const Course* course, Instant now, BaseViews& views);

}  // namespace pitwall::state
