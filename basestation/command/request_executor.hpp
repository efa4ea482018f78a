// The one path of operators' requests to the car and to the base's judgement: console, command
// socket, script and bench all end here.
//   in     requests, who sends them, the time
//   out    stops, authority and commands at the radio's endpoint; alarms and settings changed;
//          tickets, the audit log, what operators have entered
//   invariants  a stop needs nothing. Whoever sends a command, the same gates judge it, and the
//          authority has to be held by its sender; every act and every refusal leaves an audit line
//          settings and entries are changed only by who holds the authority
//   errors Problem with the request as place; audited
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

// What operators entered that no field of the car says, and who did.
struct OperatorEntries {
  state::Expectations expected{};
  std::string round_speed_by{}, fuel_by{};
  Instant fuel_at{};
  std::uint64_t revision = 0;
};

struct ExecutorConfig {
  GateParams gates{};
  bool second_person = false;  // of an override
  std::uint64_t revision = 0;  // of the settings
  UpBudget budget{};
  SettingsEditor::Save save{};
};

class RequestExecutor {
 public:
  // All of them outlive it.
  RequestExecutor(ExecutorConfig config, telemetry::StationEndpoint& radio,
                  const state::VehicleState& vehicle, alarms::Evaluator& evaluator);
  RequestExecutor(const RequestExecutor&) = delete;
  RequestExecutor& operator=(const RequestExecutor&) = delete;

  Result<bool, Problem> execute(const Request& request, const Person& by, Instant now);
  // A sample of the joystick. Its first one and its end leave an audit line, those between none.
  void steer(const telemetry::JoystickSample& sample, const Person& by, Instant now);
  // The console is gone.
  void left(const Person& by, Instant now) { authority_.left(by, now); }
  // Expiries, and how far the car came with its commands; before anything is published.
  void advance(Instant now);

  // Those of a base before this one, in force again.
  void restore(const OperatorEntries& entries);
  // The flag that the car has taken from this base.
  void relay_flag(double flag);
  void note(const Person& by, std::string what, std::string result, Instant now) {
    audit_.add(now, by.name, std::move(what), std::move(result));
  }

  // What was not understood, or may not be asked there.
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
