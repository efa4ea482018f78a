// Selection of the state groups for each packet of one direction: all safety groups, then groups in
// the order of the scheduler as far as there is room; groups that are not yet due may fill a share
// of a packet that has room.
//   in     the newest snapshot at the moment when a packet is made; the present rate of the path
//   out    groups in the packet; the bytes of it that are safety content
//   invariants  a slow group (health, statistics) is sent before bulk data once its age is half of
//          its target age, or refresh_period() if that is sooner. The period is the shortest with
//          which all state takes at most half of the present rate: about 50 ms at 256 kbit/s for
//          all groups of the car. At 128 kbit/s there is no period; only the target ages count
//   units  bytes per second, with IP and UDP
//   cost   no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/telemetry/endpoint/link_report.hpp"
#include "protocol/telemetry/flow/scheduler.hpp"
#include "protocol/telemetry/packet/body.hpp"
#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

class StateLane {
 public:
  // Share of a packet that slow groups may fill before they are due, if nothing else waits. It
  // delays each packet by at most the same share of a slot.
  static constexpr double kEarlyShare = 0.1;

  explicit StateLane(Direction direction, double early_share = kEarlyShare);

  // Round trip of the path of a packet, and the present rate of its budget (0: only target ages
  // count).
  struct Path {
    Duration round_trip{};
    double bytes_per_s = 0.0;
  };
  // Selects the groups of the next packet. Returns the bytes of its safety groups: the caller
  // requests this part of the budget and spends the same. `known`: groups that may be sent.
  std::size_t choose(const Snapshot& snapshot, GroupSet known, Path path, Instant now);
  // Time between two packets with the same slow group of `groups` if state takes half of the rate;
  // Scheduler::kNoPeriod if safety and motion in each slot already take half.
  Duration refresh_period(GroupSet groups, double bytes_per_s) const;
  struct Writing {
    bool only_safety = false;
    bool between = false;  // half a slot later
    bool something_waits = false;
  };
  // Returns the bytes written that are safety content.
  std::size_t write(BodyWriter& body, const Snapshot& snapshot, Writing how, Instant now);
  // The packet that write() filled was sent under this sequence number.
  void sent(std::uint64_t sequence, const Snapshot& snapshot, Instant now);
  void acked(std::uint64_t sequence) { scheduler_.acked(sequence); }
  // Starts a new session: no sample counts as received by the other end.
  void forget() { scheduler_.forget(); }

  const GroupFigures& figures(Group group) const { return scheduler_.figures(group); }
  void report(LinkReport& out) const;

 private:
  bool takes(Group group, Writing how, std::size_t room) const;
  void add_early(Scheduler::Order& wanted, Writing how, std::size_t room) const;

  Direction direction_;
  double early_share_;
  std::size_t fast_size_;  // bytes of the safety and motion groups
  Scheduler scheduler_;
  CodecCounters codec_;
  GroupSet late_, wanted_, written_;
  Scheduler::Order order_;
};

}  // namespace pitwall::telemetry
