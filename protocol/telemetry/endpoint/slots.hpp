// Schedule of packets: one each kSlot, one half a slot later where something waits, and one at any
// time for what cannot wait: a stop.
//
//   |---- slot ----|---- slot ----|        the grid stands still: a poll that comes late moves
//   state   between state   between        none of the slots after it
//
//   in     the time of each poll; whether something cannot wait; whether a packet was made
//   out    whose turn it is; when to ask again
//   invariants
//          a slot that found no room within its first half is skipped and counted, never queued
//          what cannot wait is asked for at each poll until it was made; it takes the place of the
//          packet between
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

inline constexpr Duration kSlot = milliseconds(20);
// A poll so little before its slot is the slot's: loops that tick at 10 ms do so with jitter.
inline constexpr Duration kSlotEarly = milliseconds(2);

class Slots {
 public:
  enum class Turn : std::uint8_t { kNobody, kOnSlot, kBetween, kAtOnce };

  Turn turn(Instant now, bool at_once = false);
  void done(Turn turn, bool made, Instant now);
  // Nothing is anybody's turn before.
  Instant due(Instant now, bool at_once = false) const;

  // The slot has had its packet, and half of it is over.
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
