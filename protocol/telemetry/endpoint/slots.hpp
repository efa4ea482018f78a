// Send schedule: one packet each kSlot, one half a slot later if content waits, and one at any time
// for urgent content, which is a stop.
//
//   |---- slot ----|---- slot ----|        the grid is fixed: a late poll does not move the slots
//   state   between state   between        after it
//
//   in     the time of each poll; whether urgent content waits; whether a packet was made
//   out    the kind of packet to make now; the time of the next poll
//   invariants
//          a slot that finds no room within its first half is skipped and counted, never queued
//          an urgent packet is due at each poll until it is made; it replaces the packet between
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

inline constexpr Duration kSlot = milliseconds(20);
// A poll at most this early counts for the coming slot, because loops of 10 ms have jitter.
inline constexpr Duration kSlotEarly = milliseconds(2);

class Slots {
 public:
  enum class Turn : std::uint8_t { kNone, kOnSlot, kBetween, kAtOnce };

  Turn turn(Instant now, bool at_once = false);
  void done(Turn turn, bool made, Instant now);
  // Time of the next poll: no packet is due before.
  Instant due(Instant now, bool at_once = false) const;

  // True if the packet of the slot is done and half of the slot is over.
  bool is_between(Instant now) const {
    return slot_ && stage_ != Stage::kDue && now + kSlotEarly >= half() &&
           now + kSlotEarly < *slot_ + kSlot;
  }

  std::uint64_t count() const { return count_; }
  std::uint64_t skipped() const { return skipped_; }

 private:
  enum class Stage : std::uint8_t { kDue, kBetween, kOver };
  Instant half() const { return *slot_ + kSlot / 2; }
  bool advance(Instant now);

  std::optional<Instant> slot_;  // the last one
  Stage stage_ = Stage::kDue;
  std::uint64_t count_ = 0, skipped_ = 0;
};

}  // namespace pitwall::telemetry
