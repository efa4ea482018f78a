// Bench time of a host that follows that of its guest, so that a base station out here lives by the
// time of the car in there.
//
//   guest  bench keeps time -- where it is, every 5 ms --> host  moves its own time there
//                           <-- how far it was followed --       unless somebody here is held up
//
//   in     the line to the guest, the file in which time is kept here
//   out    time here: at most a lead past the guest's last word
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
  // Two words late before time stands.
  static constexpr Duration kLead = milliseconds(12);

  static Result<ClockFollower, Problem> open(const std::string& file);

  // To be called when the line has something, and again soon while is_waiting().
  void serve(transport::SerialLine& line);
  bool is_waiting() const { return owed_.has_value(); }

 private:
  explicit ClockFollower(transport::ClockKeeper keeper) : keeper_(std::move(keeper)) {}
  void follow(Instant guest);

  transport::ClockKeeper keeper_;
  std::optional<Duration> here_minus_guest_;
  std::optional<Instant> owed_;  // a word of the guest that is not answered yet
};

}  // namespace pitwall::can_bus
