// State of one direction on its way into packets: safety groups first and always, then by the
// scheduler, as far as there is room.
//   in     the newest snapshot at the moment when a packet is made
//   out    groups in the packet; what of it is safety's
//   cost   no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/telemetry/flow/scheduler.hpp"
#include "protocol/telemetry/packet/body.hpp"
#include "protocol/telemetry/registry/snapshot.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

class StateLane {
 public:
  explicit StateLane(Direction direction);

  // Bytes that the sampled safety groups take in a packet.
  std::size_t safety_size(const Snapshot& snapshot) const;

  struct Writing {
    bool only_safety = false;
    bool fill = false;  // nothing else waits for the room: motion goes before its time
    Duration round_trip{};
  };
  // Returns the bytes of it that are safety's.
  std::size_t write(BodyWriter& body, const Snapshot& snapshot, const Writing& how, Instant now);
  // The packet that write() was for has this number.
  void sent(std::uint64_t sequence, const Snapshot& snapshot, Instant now);
  void acked(std::uint64_t sequence) { scheduler_.acked(sequence); }
  // A new session: the other end is known to have nothing. Groups that it does not know alike are
  // not sent.
  void forget(GroupSet known);

  const GroupFigures& figures(Group group) const { return scheduler_.figures(group); }
  const CodecCounters& codec() const { return codec_; }

 private:
  Direction direction_;
  Scheduler scheduler_;
  CodecCounters codec_;
  GroupSet known_, wanted_, written_;
};

}  // namespace pitwall::telemetry
