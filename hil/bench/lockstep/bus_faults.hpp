// Faults of the CAN bus itself, and the observed state of the car's CAN controller.
//   in     the faults of the plan; the bus and the time at each step of the rig; restarts of the
//          controller by the car
//   out    a bus with bit errors, a stalled controller or a babbling node; the car's
//          LinkObservation
//   invariants
//          bus_errors: each bit is corrupted with probability `value`. bus_transmitter: the share
//          `value` of the car's frames is destroyed. transmit_stall: the car's controller sends
//          nothing until the car restarts it, like a hung driver queue. bus_babble: an unknown node
//          fills the share `value` of the bus with frames of identifier 0; at 1 no other node can
//          send
//   errors none
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "hil/can_bus/memory_bus.hpp"
#include "hil/faults/bench_fault.hpp"
#include "vehicle/world/health.hpp"

namespace pitwall::bench {

class BusFaults {
 public:
  explicit BusFaults(std::vector<faults::BenchFault> plan) : plan_(std::move(plan)) {}

  void act_on(can_bus::MemoryBus& bus, Instant now) const;
  void car_restarts_controller(Instant now) { restarted_at_ = now; }

 private:
  double value_of(faults::BenchFaultKind kind, Instant now) const;  // 0: no such fault is active

  std::vector<faults::BenchFault> plan_;
  std::optional<Instant> restarted_at_;
};

world::LinkObservation link_of_car(const can_bus::MemoryBus& bus);

}  // namespace pitwall::bench
