// What the base tells its consoles, as the texts of PROTOCOL.md.
//   in     alarms, authority, tickets, audit lines, drafts, fuel, events, figures of the link
//   out    one JSON object each, with its type
//   units  milliseconds on the base's clock, as PROTOCOL.md has them
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "basestation/command/audit.hpp"
#include "basestation/command/authority_talk.hpp"
#include "basestation/command/desk.hpp"
#include "basestation/outlets/wall/link_meter.hpp"
#include "basestation/picture/watch/watch.hpp"
#include "protocol/telemetry/delivery/events.hpp"

namespace pitwall::outlets::wall {

std::string alarms_text(const alarms::Engine& engine);
std::string alarm_event_text(const alarms::AlarmEvent& event);
std::string authority_text(const command::AuthorityTalk& talk, const telemetry::AuthorityDesk& desk,
                           Instant now);
std::string ticket_text(const command::Ticket& ticket);
std::string audit_text(const command::AuditLine& line);
std::string notice_text(const alarms::Notice& notice);
std::string fuel_text(const picture::FuelLeft& fuel);
std::string event_text(const telemetry::Event& event);
std::string mark_text(const std::string& text, const std::string& by, Instant now);

struct LinkSaid {
  const telemetry::LinkReport& report;
  const LinkMeter& meter;
  const picture::Picture& picture;
  picture::LinkState state = picture::LinkState::kNone;
  Instant since{};
  std::uint8_t paths = 1;
  double up_cap_kbit_s = kUnset;  // of each path
};
std::string link_text(const LinkSaid& said, Instant now);

}  // namespace pitwall::outlets::wall
