// Latch of the operator's stop. The stop is state, not an event: it is in every packet of the base,
// and the first one that arrives closes the latch in the car. The release needs two steps that a
// lost, repeated or old packet cannot perform.
//
//   base   level, epoch  ... every packet ...        kReleaseStop(challenge)
//   car            latch ---- standstill ---- challenge in telemetry ---- latch open, next epoch
//
//   invariants
//          the latch never opens by itself: not by silence, a lower level, an older epoch, a
//          restart of the base, or replay; only release() with the challenge of this latch, at
//          standstill, opens it. A higher level raises it at once. A restart of the base closes no
//          latch and opens none
//          a press that raises the level, or comes while a release is in transit, is a new epoch
//          and overrides that release: it changes the challenge of a closed latch, and closes an
//          opened one again. Only the released epoch and older ones are ignored
//   in     StopState of authentic packets; release with a challenge
//   out    level in force, challenge (changes with each epoch, drawn by the car)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/telemetry/command/command_table.hpp"
#include "protocol/telemetry/registry/registry.hpp"
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

// Stop demand of the base: the fields of Group::kStop.
struct StopState {
  StopLevel level = StopLevel::kNone;
  std::uint8_t epoch = 0;  // modulo kStopEpochs
  StopReason reason = StopReason::kNone;

  bool operator==(const StopState&) const = default;
};
void put(const StopState& state, Values& values);
// Nullopt if level or epoch is unset; an unknown reason of a later build becomes kNone.
std::optional<StopState> stop_state_of(const Values& values);

class StopLatch {
 public:
  void receive(const StopState& state, Instant at);
  StopLevel level() const { return level_; }
  StopReason reason() const { return reason_; }
  Instant since() const { return since_; }
  // 1 .. 65534; 0 while the latch is open. draw() sets the random value for the next closing.
  std::uint16_t challenge() const { return challenge_; }
  void draw(std::uint16_t random);
  bool release(std::uint16_t challenge, bool standstill);
  // New run of the base: its epochs begin again. A closed latch stays closed.
  void base_restarted() { epoch_.reset(); }

 private:
  friend struct Fingerprint;  // state hash for the exhaustive state explorer

  void take_challenge();

  StopLevel level_ = StopLevel::kNone;
  StopReason reason_ = StopReason::kNone;
  std::optional<std::uint8_t> epoch_;  // of the newest stop received
  Instant since_{};
  std::uint16_t challenge_ = 0, next_challenge_ = 1;
};

// Base side: the stop state of every packet.
class StopTransmitter {
 public:
  // A press of the button: raises the level, never lowers it.
  void demand(StopLevel level, StopReason reason);
  // A kReleaseStop was issued, and later applied. Then the level is kNone in a new epoch, unless
  // there was another press in between.
  void release_asked(CommandId id) { asked_ = id; }
  void released(CommandId id);
  const StopState& state() const { return state_; }

 private:
  friend struct Fingerprint;  // state hash for the exhaustive state explorer

  StopState state_;
  std::optional<CommandId> asked_;
};

}  // namespace pitwall::telemetry
