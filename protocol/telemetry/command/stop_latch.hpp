// The operator's stop is state, not an event: it stands in every packet of the base, and the first
// that arrives latches it in the car. It is let go only by two steps that a lost, repeated or old
// packet cannot make.
//
//   base   level, epoch  ... every packet ...        kReleaseStop(challenge)
//   car            latch ---- standstill ---- challenge in telemetry ---- latch open, next epoch
//
//   law    the latch never goes down by itself: not with silence, a lower level, an older epoch, a
//          restart of the base, or replay; only release() with the challenge of this latch, at
//          standstill, opens it. A higher level raises it at once. A restart of the base raises no
//          latch and releases none
//   in     StopState of authentic packets; release with a challenge
//   out    level that holds, challenge (changes with each latch, drawn by the car)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/telemetry/registry/snapshot.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

enum class StopLevel : std::uint8_t { kNone, kControlled, kEmergency };
enum class StopReason : std::uint8_t {
  kNone,
  kOperator,
  kRaceControl,
  kPitCrew,
  kNoOperator,
  kTest
};

// What the base says: the fields of Group::kStop.
struct StopState {
  StopLevel level = StopLevel::kNone;
  std::uint8_t epoch = 0;  // modulo 254
  StopReason reason = StopReason::kNone;
};
void put(const StopState& state, Values& values);
std::optional<StopState> stop_state_of(const Values& values);

class StopLatch {
 public:
  void heard(const StopState& state, Instant at);
  StopLevel level() const { return level_; }
  StopReason reason() const { return reason_; }
  Instant since() const { return since_; }
  // 1 .. 65534; 0 while nothing is latched. `draw`: randomness, taken when a latch closes.
  std::uint16_t challenge() const { return challenge_; }
  void draw(std::uint16_t random) { next_challenge_ = random; }
  bool release(std::uint16_t challenge, bool standstill);

 private:
  StopLevel level_ = StopLevel::kNone;
  StopReason reason_ = StopReason::kNone;
  Instant since_{};
  std::uint16_t challenge_ = 0, next_challenge_ = 1;
};

// The base's side: what it says in every packet.
class StopDesk {
 public:
  void demand(StopLevel level, StopReason reason);  // raises, never lowers
  // After the car's latch opened: says none again, in a new epoch.
  void released();
  const StopState& state() const { return state_; }

 private:
  StopState state_;
};

}  // namespace pitwall::telemetry
