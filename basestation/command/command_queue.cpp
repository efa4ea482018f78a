// SPDX-License-Identifier: Apache-2.0
#include "basestation/command/command_queue.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "basestation/state/value_text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::command {
namespace {

using state::label_text;
using telemetry::CommandType;
using telemetry::field;
using telemetry::Outcome;

std::string words(const telemetry::Command& command) {
  const telemetry::CommandRow& row = telemetry::row_of(command.type);
  const bool named = !row.labels.empty() && !row.is_set() && row.has(command.argument);
  if (named) return std::string{row.name} + " " + label_text(row.labels, command.argument);
  return std::string{row.name} + formatted(" %g", command.argument) +
         (row.unit.empty() ? "" : " ") + std::string{row.unit};
}

// Why this override does not do; empty where it does.
std::string objection(const std::vector<Gate>& gates, const std::optional<Override>& overriding,
                      const Person& by, bool second_person) {
  for (const Gate& gate : gates) {
    if (!gate.ok && !can_be_overridden(gate.kind)) {
      return "gate " + std::string{text_of(gate.kind)} + ": " + gate.text;
    }
  }
  if (all_pass(gates)) return {};
  if (!overriding) return "gates: " + refusals_of(gates);
  if (overriding->reason.empty()) return "expected a reason for the override";
  if (!second_person) return {};
  const Person& second = overriding->second;
  if (second.name.empty()) return "expected a second person for the override";
  if (second.name == by.name || (second.console != 0 && second.console == by.console)) {
    return "expected a second person other than the first";
  }
  return {};
}

Step step_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::kApplied:
      return Step::kApplied;
    case Outcome::kExpired:
      return Step::kExpired;
    case Outcome::kSuperseded:
      return Step::kSuperseded;
    default:
      return Step::kRefused;
  }
}

// Where the car's state shows what this command set; none for one that sets nothing.
std::optional<telemetry::FieldIndex> echo_of(CommandType type) {
  switch (type) {
    case CommandType::kSpeedLimit:
      return field("planner.operator_limit");
    case CommandType::kRaceLine:
      return field("planner.line");
    case CommandType::kRole:
      return field("planner.role");
    case CommandType::kSensorsExcluded:
      return field("localization.excluded");
    default:
      return std::nullopt;
  }
}

}  // namespace

std::string_view text_of(Step step) {
  constexpr std::array<std::string_view, kSteps> kTexts{
      "staged", "gated", "sent", "received", "applied", "refused", "expired", "superseded"};
  return kTexts.at(static_cast<std::size_t>(step));
}

// Numbers rise by one: the place follows from the number.
const Ticket* CommandQueue::ticket(TicketId id) const {
  if (tickets_.empty() || id < tickets_.front().id || id > newest_) return nullptr;
  return &tickets_[id - tickets_.front().id];
}
Ticket* CommandQueue::find(TicketId id) {
  const bool there = ticket(id) != nullptr;
  return there ? &tickets_[id - tickets_.front().id] : nullptr;
}

void CommandQueue::reach(Ticket& ticket, Step step, Instant now) {
  ticket.step = step;
  ticket.at.at(static_cast<std::size_t>(step)) = now;
  ticket.revision = ++revision_;
}

void CommandQueue::end(Ticket& ticket, Step step, std::string text, Instant now) {
  ticket.text = std::move(text);
  reach(ticket, step, now);
  audit_->add(now, ticket.by.name, words(ticket.command),
              std::string{text_of(step)} + (ticket.text.empty() ? "" : ": ") + ticket.text);
}

Unexpected<Problem> CommandQueue::refuse(const Person& by, const std::string& what, std::string why,
                                         Instant now) {
  audit_->add(now, by.name, what, "refused: " + why);
  return {Problem{what, std::move(why)}};
}

Result<TicketId, Problem> CommandQueue::stage(const Person& by, CommandType type, double argument,
                                              const GateInputs& inputs) {
  const telemetry::Command command{.type = type, .argument = argument, .issuer = by.console};
  const telemetry::CommandRow& row = telemetry::row_of(type);
  if (!row.has(argument)) {
    const char* const why = row.labels.empty() ? "out of range" : "no such value";
    return refuse(by, "stage " + words(command), why, inputs.now);
  }
  if (!row.offered) {
    return refuse(by, "stage " + words(command), "no car carries this out", inputs.now);
  }
  Ticket& ticket = tickets_.emplace_back();
  ticket.id = ++newest_;
  ticket.command = command;
  ticket.by = by;
  reach(ticket, Step::kStaged, inputs.now);
  ticket.gates = gates_of(command, params_, inputs);
  audit_->add(inputs.now, by.name, "stage " + words(command),
              all_pass(ticket.gates) ? "gates pass" : "gates: " + refusals_of(ticket.gates));
  if (tickets_.size() > kKept) tickets_.pop_front();
  return newest_;
}

Result<bool, Problem> CommandQueue::send(TicketId id, const Person& by,
                                         const std::optional<Override>& overriding,
                                         const GateInputs& inputs,
                                         telemetry::StationEndpoint& radio) {
  const std::string what = "send ticket " + std::to_string(id);
  Ticket* const ticket = find(id);
  if (ticket == nullptr) return refuse(by, what, "there is none", inputs.now);
  if (ticket->step != Step::kStaged) {
    return refuse(by, what, "is " + std::string{text_of(ticket->step)} + " already", inputs.now);
  }
  if (inputs.now - *ticket->at.front() > kStagedFor) {
    end(*ticket, Step::kExpired, "staged too long", inputs.now);
    return Unexpected{Problem{what, "was staged too long ago"}};
  }
  ticket->command.issuer = by.console;
  ticket->by = by;
  ticket->gates = gates_of(ticket->command, params_, inputs);
  if (std::string why = objection(ticket->gates, overriding, by, second_person_); !why.empty()) {
    reach(*ticket, Step::kStaged, inputs.now);  // shown with its new gates, may be tried again
    return refuse(by, "send " + words(ticket->command), std::move(why), inputs.now);
  }
  if (!all_pass(ticket->gates)) {
    ticket->overridden = overriding;
    audit_->add(inputs.now, by.name, "override " + words(ticket->command),
                (second_person_ ? "with " + overriding->second.name + ": " : std::string{}) +
                    overriding->reason + " (" + refusals_of(ticket->gates) + ")");
  }
  reach(*ticket, Step::kGated, inputs.now);
  ticket->number = radio.issue(ticket->command, inputs.now);
  if (!ticket->number) {
    end(*ticket, Step::kRefused, "no car, or too many under way", inputs.now);
    return Unexpected{Problem{what, ticket->text}};
  }
  ++issued_;
  if (const auto* const progress = radio.progress(*ticket->number)) ticket->progress = *progress;
  audit_->add(inputs.now, by.name, words(ticket->command), "on its way");
  return true;
}

Result<bool, Problem> CommandQueue::issue(const Person& by, CommandType type, double argument,
                                          const std::optional<Override>& overriding,
                                          const GateInputs& inputs,
                                          telemetry::StationEndpoint& radio) {
  const auto staged = stage(by, type, argument, inputs);
  if (!staged) return Unexpected{staged.error()};
  auto sent = send(*staged, by, overriding, inputs, radio);
  Ticket& ticket = *find(*staged);
  if (!sent && ticket.step == Step::kStaged) {
    ticket.text = sent.error().what;
    reach(ticket, Step::kRefused, inputs.now);
  }
  return sent;
}

Result<bool, Problem> CommandQueue::cancel(TicketId id, const Person& by, Instant now) {
  const std::string what = "cancel ticket " + std::to_string(id);
  Ticket* const ticket = find(id);
  if (ticket == nullptr) return refuse(by, what, "there is none", now);
  if (ticket->step != Step::kStaged) return refuse(by, what, "is on its way already", now);
  end(*ticket, Step::kRefused, "cancelled by " + by.name, now);
  return true;
}

void CommandQueue::stop(telemetry::StopLevel level, telemetry::StopReason reason, const Person& by,
                        Instant now, telemetry::StationEndpoint& radio) {
  radio.stop().demand(level, reason);
  pressed_ = {.by = by.name, .at = now};
  audit_->add(now, by.name,
              level == telemetry::StopLevel::kEmergency ? "EMERGENCY STOP" : "controlled stop",
              "in every packet from now on");
}

void CommandQueue::follow(const state::VehicleState& vehicle,
                          const telemetry::StationEndpoint& radio, Instant now) {
  for (Ticket& ticket : tickets_) {
    if (ticket.step == Step::kStaged && now - *ticket.at.front() > kStagedFor) {
      end(ticket, Step::kExpired, "staged too long", now);
    }
    if (!ticket.number) continue;
    const telemetry::CommandProgress* const progress = radio.progress(*ticket.number);
    if (progress != nullptr) ticket.progress = *progress;
    if (progress != nullptr && !is_final(ticket.step)) follow(ticket, *progress);
    const auto echo = echo_of(ticket.command.type);
    if (ticket.step != Step::kApplied || ticket.echoed || !echo) continue;
    const state::FieldView seen = vehicle.view(*echo, now);
    if (!state::usable(seen) || progress == nullptr) continue;
    const double off = std::abs(seen.value - progress->command.argument);
    if (off > telemetry::kFields[*echo].resolution) continue;
    ticket.echoed = true;
    reach(ticket, Step::kApplied, *ticket.at.at(static_cast<std::size_t>(Step::kApplied)));
  }
}

void CommandQueue::follow(Ticket& ticket, const telemetry::CommandProgress& progress) {
  if (progress.sent && ticket.step < Step::kSent) reach(ticket, Step::kSent, *progress.sent);
  if (progress.received && ticket.step < Step::kReceived) {
    reach(ticket, Step::kReceived, *progress.received);
  }
  if (!progress.outcome || !telemetry::is_final(*progress.outcome)) return;
  end(ticket, step_of(*progress.outcome), std::string{telemetry::text_of(*progress.outcome)},
      *progress.decided);
}

}  // namespace pitwall::command
