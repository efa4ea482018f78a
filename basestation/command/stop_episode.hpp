// Stop of the car from its beginning until the car is armed again: why it stopped, and the way back
// to driving, step by step, each with what it still waits for.
//   in     what is known of the car, the gates, the alarms of the stop, who pressed, the events
//   out    the stop as consoles show it
//   begins when the car stops, is halted, or has latched a stop
//   ends   when it stands by or drives with nothing latched; what alarms are left are in the list
//   steps  release (the challenge is the car's), acknowledge (the alarms of the stop), reset (the
//          alarms and the car), arm. Each is judged by the gates that will judge it when it is sent
//   invariants  cause and value are those of the beginning: a reset of the car forgets them, this
//          does not. A level that rises is told, and so is who latched it; a press of an earlier
//          stop is not taken for this one's
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

// The alarms of a stop: these are acknowledged and reset on the way back.
inline constexpr std::array<std::string_view, 2> kStopAlarms{"emergency_stop", "controlled_stop"};

struct RecoveryState {
  bool done = false, possible = false;
  std::string why{};  // it is not possible yet, or what the car answered; empty: nothing to say
};

struct StoppedCar {
  std::string level{}, mode{};     // by their labels
  std::string cause{};             // in words
  double value = kUnset;           // that crossed its limit
  std::string_view unit{};         // of the value
  std::optional<Instant> since{};  // none: before this base heard the car
  std::string by{};                // who latched it; empty: the car itself
  bool latched = false;            // by an operator: it has to be released
  double challenge = 0.0;          // the car's name of this latch; 0: none, or not told yet
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

  // Ten times a second: what it shows ages no faster.
  void advance(const Inputs& in);
  // None: the car is not stopped.
  const std::optional<StoppedCar>& now() const { return stopped_; }
  bool is_due(Instant now) const { return now - advanced_ >= kEvery; }

 private:
  static constexpr Duration kEvery = milliseconds(100);

  void begin(const Inputs& in);
  void explain(const Inputs& in);
  void judge_steps(const Inputs& in);

  GateParams params_;
  std::optional<StoppedCar> stopped_;
  bool received_driving_ = false;  // or anything but stopped
  double level_ = 0.0;
  Instant advanced_{};
};

}  // namespace pitwall::command
