// The car's side of its guardian: what the guardian needs of the car's parameters, what the car
// tells it in every tick, and what the car makes of the guardian's word.
//   in     Setup, Car and Outputs of a tick; the guardian's Status
//   out    guardian::Params, guardian::CarRecord, GuardianView
//   invariants
//          a stop trajectory goes into the record only if it passes stop_check; else the one before
//          stays there, with its age
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/vocabulary/time.hpp"
#include "vehicle/guardian/guardian.hpp"
#include "vehicle/guardian/record.hpp"
#include "vehicle/guardian/stop_check.hpp"
#include "vehicle/pipeline/step.hpp"

namespace pitwall::pipeline {

guardian::Params guardian_params(const CarParams& params);

// What the guardian is told, kept between the ticks.
struct Reported {
  guardian::CarRecord record;
  guardian::StopVerdict verdict = guardian::StopVerdict::kEmpty;  // of the newest plan
  Instant judged{};                                               // when that plan was made
  std::uint64_t refused = 0;                                      // plans that were not published
};

struct Run {
  std::uint64_t id = 0;
  bool reset = false;   // the operator's, or this process was started without being armed
  bool barred = false;  // from arming: ended_armed() of the record that it found
};

// Brings the record up to this tick.
void publish(const Setup& setup, const Car& car, const Outputs& out, const Run& run, Instant now,
             Reported& reported);

// What the car heeds of the guardian's word; `status` may be of any age.
GuardianView view_of(const guardian::Status& status, std::uint64_t run, Instant now);

// The run of this record was armed and did not end in order, or a run before it and nobody has
// looked since: the car must not be armed again by a mere restart.
bool ended_armed(const guardian::CarRecord& record);
// The last word of a process that ends in order: whether the car may be left.
void finish(Reported& reported);

}  // namespace pitwall::pipeline
