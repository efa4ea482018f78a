// Run of one controller through the plan: how its speed follows, what its pedals and gears do.
//   in     scenario and holds of speed_plan.hpp, the car with its controller
//   out    SpeedRow; a contact or a stop by the car itself ends the figures
//   invariants
//          errors are of the true speed against the governed reference, that is the speed of the
//          drive trajectory where the car is; the overshoot is against the call of race control
//          steady: in the steady part of a hold, and not within kShift_s of a commanded shift
//   units  m/s
//   errors Problem of the scenario; a bad run is not an error but a row
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "protocol/vocabulary/result.hpp"
#include "tests/benchmarks/control/speed_plan.hpp"
#include "vehicle/pipeline/setup.hpp"

namespace pitwall::speed_bench {

inline constexpr double kShift_s = 1.0;

struct SpeedError {
  std::uint64_t ticks = 0;
  double squares = 0.0, max_mps = 0.0;

  void add(double error_mps);
  double rms_mps() const;
};

struct SpeedRow {
  std::string track, world, law;
  SpeedError steady, driving;  // driving: all of it, with ramps and shifts
  double overshoot_mps = kUnset;
  std::size_t brakings = 0;               // from throttle to brake
  std::size_t steady_brakings = 0;        // of these in the steady part of a hold
  std::size_t slow_downs = 0;             // of the plan
  std::size_t shifts = 0, crossings = 0;  // commanded; of the governed reference
  std::size_t missed_shifts = 0, refusals = 0;
  std::string end;  // where and why, if it ended early; else empty
};

// Drives the plan in lockstep.
Result<SpeedRow, Problem> run_speed(const Plan& plan, const pipeline::Setup& setup);

}  // namespace pitwall::speed_bench
