// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/clock_follower.hpp"

#include "hil/can_bus/clock_message.hpp"

namespace pitwall::can_bus {

Result<ClockFollower, Problem> ClockFollower::open(const std::string& file) {
  auto keeper = transport::ClockKeeper::keep(file);
  if (!keeper) return Unexpected{keeper.error()};
  return ClockFollower{*std::move(keeper)};
}

void ClockFollower::serve(transport::SerialLine& line) {
  while (const auto word = line.receive())
    if (const auto guest = decode_clock(*word)) pending_ = *guest;
  if (pending_ && !keeper_.is_held_up(keeper_.now())) {
    follow(*pending_);
    line.send(encode_clock(*pending_));
    pending_.reset();
  }
  line.flush();
}

void ClockFollower::follow(Instant guest) {
  if (guest == Instant::max()) {  // the run is over
    keeper_.end();
    here_minus_guest_.reset();
    return;
  }
  if (!here_minus_guest_) {
    here_minus_guest_ = keeper_.now() - guest;
    keeper_.begin(kLead);
  }
  keeper_.leap(guest + *here_minus_guest_);
  keeper_.advance(guest + *here_minus_guest_ + kLead);
}

}  // namespace pitwall::can_bus
