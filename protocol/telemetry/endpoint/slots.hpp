// When packets are made: one each kSlot, and one half a slot later where something waits.
//
//   |---- slot ----|---- slot ----|        the grid stands still: a poll that comes late moves
//   state   between state   between        none of the slots after it
//
//   in     the time of each poll; whether a packet was made
//   out    whose turn it is; when to ask again
//   law    a slot that found no room within its first half is skipped and counted, never queued
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
  enum class Turn : std::uint8_t { kNobody, kOnSlot, kBetween };

  Turn turn(Instant now);
  void done(Turn turn, bool made, Instant now);
  Instant due(Instant now) const;  // nothing is anybody's turn before

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
