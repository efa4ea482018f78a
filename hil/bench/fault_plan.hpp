// The faults of a scenario, sorted by what carries them out: frames on their way to the car, the
// bench's own models, the radio, or the processes of the run and the machine below them.
//   in     scenario::Fault rows
//   errors a kind that this bench does not know or does not carry out, a missing or senseless
//          value: Problem with the place in the scenario file
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
  std::vector<faults::BenchFault> radio;      // of the air between car and base
  std::vector<faults::BenchFault> bytes;      // of the receivers, on their way to the car
  std::vector<faults::BenchFault> clock;      // of the car's clock beside GPS time
  std::vector<faults::BenchFault> modules;    // of the car's own software
  std::vector<faults::BenchFault> bus;        // of the wire and the controllers on it
  std::vector<faults::BenchFault> processes;  // not the rig's: of whoever runs the car
};

enum class BenchMode : std::uint8_t { kLockstep, kLive };

// Killed, stopped, slowed processes; a clock or a disk below them.
bool is_process_fault(faults::BenchFaultKind kind);
bool is_radio_fault(faults::BenchFaultKind kind);
// Lockstep shifts what the receivers say of the time.
bool is_clock_fault(faults::BenchFaultKind kind);
bool is_module_fault(faults::BenchFaultKind kind);
// Needs a bus that knows bits and error counters: lockstep's.
bool is_bus_fault(faults::BenchFaultKind kind);
// Of the receivers' bytes on their way.
bool is_byte_fault(faults::BenchFaultKind kind);
bool carried_out(faults::BenchFaultKind kind, BenchMode mode);

Result<FaultPlan, Problem> plan_faults(const std::vector<scenario::Fault>& rows,
                                       std::uint64_t seed);

// The first row that this kind of bench cannot carry out.
std::optional<Problem> refused_by(BenchMode mode, const std::vector<scenario::Fault>& rows);

}  // namespace pitwall::bench
