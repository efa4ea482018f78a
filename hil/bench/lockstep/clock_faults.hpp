// Clock faults: a difference between the car's clock and GPS time. Lockstep has a single clock, so
// the faults shift the time stamps of all receiver units alike.
//   in     the faults of the plan; samples of the receivers; now
//   out    the same samples with shifted stamps
//   invariants
//          gps_time_step: a shift by `value` seconds while the fault is active. clock_skew: the
//          car's clock runs fast by `value` parts per million, so GPS time lags more and more from
//          the start of the fault
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
