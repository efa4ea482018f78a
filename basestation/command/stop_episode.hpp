// Stop of the car, from its beginning until the car is armed again: its cause, and the steps of the
// recovery, each with what it still waits for.
//   in     the vehicle state, the gates, the alarms of the stop, the operator's press, the events
//   out    the stop as consoles show it
//   begins when the car stops, is halted, or has latched a stop
//   ends   when the car is in standby or drives with nothing latched; remaining alarms are in the
//          list
//   steps  release (with the car's challenge), acknowledge (the alarms of the stop), reset (the
//          alarms and the car), arm. Each is checked by the gates that check its command when sent
//   invariants  cause and value are those of the beginning, also after a reset of the car. A rise
//          of the level is shown with its author; the press of an earlier stop does not make its
//          operator the author of this one
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "basestation/command/command_queue.hpp"
#include "basestation/command/gates.hpp"
#include "protocol/telemetry/delivery/events.hpp"

namespace pitwall::command {

enum class RecoveryStep : std::uint8_t { kRelease, kAcknowledge, kReset, kArm };
inline constexpr std::size_t kRecoverySteps = 4;
std::string_view text_of(RecoveryStep step);

// The alarms of a stop, acknowledged and reset during recovery.
inline constexpr std::array<std::string_view, 2> kStopAlarms{"emergency_stop", "controlled_stop"};

struct RecoveryState {
  bool done = false, possible = false;
  std::string why{};  // it is not possible yet, or what the car answered; may be empty
};

struct StoppedCar {
  std::string level{}, mode{};     // as labels
  std::string cause{};             // as text
  double value = kUnset;           // that crossed its limit
  std::string_view unit{};         // of the value
  std::optional<Instant> since{};  // nullopt: before the first packet of the car
  std::string by{};                // who latched it; empty: the car itself
  bool latched = false;            // by an operator; needs a release
  double challenge = 0.0;          // the car's number of this latch; 0: no latch, or not received
  std::array<RecoveryState, kRecoverySteps> steps{};
};

class StopEpisode {
 public:
  struct Inputs {
    GateInputs gates;
    const CommandQueue& queue;
    const std::deque<telemetry::Event>& events;  // of the car, newest last
  };

  explicit StopEpisode(const GateParams& params = {}) : params_(params) {}

  // Call it ten times a second.
  void advance(const Inputs& in);
  // nullopt: the car is not stopped.
  const std::optional<StoppedCar>& now() const { return stopped_; }
  bool is_due(Instant now) const { return now - advanced_ >= kEvery; }

 private:
  static constexpr Duration kEvery = milliseconds(100);

  void begin(const Inputs& in);
  void explain(const Inputs& in);
  void judge_steps(const Inputs& in);

  GateParams params_;
  std::optional<StoppedCar> stopped_;
  bool received_driving_ = false;  // the car was received in a mode other than stopped
  double level_ = 0.0;
  Instant advanced_{};
};

}  // namespace pitwall::command
