// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/endpoint/slots.hpp"

namespace pitwall::telemetry {
namespace {

// A budget that had no room is asked again this much later.
constexpr Duration kAskAgain = milliseconds(1);

}  // namespace

Slots::Turn Slots::turn(Instant now, bool at_once) {
  if (advance(now)) stage_ = Stage::kDue;
  if (stage_ == Stage::kDue) return Turn::kOnSlot;
  if (at_once) return Turn::kAtOnce;
  return stage_ == Stage::kBetween && now + kSlotEarly >= half() ? Turn::kBetween : Turn::kNone;
}

bool Slots::advance(Instant now) {
  if (!slot_) {
    slot_ = now;
    count_ = 1;
    return true;
  }
  const std::int64_t steps = (now + kSlotEarly - *slot_) / kSlot;
  if (steps <= 0) return false;
  if (stage_ == Stage::kDue) ++skipped_;
  slot_ = *slot_ + kSlot * steps;
  count_ += static_cast<std::uint64_t>(steps);
  skipped_ += static_cast<std::uint64_t>(steps - 1);
  return true;
}

void Slots::done(Turn turn, bool made, Instant now) {
  const bool beside = turn == Turn::kBetween || turn == Turn::kAtOnce;
  if (beside && made) stage_ = Stage::kOver;
  if (turn != Turn::kOnSlot || (!made && now + kAskAgain < half())) return;
  if (!made) ++skipped_;
  stage_ = Stage::kBetween;
}

Instant Slots::due(Instant now, bool at_once) const {
  if (!slot_ || stage_ == Stage::kDue || at_once) return now + kAskAgain;
  if (stage_ == Stage::kOver) return *slot_ + kSlot;
  return now < half() ? half() : now + kAskAgain;
}

}  // namespace pitwall::telemetry
