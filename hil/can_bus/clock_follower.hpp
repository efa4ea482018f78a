// Follower of a guest's bench time on the host, so that a base station on the host uses the time of
// the car in the guest.
//
//   guest  bench sends its time every 5 ms --> host  moves its own bench time there
//                           <-- acknowledgement --   unless a process here is held up
//
//   in     the serial line to the guest, the file of the bench time of the host
//   out    bench time of the host: at most kLead past the guest's last message
//   errors open(): Problem with the file
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "protocol/transport/bench_clock/clock_keeper.hpp"
#include "protocol/transport/stream/serial_line.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::can_bus {

class ClockFollower {
 public:
  // Bench time pauses after two late messages.
  static constexpr Duration kLead = milliseconds(12);

  static Result<ClockFollower, Problem> open(const std::string& file);

  // To be called when the line has data, and again soon while is_waiting().
  void serve(transport::SerialLine& line);
  bool is_waiting() const { return pending_.has_value(); }

 private:
  explicit ClockFollower(transport::ClockKeeper keeper) : keeper_(std::move(keeper)) {}
  void follow(Instant guest);

  transport::ClockKeeper keeper_;
  std::optional<Duration> here_minus_guest_;
  std::optional<Instant> pending_;  // message of the guest that is not acknowledged yet
};

}  // namespace pitwall::can_bus
