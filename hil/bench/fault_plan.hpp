// Faults of a scenario, sorted by the part of the bench that carries them out: frames on their way
// to the car, the bench's own models, the radio, or the processes of the run and their machine.
//   in     scenario::Fault rows
//   errors an unknown kind, a kind that this bench cannot carry out, a missing or senseless value:
//          Problem with the place in the scenario file
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hil/faults/bench_fault.hpp"
#include "hil/faults/frame_fault.hpp"
#include "hil/scenario/scenario.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::bench {

struct FaultPlan {
  std::vector<faults::FrameFault> frames;
  std::vector<faults::BenchFault> models;
  std::vector<faults::BenchFault> perception;
  std::vector<faults::BenchFault> radio;      // of the channel between car and base
  std::vector<faults::BenchFault> bytes;      // of the receivers, on their way to the car
  std::vector<faults::BenchFault> clock;      // of the car's clock relative to GPS time
  std::vector<faults::BenchFault> modules;    // of the car's own software
  std::vector<faults::BenchFault> bus;        // of the wire and the controllers on it
  std::vector<faults::BenchFault> processes;  // carried out by the runner of the car, not the rig
};

enum class BenchMode : std::uint8_t { kLockstep, kLive };

// Killed, paused or slowed processes, a moved or replaced base station, a clock or disk fault.
bool is_process_fault(faults::BenchFaultKind kind);
bool is_radio_fault(faults::BenchFaultKind kind);
// Clock faults change the time in the receivers' messages; lockstep only.
bool is_clock_fault(faults::BenchFaultKind kind);
bool is_module_fault(faults::BenchFaultKind kind);
// Needs a bus model with bits and error counters; lockstep only.
bool is_bus_fault(faults::BenchFaultKind kind);
// Damage to the receivers' bytes on their way to the car.
bool is_byte_fault(faults::BenchFaultKind kind);
bool carried_out(faults::BenchFaultKind kind, BenchMode mode);

Result<FaultPlan, Problem> plan_faults(const std::vector<scenario::Fault>& rows,
                                       std::uint64_t seed);

// Problem with the first row that this kind of bench cannot carry out; nullopt if there is none.
std::optional<Problem> refused_by(BenchMode mode, const std::vector<scenario::Fault>& rows);

// Problem with dust where LiDARs shoot their rays: those would need clouds of it, not the number of
// what is falsely seen in it.
std::optional<Problem> dust_in_rays(const scenario::Scenario& scenario);

}  // namespace pitwall::bench
