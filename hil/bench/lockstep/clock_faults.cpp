// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/lockstep/clock_faults.hpp"

namespace pitwall::bench {

using faults::BenchFaultKind;

Duration ClockFaults::shift(Instant now) const {
  Duration sum{};
  for (const faults::BenchFault& fault : plan_) {
    if (!faults::active(fault, now)) continue;
    sum = sum + (fault.kind == BenchFaultKind::kClockSkew
                     ? from_seconds(-1e-6 * fault.value * (now - fault.start).seconds())
                     : from_seconds(fault.value));
  }
  return sum;
}

world::SensorInput ClockFaults::apply(world::SensorInput samples, Instant now) const {
  const Duration by = shift(now);
  if (by == Duration{}) return samples;
  for (auto& sample : samples.positions) sample.at += by;
  for (auto& sample : samples.velocities) sample.at += by;
  for (auto& sample : samples.headings) sample.at += by;
  for (auto& sample : samples.imu) sample.at += by;
  for (auto& sample : samples.attitudes) sample.at += by;
  return samples;
}

}  // namespace pitwall::bench
