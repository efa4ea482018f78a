// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/command/stop_latch.hpp"

#include <algorithm>

#include "protocol/vocabulary/sequence.hpp"

namespace pitwall::telemetry {
namespace {

constexpr FieldIndex kLevel = field("stop.level"), kStopEpoch = field("stop.epoch"),
                     kReason = field("stop.reason");
static_assert(kFields[kStopEpoch].quantized().count() == kStopEpochs);
constexpr std::uint16_t kChallenges = 65'534;
constexpr auto kLastReason = static_cast<double>(StopReason::kTest);

constexpr std::uint8_t after(std::uint8_t epoch) {
  return static_cast<std::uint8_t>((epoch + 1U) % kStopEpochs);
}

}  // namespace

void put(const StopState& state, Values& values) {
  values[kLevel] = static_cast<double>(state.level);
  values[kStopEpoch] = state.epoch;
  values[kReason] = static_cast<double>(state.reason);
}

std::optional<StopState> stop_state_of(const Values& values) {
  const double level = values[kLevel], epoch = values[kStopEpoch], reason = values[kReason];
  const bool whole = level >= 0 && level <= static_cast<double>(StopLevel::kEmergency) &&
                     epoch >= 0 && epoch < kStopEpochs;
  if (!whole) return std::nullopt;
  const bool known = reason >= 0 && reason <= kLastReason;
  return StopState{static_cast<StopLevel>(level), static_cast<std::uint8_t>(epoch),
                   known ? static_cast<StopReason>(reason) : StopReason::kNone};
}

void StopLatch::receive(const StopState& state, Instant at) {
  if (state.level == StopLevel::kNone) return;
  const bool pressed = !epoch_ || is_newer(state.epoch, *epoch_, kStopEpochs);
  const bool raised = state.level > level_;
  if (level_ == StopLevel::kNone) {
    if (!pressed) return;  // the base has not yet heard that this one was released
    since_ = at;
  }
  if (pressed) epoch_ = state.epoch;
  if (pressed || raised) take_challenge();
  if (raised) {
    level_ = state.level;
    reason_ = state.reason;
  }
}

void StopLatch::draw(std::uint16_t random) {
  const auto drawn = static_cast<std::uint16_t>(random % kChallenges + 1U);
  if (drawn != challenge_) next_challenge_ = drawn;
}

void StopLatch::take_challenge() {
  challenge_ = next_challenge_;
  next_challenge_ = static_cast<std::uint16_t>(challenge_ % kChallenges + 1U);
}

bool StopLatch::release(std::uint16_t challenge, bool standstill) {
  if (level_ == StopLevel::kNone || challenge != challenge_ || !standstill) return false;
  level_ = StopLevel::kNone;
  reason_ = StopReason::kNone;
  challenge_ = 0;
  return true;
}

void StopTransmitter::demand(StopLevel level, StopReason reason) {
  if (level == StopLevel::kNone) return;
  const bool raises = level > state_.level;
  // A button that is held down, or hit in anger, is one press: epochs must not come round.
  if (!raises && !asked_) return;
  state_ = {std::max(level, state_.level), after(state_.epoch), raises ? reason : state_.reason};
  asked_.reset();
}

void StopTransmitter::released(CommandId id) {
  if (asked_ != id) return;
  state_ = {StopLevel::kNone, after(state_.epoch), StopReason::kNone};
  asked_.reset();
}

}  // namespace pitwall::telemetry
