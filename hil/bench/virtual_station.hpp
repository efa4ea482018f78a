// A base station for lockstep: the base's own uplink and the car's own ear, with nothing between
// them but the faults of the scenario. The radio takes no time.
//   in     the faults that concern base or radio; each tick of the bench, and whether the car runs
//   out    alive_at(), as pipeline::Inputs has it
//   law    base_killed: silent; started again at its end, as another run. base_paused: silent, and
//          goes on. base_station_silent: hears, but is not heard. radio_down: neither way
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "basestation/intake/uplink.hpp"
#include "hil/bench/fault_plan.hpp"
#include "hil/faults/bench_fault.hpp"
#include "protocol/telemetry/heartbeat_intake.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::bench {

// Those of a plan that a virtual base carries out.
std::vector<faults::BenchFault> base_faults(const FaultPlan& plan);

class VirtualStation {
 public:
  explicit VirtualStation(std::vector<faults::BenchFault> faults) : faults_(std::move(faults)) {
    restart_car();
  }

  void step(Instant now, bool car_runs);
  // The car's process begins anew: it has heard nothing yet.
  void restart_car();

  std::optional<Instant> alive_at() const { return ear_.alive_at(); }
  const telemetry::HeartbeatCounters& heartbeats() const { return ear_.counters(); }

 private:
  bool active(faults::BenchFaultKind kind, Instant now) const;
  void hear_car(Instant now);

  std::vector<faults::BenchFault> faults_;
  telemetry::StatePacket said_;  // what the car would send; its values do not matter
  Instant next_packet_{};
  bool was_killed_ = false;
  std::uint32_t run_ = 1;
  intake::Uplink uplink_{run_};
  telemetry::HeartbeatIntake ear_{0};
};

}  // namespace pitwall::bench
