// The car process's end of the memory that it shares with its guardian; without a name nothing is
// shared and everything here does nothing.
//   in     the name, whether the car shall be armed from the start; the outputs of every tick
//   out    the guardian's word for the next tick; whether arming is barred
//   invariants
//          a process that finds the record of a run that ended armed does not arm, and neither do
//          those after it, until one was started without being armed
//   errors open(): Problem with the path
//   cost   no allocation after open(); a tick below 20 us
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/io/shared_stop.hpp"
#include "vehicle/pipeline/guarding.hpp"

namespace pitwall::io {

inline constexpr const char* kBarredText =
    "the last run ended while it was armed; look at the car, then start once without --arm";

class Guarded {
 public:
  static Result<Guarded, Problem> open(const std::string& name, bool arm);

  // An arming request that is held since the start is refused.
  bool barred() const { return barred_; }
  // Of the guardian, as of now: read after the bus, so that no frame is newer than its word.
  pipeline::GuardianView view(Instant now);
  // Before the frames of the tick are sent.
  void publish(const pipeline::Setup& setup, const pipeline::Car& car, const pipeline::Outputs& out,
               bool reset, Instant now);
  void finish();

 private:
  Guarded() = default;

  std::optional<SharedStop> shared_;
  std::unique_ptr<pipeline::Reported> reported_;
  guardian::Status status_;
  bool received_ = false;
  std::uint64_t run_ = 0;
  bool barred_ = false, arm_ = false;
  bool ever_armed_ = false;
};

}  // namespace pitwall::io
