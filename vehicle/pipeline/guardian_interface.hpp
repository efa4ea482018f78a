// Car's side of the interface to its guardian: the guardian's parameters from those of the car, the
// record of every tick, and the view of the guardian's status.
//   in     Setup, Car and Outputs of a tick; the guardian's Status
//   out    guardian::Params, guardian::CarRecord, GuardianView
//   invariants
//          a stop trajectory enters the record only if it passes stop_check; otherwise the previous
//          one stays there, with its age
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

// The record for the guardian, kept between the ticks.
struct GuardianRecord {
  guardian::CarRecord record;
  guardian::StopVerdict verdict = guardian::StopVerdict::kEmpty;  // of the newest plan
  Instant judged{};                                               // time of that plan
  std::uint64_t refused = 0;                                      // plans that were not published
};

struct Run {
  std::uint64_t id = 0;
  bool reset = false;   // by the operator, or this process was started without --arm
  bool barred = false;  // barred from arming: ended_armed() of the found record
};

// Updates the record to this tick and counts refused plans.
void publish(const Setup& setup, const Car& car, const Outputs& out, const Run& run, Instant now,
             GuardianRecord& reported);

// View of a status of any age: only a fresh status of this run takes effect.
GuardianView view_of(const guardian::Status& status, std::uint64_t run, Instant now);

// True if the run of this record was armed and did not end normally, or if an earlier run did so
// and no operator has intervened since: a restart alone must not arm the car again.
bool ended_armed(const guardian::CarRecord& record);
// Marks the record of a process that ends normally: whether the car stands and may be left.
void finish(GuardianRecord& reported);

}  // namespace pitwall::pipeline
