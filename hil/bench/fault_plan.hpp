// The faults of a scenario, sorted by what carries them out: frames on their way to the car, or the
// bench's own models.
//   in     scenario::Fault rows
//   errors a kind that this bench does not know or does not carry out, a missing or senseless
//          value: Problem with the place in the scenario file
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "hil/faults/bench_fault.hpp"
#include "hil/faults/frame_fault.hpp"
#include "hil/scenario/scenario.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::bench {

struct FaultPlan {
  std::vector<faults::FrameFault> frames;
  std::vector<faults::BenchFault> models;
};

Result<FaultPlan, Problem> plan_faults(const std::vector<scenario::Fault>& rows,
                                       std::uint64_t seed);

}  // namespace pitwall::bench
