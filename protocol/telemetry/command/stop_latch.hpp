// The operator's stop is state, not an event: it stands in every packet of the base, and the first
// that arrives latches it in the car. It is let go only by two steps that a lost, repeated or old
// packet cannot make.
//
//   base   level, epoch  ... every packet ...        kReleaseStop(challenge)
//   car            latch ---- standstill ---- challenge in telemetry ---- latch open, next epoch
//
//   invariants
//          the latch never goes down by itself: not with silence, a lower level, an older epoch, a
//          restart of the base, or replay; only release() with the challenge of this latch, at
//          standstill, opens it. A higher level raises it at once. A restart of the base raises no
//          latch and releases none
//          a press that raises the level, or comes while a release is on its way, is a new epoch,
//          and it wins over that release: it changes the challenge of a closed latch, and closes an
//          opened one again; only the epoch that was released, and older ones, are not heard
//   in     StopState of authentic packets; release with a challenge
//   out    level that holds, challenge (changes with each epoch, drawn by the car)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/telemetry/command/command_table.hpp"
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
inline constexpr std::uint8_t kStopEpochs = 254;

// What the base says: the fields of Group::kStop.
struct StopState {
  StopLevel level = StopLevel::kNone;
  std::uint8_t epoch = 0;  // modulo kStopEpochs
  StopReason reason = StopReason::kNone;

  bool operator==(const StopState&) const = default;
};
void put(const StopState& state, Values& values);
// None where level or epoch is unset; a reason of a later build is kNone.
std::optional<StopState> stop_state_of(const Values& values);

class StopLatch {
 public:
  void receive(const StopState& state, Instant at);
  StopLevel level() const { return level_; }
  StopReason reason() const { return reason_; }
  Instant since() const { return since_; }
  // 1 .. 65534; 0 while nothing is latched. `draw`: randomness, taken when a latch closes.
  std::uint16_t challenge() const { return challenge_; }
  void draw(std::uint16_t random);
  bool release(std::uint16_t challenge, bool standstill);
  // Another run of the base: its epochs begin again. Latched stays latched.
  void base_restarted() { epoch_.reset(); }

 private:
  friend struct Fingerprint;  // of the exhaustive explorer, which compares states

  void take_challenge();

  StopLevel level_ = StopLevel::kNone;
  StopReason reason_ = StopReason::kNone;
  std::optional<std::uint8_t> epoch_;  // of the newest stop heard
  Instant since_{};
  std::uint16_t challenge_ = 0, next_challenge_ = 1;
};

// The base's side: what it says in every packet.
class StopTransmitter {
 public:
  // A press: raises, never lowers.
  void demand(StopLevel level, StopReason reason);
  // This kReleaseStop was given; and it was applied. Says none again, in a new epoch, unless there
  // was another press in between.
  void release_asked(CommandId id) { asked_ = id; }
  void released(CommandId id);
  const StopState& state() const { return state_; }

 private:
  friend struct Fingerprint;  // of the exhaustive explorer, which compares states

  StopState state_;
  std::optional<CommandId> asked_;
};

}  // namespace pitwall::telemetry
