// Car process's end of the memory that it shares with the guardian. Without a name nothing is
// shared and all calls do nothing.
//   in     the name, whether the car is to be armed from the start; the outputs of every tick
//   out    the guardian's status for the next tick; whether arming is barred
//   invariants
//          a process started with --arm that finds the record of a run that ended armed refuses
//          this arm request, and so do later processes, until one starts without --arm or the
//          operator arms anew
//   errors open(): Problem with the path
//   cost   no allocation after open(); a tick below 20 us
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/io/shared_stop.hpp"
#include "vehicle/pipeline/guardian_interface.hpp"

namespace pitwall::io {

inline constexpr const char* kBarredText =
    "the last run ended while it was armed; look at the car, then start once without --arm";

class GuardianLink {
 public:
  static Result<GuardianLink, Problem> open(const std::string& name, bool arm);

  // An arm request that has been held since the start is refused.
  bool barred() const { return barred_; }
  // The guardian's status at `now`; to be called after the bus was read, so that no frame is newer
  // than the status.
  pipeline::GuardianView view(Instant now);
  // To be called before the frames of the tick are sent.
  void publish(const pipeline::Setup& setup, const pipeline::Car& car, const pipeline::Outputs& out,
               bool reset, Instant now);
  void finish();

 private:
  GuardianLink() = default;

  std::optional<SharedStop> shared_;
  std::unique_ptr<pipeline::GuardianRecord> reported_;
  guardian::Status status_;
  bool received_ = false;
  std::uint64_t run_ = 0;
  bool barred_ = false, arm_ = false;
  bool ever_armed_ = false;
};

}  // namespace pitwall::io
