// The player's rim on this machine: real clock, real sockets.
//
//   deadline              |
//   sleep    ...........|  (lead before it)
//   wake             ....|  somewhere here: late by what a sleep is usually late
//   look                  |  at the clock, until it is time
//
// A sleep ends late, by 50 to 100 us in a guest and a few on a quiet host, and not always by the
// same. So it is set to end early by the lead, and what is left is spent looking at the clock; gaps
// shorter than the lead are not slept through at all. In a guest a system call takes as long as a
// short frame on the wire, so signals are looked at only where there is time.
//
//   in     timeline, one sender per bus, the lead (measured, or given; 0: plain sleeps)
//   out    now(), wait_until(), send(), stopped() as Player asks for them
//   errors open(): Problem. While playing: SendOutcome only
//   cost   the lead is time of the processor that nobody else gets, once per wake-up; where that
//          would be more than a quarter of all time (BusyBudget), sleeps are plain for a while
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "hil/replay/busy_budget.hpp"
#include "hil/replay/player.hpp"
#include "hil/replay/timeline.hpp"
#include "protocol/transport/can/can_sender.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::replay {

inline constexpr Duration kMaxLead = microseconds(200);

class SocketRim {
 public:
  // Everything is laid out for the kernel here. The stop signal is installed.
  static Result<SocketRim, Problem> open(const Timeline& timeline);

  // How late sleeps of this thread are nearly always at most, up to kMaxLead; takes 40 ms.
  static Duration measured_lead();
  void set_lead(Duration lead);

  Instant now();
  void wait_until(Instant deadline);
  BusOutcome send(std::size_t bus, std::size_t first, std::size_t count);
  bool stopped() const { return stopped_; }
  // The last error of the kernel but a full queue, for people; empty: none.
  std::string last_error() const;

 private:
  struct Bus {
    transport::CanSender sender;
    transport::PreparedFrames frames;
  };
  SocketRim(std::vector<Bus> buses, transport::StopSignal stop)
      : buses_(std::move(buses)), stop_(std::move(stop)) {}
  void look_for_signals(Instant deadline);

  std::vector<Bus> buses_;
  transport::StopSignal stop_;
  Duration lead_{};
  Duration half_look_{};  // of what one look at the clock takes
  Instant read_{};        // what the clock last said
  Instant looked_{};      // for signals
  BusyBudget budget_;
  bool stopped_ = false;
  int last_error_ = 0;
};

}  // namespace pitwall::replay
