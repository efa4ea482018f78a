// State of one direction for each packet: safety groups first and always, then by the scheduler, as
// far as there is room; what is not yet due fills a share of a packet that has room.
//   in     the newest snapshot at the moment when a packet is made; the present rate of the path
//   out    groups in the packet; what of it is safety's
//   invariants  a slow group (health, statistics) goes before bulk from half of its target age on,
//          or from the age refresh_period() on, whichever is sooner. The period is the shortest
//          with which all state takes at most half of the present rate: at 256 kbit/s some 50 ms
//          for all groups of the car; at 128 kbit/s there is none, target ages alone count
//   units  bytes per second, with IP and UDP
//   cost   no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/telemetry/endpoint/link_report.hpp"
#include "protocol/telemetry/flow/scheduler.hpp"
#include "protocol/telemetry/packet/body.hpp"
#include "protocol/telemetry/registry/snapshot.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

class StateLane {
 public:
  // Of a packet with nothing better to carry: what slow groups get before they are due. It makes
  // each packet later by as much of a slot at most.
  static constexpr double kEarlyShare = 0.1;

  explicit StateLane(Direction direction, double early_share = kEarlyShare);

  // The path of a packet: its round trip, and the rate that its budget has at present (0: target
  // ages alone count).
  struct Path {
    Duration round_trip{};
    double bytes_per_s = 0.0;
  };
  // What the next packet shall have. Returns the bytes of it that are safety's: the share of the
  // budget that is asked for must be the one that is used.
  // `known`: groups that may be sent.
  std::size_t choose(const Snapshot& snapshot, GroupSet known, Path path, Instant now);
  // Between two packets with the same slow group of these, where state takes half of the rate;
  // Scheduler::kNoPeriod where safety and motion in each slot take it.
  Duration refresh_period(GroupSet groups, double bytes_per_s) const;
  struct Writing {
    bool only_safety = false;
    bool between = false;  // half a slot later
    bool something_waits = false;
  };
  // Returns the bytes of what was written that are safety's.
  std::size_t write(BodyWriter& body, const Snapshot& snapshot, Writing how, Instant now);
  // The packet that write() was for has this number.
  void sent(std::uint64_t sequence, const Snapshot& snapshot, Instant now);
  void acked(std::uint64_t sequence) { scheduler_.acked(sequence); }
  // A new session: the other end is known to have nothing.
  void forget() { scheduler_.forget(); }

  const GroupFigures& figures(Group group) const { return scheduler_.figures(group); }
  void report(LinkReport& out) const;

 private:
  bool takes(Group group, Writing how, std::size_t room) const;
  void add_early(Scheduler::Order& wanted, Writing how, std::size_t room) const;

  Direction direction_;
  double early_share_;
  std::size_t fast_size_;  // of safety and motion
  Scheduler scheduler_;
  CodecCounters codec_;
  GroupSet late_, wanted_, written_;
  Scheduler::Order order_;
};

}  // namespace pitwall::telemetry
