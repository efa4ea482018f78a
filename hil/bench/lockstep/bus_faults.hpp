// Faults of the CAN bus itself, and the state of the car's controller.
//   in     the faults of the plan; at each step of the rig the bus and now; a restart that the car
//          asks for
//   out    a bus that is disturbed, stalled or babbled on; the car's LinkObservation
//   invariants
//          bus_errors: each bit is seen wrong with probability `value`. bus_transmitter: this share
//          of the car's frames is destroyed. transmit_stall: the car's controller sends nothing
//          until the car restarts it, as where a driver's queue hangs. bus_babble: a stranger sends
//          identifier 0 so that it fills this share of the bus; at 1 nobody else is heard
//   errors none
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "hil/can_bus/memory_bus.hpp"
#include "hil/faults/bench_fault.hpp"
#include "vehicle/world/bus_health.hpp"

namespace pitwall::bench {

class BusFaults {
 public:
  explicit BusFaults(std::vector<faults::BenchFault> plan) : plan_(std::move(plan)) {}

  void act_on(can_bus::MemoryBus& bus, Instant now) const;
  void car_restarts_controller(Instant now) { restarted_at_ = now; }

 private:
  double value_of(faults::BenchFaultKind kind, Instant now) const;  // 0: none is active

  std::vector<faults::BenchFault> plan_;
  std::optional<Instant> restarted_at_;
};

world::LinkObservation link_of_car(const can_bus::MemoryBus& bus);

}  // namespace pitwall::bench
