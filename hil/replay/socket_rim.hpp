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
// Each track of frames has a CAN socket, each track of datagrams a UDP socket of its own.
//
//   in     timeline, which stays where it is as long as the rim; the lead (measured, or
//          given; 0: plain sleeps)
//   out    now(), wait_until(), send(), stopped() as Player asks for them
//   errors open(): Problem. While playing: SendOutcome only
//   bound  a datagram that the kernel took may still be lost: a full receive queue drops it, which
//          only its owner can count. That nobody listens the kernel tells, and unheard() says
//   cost   the lead is time of the processor that nobody else gets, once per wake-up; where that
//          would be more than a quarter of all time (BusyBudget), sleeps are plain for a while
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "hil/replay/busy_budget.hpp"
#include "hil/replay/player.hpp"
#include "hil/replay/timeline.hpp"
#include "protocol/transport/can/can_sender.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/udp_socket.hpp"
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
  TrackOutcome send(std::size_t track, std::size_t first, std::size_t count);
  bool stopped() const { return stopped_; }
  // The last error of the kernel but a full queue, for people; empty: none.
  std::string last_error() const;
  // Datagrams of a track that nobody listened to, as far as the kernel said so.
  std::uint64_t unheard(std::size_t track) const;

 private:
  struct Bus {
    transport::CanSender sender;
    transport::PreparedFrames frames;
  };
  struct Line {
    transport::UdpSocket socket;
    const Datagrams* datagrams;
  };
  using Sender = std::variant<Bus, Line>;
  static Result<Sender, Problem> open(const Track& track);
  static transport::SendOutcome send(Line& line, std::size_t first, std::size_t count);
  SocketRim(std::vector<Sender> senders, transport::StopSignal stop)
      : senders_(std::move(senders)), stop_(std::move(stop)) {}
  void look_for_signals(Instant deadline);

  std::vector<Sender> senders_;  // of each track
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
