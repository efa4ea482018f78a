// Executor of operator requests to the car and to the base: console, command socket, script and
// bench all send theirs here.
//   in     requests, their senders, the time
//   out    stops, authority and commands at the radio's endpoint; changed alarms and settings;
//          tickets, the audit log, what operators have entered
//   invariants  a stop needs no authority and no gate. The same gates check a command from any
//          sender, which must hold the authority. Actions and refusals leave an audit line; but
//          renewals of the authority leave none, and actions on alarms are in the alarm history
//          only the holder of the authority changes settings and entries
//   errors Problem with the request as place
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "basestation/command/audit.hpp"
#include "basestation/command/authority_handover.hpp"
#include "basestation/command/command_queue.hpp"
#include "basestation/command/request.hpp"
#include "basestation/command/settings_editor.hpp"

namespace pitwall::command {

// Operator entries: facts that no field of the car has, and who entered them.
struct OperatorEntries {
  state::Expectations expected{};
  std::string round_speed_by{}, fuel_by{};
  Instant fuel_at{};
  std::uint64_t revision = 0;
};

struct ExecutorConfig {
  GateParams gates{};
  bool second_person = false;  // an override needs one
  std::uint64_t revision = 0;  // of the settings
  UpBudget budget{};
  SettingsEditor::Save save{};
};

class RequestExecutor {
 public:
  // All arguments taken by reference outlive it.
  RequestExecutor(ExecutorConfig config, telemetry::StationEndpoint& radio,
                  const state::VehicleState& vehicle, alarms::Evaluator& evaluator);
  RequestExecutor(const RequestExecutor&) = delete;
  RequestExecutor& operator=(const RequestExecutor&) = delete;

  Result<bool, Problem> execute(const Request& request, const Person& by, Instant now);
  // One joystick sample. The first and the last sample of a use leave an audit line.
  void steer(const telemetry::JoystickSample& sample, const Person& by, Instant now);
  // The console has disconnected.
  void left(const Person& by, Instant now) { authority_.left(by, now); }
  // Handles expiries and takes over the progress of commands; call it before publishing.
  void advance(Instant now);

  // Restores the entries of an earlier run of the base.
  void restore(const OperatorEntries& entries);
  // Notes the flag that the car has taken over from this base.
  void relay_flag(double flag);
  void note(const Person& by, std::string what, std::string result, Instant now) {
    audit_.add(now, by.name, std::move(what), std::move(result));
  }

  // Audits and counts a request that was not understood or is not allowed at its source.
  void refuse(const Person& by, std::string what, const std::string& why, Instant now);

  const Audit& audit() const { return audit_; }
  const AuthorityHandover& authority() const { return authority_; }
  CommandQueue& queue() { return queue_; }
  const CommandQueue& queue() const { return queue_; }
  const SettingsEditor& settings() const { return settings_; }
  const OperatorEntries& entries() const { return entries_; }
  std::uint64_t refused() const { return refused_; }

 private:
  struct Execution;

  telemetry::StationEndpoint& radio_;
  const state::VehicleState& vehicle_;
  alarms::Evaluator& evaluator_;
  Audit audit_;
  AuthorityHandover authority_;
  CommandQueue queue_;
  SettingsEditor settings_;
  OperatorEntries entries_;
  std::uint64_t refused_ = 0;
  std::optional<Instant> steered_{};  // the newest sample, while the joystick is in use
  std::string steered_by_;
};

}  // namespace pitwall::command
