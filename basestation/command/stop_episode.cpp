// SPDX-License-Identifier: Apache-2.0
#include "basestation/command/stop_episode.hpp"

#include <algorithm>
#include <cmath>

#include "basestation/state/value_text.hpp"
#include "protocol/telemetry/delivery/event_content.hpp"

namespace pitwall::command {
namespace {

using state::FieldView;
using state::label_text;
using telemetry::CommandType;
using telemetry::field;

// Values of telemetry labels kModes, kArmings, kStopCauses.
constexpr double kDisarmed = 0.0, kStandby = 1.0, kDriving = 2.0, kControlledStop = 3.0,
                 kEmergencyStop = 4.0, kHalted = 5.0, kCoast = 6.0;
constexpr double kFirstRefusal = 2.0;
constexpr Duration kPressLead = seconds(2);        // by so much a press may precede the car's stop
constexpr double kByOperator[] = {1.0, 8.0, 9.0};  // stops and a disarm of the pit wall

double value_of(const GateInputs& in, telemetry::FieldIndex index) {
  return in.vehicle.view(index, in.now).value;
}

bool stops(double mode) {
  return mode == kControlledStop || mode == kEmergencyStop || mode == kHalted;
}

bool drives(double mode) { return mode == kStandby || mode == kDriving || mode == kCoast; }

alarms::State alarm_state(const GateInputs& in, std::string_view key) {
  return in.evaluator.alarms().state(*alarms::find_alarm(key));
}

bool any_alarm(const GateInputs& in, std::initializer_list<alarms::State> states) {
  return std::ranges::any_of(kStopAlarms, [&](std::string_view key) {
    return std::ranges::find(states, alarm_state(in, key)) != states.end();
  });
}

// Of a command that its holder would give now.
std::string refusing_gates(CommandType type, double argument, const GateParams& params,
                           const GateInputs& in) {
  return refusals_of(
      gates_of({.type = type, .argument = argument, .issuer = in.holder}, params, in));
}

// How the newest command of this kind since then ended, where the car or a gate refused it.
std::string refusal_since(const CommandQueue& queue, CommandType type,
                          std::optional<Instant> since) {
  const auto& tickets = queue.tickets();
  const auto newest = std::find_if(tickets.rbegin(), tickets.rend(),
                                   [&](const Ticket& t) { return t.command.type == type; });
  if (newest == tickets.rend() || (since && *newest->at.front() < *since)) return {};
  const bool failed = newest->step == Step::kRefused || newest->step == Step::kExpired;
  return failed ? "last try: " + newest->text : std::string{};
}

// Faults that the car reports now, by name; some of them bar arming.
std::string reported_faults(const GateInputs& in) {
  std::string list;
  const auto add = [&](telemetry::FieldIndex index, std::string_view names) {
    const double set = value_of(in, index);
    if (!(set > 0.0)) return;
    list += list.empty() ? "the car reports: " : ", ";
    list += state::bits_text(names, static_cast<std::uint32_t>(set));
  };
  add(field("faults.now"), telemetry::kFaultNames);
  add(field("faults.now_more"), telemetry::kFaultNamesMore);
  return list;
}

}  // namespace

std::string_view text_of(RecoveryStep step) {
  constexpr std::array<std::string_view, kRecoverySteps> kTexts{"release", "acknowledge", "reset",
                                                                "arm"};
  return kTexts.at(static_cast<std::size_t>(step));
}

void StopEpisode::advance(const Inputs& in) {
  const GateInputs& gates = in.gates;
  advanced_ = gates.now;
  const double mode = value_of(gates, field("mode.mode"));
  const double latch = value_of(gates, field("mode.stop_latch"));
  if (std::isnan(mode)) return;
  if (stops(mode) || latch > 0.0) {
    if (!stopped_) begin(in);
    explain(in);
  } else {
    received_driving_ = true;
    if (drives(mode)) stopped_.reset();
  }
  if (!stopped_) return;
  stopped_->mode = label_text(telemetry::kModes, mode);
  stopped_->latched = latch > 0.0;
  judge_steps(in);
}

void StopEpisode::begin(const Inputs& in) {
  stopped_.emplace();
  level_ = 0.0;
  const FieldView mode = in.gates.vehicle.view(field("mode.mode"), in.gates.now);
  if (received_driving_) stopped_->since = in.gates.now - mode.age;
}

// What is known of the beginning, as soon as it is known; who stops harder is told.
void StopEpisode::explain(const Inputs& in) {
  const GateInputs& gates = in.gates;
  const double mode = value_of(gates, field("mode.mode"));
  const double latch = value_of(gates, field("mode.stop_latch"));
  const double by_mode = mode == kEmergencyStop ? 2.0 : mode == kControlledStop ? 1.0 : 0.0;
  const double level = std::fmax(by_mode, latch);
  if (level > level_ || stopped_->level.empty()) {
    level_ = std::fmax(level, level_);
    stopped_->by.clear();
    stopped_->level = level_ > 0.0 ? label_text(telemetry::kStopLevels, level_) : "halted";
  }
  if (const double cause = value_of(gates, field("mode.first_stop_cause")); cause > 0.0) {
    stopped_->cause = label_text(telemetry::kStopCauses, cause);
    const auto number = static_cast<std::size_t>(cause);
    for (auto event = in.events.rbegin(); event != in.events.rend(); ++event) {
      const auto content = telemetry::content_of(*event);
      const auto* const fault = content ? std::get_if<telemetry::FaultEvent>(&*content) : nullptr;
      if (fault == nullptr || !fault->begins || fault->cause != number) continue;
      const std::string_view unit = telemetry::label_at(telemetry::kStopCauseUnits, number);
      if (unit != "-") {
        stopped_->value = static_cast<double>(fault->value);
        stopped_->unit = unit;
      }
      break;
    }
  } else if (stopped_->cause.empty() && latch > 0.0) {
    stopped_->cause = "operator: " + label_text(telemetry::kStopLevels, latch);
  }
  const bool operators =
      std::ranges::find(kByOperator, value_of(gates, field("mode.first_stop_cause"))) !=
          std::end(kByOperator) ||
      latch > 0.0;
  if (latch > 0.0 && !stopped_->latched) stopped_->by.clear();
  if (!operators || !stopped_->by.empty()) return;
  const std::optional<StopPress>& press = in.queue.pressed();
  const double reason = value_of(gates, field("uplink.stop_reason"));
  const bool is_of_this = press && (!stopped_->since || press->at >= *stopped_->since - kPressLead);
  if (is_of_this && !press->by.empty()) {
    stopped_->by = press->by;
  } else if (reason > 0.0) {
    stopped_->by = label_text(telemetry::kStopReasons, reason);
  }
}

void StopEpisode::judge_steps(const Inputs& in) {
  using enum RecoveryStep;
  using alarms::State;
  const GateInputs& gates = in.gates;
  const double mode = value_of(gates, field("mode.mode"));
  const auto step = [&](RecoveryStep which) -> RecoveryState& {
    return stopped_->steps.at(static_cast<std::size_t>(which)) = {};
  };
  const auto settle = [](RecoveryState& state, std::string waits, std::string last) {
    state.possible = waits.empty();
    state.why = waits.empty() ? std::move(last) : std::move(waits);
  };

  RecoveryState& release = step(kRelease);
  release.done = !stopped_->latched;
  stopped_->challenge = 0.0;
  if (!release.done) {
    stopped_->challenge = std::fmax(value_of(gates, field("mode.stop_challenge")), 0.0);
    settle(release,
           stopped_->challenge > 0.0
               ? refusing_gates(CommandType::kReleaseStop, stopped_->challenge, params_, gates)
               : std::string{"the car has not named its challenge yet"},
           refusal_since(in.queue, CommandType::kReleaseStop, stopped_->since));
  }

  RecoveryState& acknowledge = step(kAcknowledge);
  const bool unacknowledged = any_alarm(gates, {State::kUnack, State::kReturnedUnack});
  acknowledge.done = !unacknowledged;
  acknowledge.possible = unacknowledged;

  RecoveryState& reset = step(kReset);
  const bool alarm_left = any_alarm(gates, {State::kUnack, State::kAcked, State::kReturnedUnack,
                                            State::kLatched, State::kShelved, State::kSuppressed});
  const bool resting = mode == kDisarmed;
  reset.done = release.done && resting && !alarm_left;
  if (!reset.done) {
    std::string waits = !release.done       ? "release the stop first"
                        : !acknowledge.done ? "acknowledge the alarm first"
                        : mode == kControlledStop || mode == kEmergencyStop
                            ? "the car still comes to a stop"
                            : refusing_gates(CommandType::kReset, 1.0, params_, gates);
    settle(reset, std::move(waits), refusal_since(in.queue, CommandType::kReset, stopped_->since));
  }

  RecoveryState& arm = step(kArm);
  std::string waits = !release.done ? "release the stop first"
                      : !reset.done ? "reset the car first"
                                    : refusing_gates(CommandType::kArm, 1.0, params_, gates);
  const double arming = value_of(gates, field("mode.arming"));
  std::string last = refusal_since(in.queue, CommandType::kArm, stopped_->since);
  if (!last.empty() && arming >= kFirstRefusal)
    last += "; the car says: " + label_text(telemetry::kArmings, arming);
  const std::string faults = reported_faults(gates);
  if (!faults.empty()) last += (last.empty() ? "" : "; ") + faults;
  settle(arm, std::move(waits), std::move(last));
}

}  // namespace pitwall::command
