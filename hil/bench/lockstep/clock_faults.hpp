// Clock faults: a car whose clock does not run as the receivers': lockstep has one clock, so it is
// what the receivers say of the time that is shifted, of all units alike.
//   in     the faults of the plan; samples as the receivers make them; now
//   out    the same with other stamps
//   invariants
//          gps_time_step: by `value` seconds while it lasts. clock_skew: the car's clock runs fast
//          by `value` parts per million, so GPS time falls back from the start of the fault on
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "hil/faults/bench_fault.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::bench {

class ClockFaults {
 public:
  explicit ClockFaults(std::vector<faults::BenchFault> plan) : plan_(std::move(plan)) {}

  Duration shift(Instant now) const;
  world::SensorInput apply(world::SensorInput samples, Instant now) const;

 private:
  std::vector<faults::BenchFault> plan_;
};

}  // namespace pitwall::bench
