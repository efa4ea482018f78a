// Messages of the base to its consoles, as the texts of PROTOCOL.md.
//   in     alarms, authority, tickets, audit lines, drafts, fuel, events, figures of the link
//   out    one JSON object each, with its type
//   units  milliseconds on the base's clock, as PROTOCOL.md describes them
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "basestation/alarms/evaluator.hpp"
#include "basestation/command/audit.hpp"
#include "basestation/command/authority_handover.hpp"
#include "basestation/command/command_queue.hpp"
#include "basestation/command/stop_episode.hpp"
#include "basestation/link/link_meter.hpp"
#include "protocol/telemetry/delivery/events.hpp"

namespace pitwall::service {

// Identity of car and base for consoles.
struct CarIdentity {
  int car = 0;
  std::string name{}, mode = "NONE", alarm_config{};
  bool second_person = false;  // an override needs one

  bool operator==(const CarIdentity&) const = default;
};

// Identity of car and base, without the role of the client.
std::string hello_text(const CarIdentity& identity, Instant now);
std::string alarms_text(const alarms::Engine& engine);
std::string alarm_event_text(const alarms::AlarmEvent& event);
std::string authority_text(const command::AuthorityHandover& talk,
                           const telemetry::AuthorityRegister& authority, Instant now);
std::string ticket_text(const command::Ticket& ticket);
// nullopt: the car is not stopped.
std::string stop_text(const std::optional<command::StoppedCar>& stopped);
std::string audit_text(const command::AuditLine& line);
std::string notice_text(const alarms::Notice& notice);
std::string fuel_text(const rules::FuelLeft& fuel);
std::string event_text(const telemetry::Event& event);
std::string mark_text(const std::string& text, const std::string& by, Instant now);

struct LinkSources {
  const telemetry::LinkReport& report;
  const link::LinkMeter& meter;
  const state::VehicleState& vehicle;
  state::LinkState state = state::LinkState::kNone;
  Instant since{};
  std::uint8_t paths = 1;
  double up_cap_kbit_s = kUnset;  // of each path
};
std::string link_text(const LinkSources& sources, Instant now);

}  // namespace pitwall::service
