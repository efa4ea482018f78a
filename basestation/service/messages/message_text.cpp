// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/messages/message_text.hpp"

#include <array>
#include <cmath>
#include <vector>

#include "basestation/state/event_text.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/telemetry/delivery/event_content.hpp"

namespace pitwall::service {
namespace {

using json::Array;
using json::Object;

std::string ms_or_null(const std::optional<Instant>& at) {
  return at ? json::number(at->milliseconds()) : "null";
}
std::string text_or_null(const std::string& text) {
  return text.empty() ? "null" : json::quoted(text);
}

std::string listed_text(const alarms::ListedAlarm& alarm) {
  return Object{}
      .number("id", alarm.id)
      .text("key", alarm.key)
      .text("text", alarm.text)
      .text("response", alarm.response)
      .text("priority", alarms::text_of(alarm.priority))
      .text("state", alarms::text_of(alarm.state))
      .number("since_ms", alarm.since.milliseconds())
      .number("value", alarm.value)
      .number("count", alarm.count)
      .flag("first_up", alarm.first_up)
      .flag("folded", alarm.folded)
      .flag("flooded", alarm.flooded)
      .flag("can_be_shelved", !alarms::alarm_row(alarm.index).always_shown)
      .json("shelved_until_ms", ms_or_null(alarm.shelved_until))
      .json("reason", text_or_null(alarm.reason))
      .json("by", text_or_null(alarm.by))
      .str();
}

std::string list_text(const std::vector<alarms::ListedAlarm>& list) {
  Array items;
  for (const alarms::ListedAlarm& alarm : list) items.json(listed_text(alarm));
  return items.str();
}

std::string gate_text(const command::Gate& gate) {
  return Object{}
      .text("name", command::text_of(gate.kind))
      .flag("ok", gate.ok)
      .number("value", gate.value)
      .text("unit", gate.unit)
      .text("word", gate.word)
      .json("age_ms", gate.known ? json::number(gate.age.milliseconds()) : "null")
      .flag("can_be_overridden", command::can_be_overridden(gate.kind))
      .text("text", gate.text)
      .str();
}

std::string times_text(const command::Ticket& ticket) {
  Object times;
  for (std::size_t i = 0; i < command::kSteps; ++i) {
    if (ticket.at[i]) {
      times.number(command::text_of(static_cast<command::Step>(i)), ticket.at[i]->milliseconds());
    }
  }
  return times.str();
}

std::string override_text(const command::Override& overriding) {
  return Object{}.text("reason", overriding.reason).text("second", overriding.second.name).str();
}

std::string_view severity_of(const telemetry::Event& event) {
  const auto content = telemetry::content_of(event);
  const auto* fault = content ? std::get_if<telemetry::FaultEvent>(&*content) : nullptr;
  const auto* threat = content ? std::get_if<telemetry::ThreatEvent>(&*content) : nullptr;
  const bool warns = (fault != nullptr && fault->begins) || (threat != nullptr && threat->begins);
  return warns ? "warning" : "info";
}

constexpr std::array kWindows_s{1, 5, 30};

std::string down_windows(const LinkSources& sources, std::size_t path) {
  constexpr int kOwnWindow_s = 5;  // of PathFigures' rate
  const telemetry::PathFigures& received = sources.report.paths[path].received;
  Array windows;
  for (const int length_s : kWindows_s) {
    const link::PathWindow window = sources.meter.path(path, seconds(length_s));
    Object object;
    object.number("seconds", length_s).number("loss", window.loss);
    object.number("rtt_ms", sources.meter.round_trip_ms(seconds(length_s)));
    object.number("jitter_ms", received.jitter.milliseconds());
    object.number("reorder", window.late).number("duplicate", window.duplicate);
    constexpr double kBytesPerKbit = 125.0;
    object.number("kbit_s",
                  length_s == kOwnWindow_s ? received.rate_bytes_per_s / kBytesPerKbit : kUnset);
    windows.json(object.number("cap_kbit_s", sources.meter.down_cap_kbit_s(path)).str());
  }
  return windows.str();
}

std::string up_windows(const LinkSources& sources, std::size_t path, Instant now) {
  constexpr std::array kLoss{telemetry::field("radio.loss_0"), telemetry::field("radio.loss_1")};
  const state::FieldView loss = sources.vehicle.view(kLoss[path], now);
  const bool known = loss.quality <= state::Quality::kLate && !loss.unset;
  Array windows;
  for (const int length_s : kWindows_s) {
    windows.json(Object{}
                     .number("seconds", length_s)
                     .number("loss", known ? loss.value : kUnset)
                     .number("rtt_ms", sources.meter.round_trip_ms(seconds(length_s)))
                     .number("kbit_s", sources.meter.path(path, seconds(length_s)).up_kbit_s)
                     .number("cap_kbit_s", sources.up_cap_kbit_s)
                     .str());
  }
  return windows.str();
}

std::string groups_text(const LinkSources& sources, Instant now) {
  Array groups;
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
    if (row.direction != telemetry::Direction::kDown) continue;
    const state::FieldView view = sources.vehicle.group(row.group, now);
    const bool ever = view.quality != state::Quality::kNever;
    groups.json(Object{}
                    .text("group", row.name)
                    .number("kbit_s", sources.meter.group_kbit_s(row.group))
                    .json("age_ms", ever ? json::number(view.age.milliseconds()) : "null")
                    .number("target_ms", row.target_age.milliseconds())
                    .str());
  }
  return groups.str();
}

std::string_view text_of(state::LinkState state) {
  return telemetry::label_at(state::kLinkStates, static_cast<std::size_t>(state));
}

}  // namespace

std::string hello_text(const CarIdentity& identity, Instant now) {
  return Object{}
      .text("type", "hello")
      .number("car", identity.car)
      .text("name", identity.name)
      .text("mode", identity.mode)
      .text("alarm_config", identity.alarm_config)
      .flag("second_person", identity.second_person)
      .number("time_ns", now.ns)
      .str();
}

std::string alarms_text(const alarms::Engine& engine) {
  return Object{}
      .text("type", "alarms")
      .json("active", list_text(engine.active()))
      .json("shelved", list_text(engine.shelved()))
      .json("suppressed", list_text(engine.suppressed()))
      .json("kpi", Object{}
                       .number("per_10_min", engine.rate().per_10_min())
                       .flag("flood", engine.rate().flood())
                       .str())
      .number("revision", engine.revision())
      .str();
}

std::string alarm_event_text(const alarms::AlarmEvent& event) {
  return Object{}
      .text("type", "alarm_event")
      .number("time_ms", event.at.milliseconds())
      .number("id", event.id)
      .text("key", event.key)
      .text("from", alarms::text_of(event.from))
      .text("to", alarms::text_of(event.to))
      .json("by", text_or_null(event.by))
      .json("reason", text_or_null(event.reason))
      .str();
}

std::string authority_text(const command::AuthorityHandover& talk,
                           const telemetry::AuthorityRegister& authority, Instant now) {
  telemetry::Values values;
  authority.put(values, now);
  const double renewed_ms = values[telemetry::field("authority.renewal_age")];
  const telemetry::HolderId holder = talk.holder(now);
  const bool held = holder != 0;
  const Duration left = telemetry::kAuthorityExpiry - from_seconds(renewed_ms * 1e-3);
  const auto& waiting = talk.waiting();
  return Object{}
      .text("type", "authority")
      .number("holder", holder)
      .json("holder_name", held ? json::quoted(talk.holder_person().name) : "null")
      .number("epoch", values[telemetry::field("authority.epoch")])
      .json("expires_ms",
            held && !std::isnan(renewed_ms) ? json::number((now + left).milliseconds()) : "null")
      .json("request", waiting ? Object{}
                                     .number("by", waiting->by.console)
                                     .text("name", waiting->by.name)
                                     .number("until_ms", waiting->until.milliseconds())
                                     .str()
                               : "null")
      .str();
}

std::string ticket_text(const command::Ticket& ticket) {
  Array gates;
  for (const command::Gate& gate : ticket.gates) gates.json(gate_text(gate));
  return Object{}
      .text("type", "command")
      .number("ticket", ticket.id)
      .text("name", telemetry::row_of(ticket.command.type).name)
      .number("argument", ticket.command.argument)
      .text("by", ticket.by.name)
      .number("console", ticket.by.console)
      .text("step", command::text_of(ticket.step))
      .json("gates", gates.str())
      .json("override", ticket.overridden ? override_text(*ticket.overridden) : "null")
      .json("times_ms", times_text(ticket))
      .flag("echoed", ticket.echoed)
      .text("text", ticket.text)
      .str();
}

std::string stop_text(const std::optional<command::StoppedCar>& stopped) {
  if (!stopped) return Object{}.text("type", "stop_state").flag("stopped", false).str();
  Array steps;
  for (std::size_t i = 0; i < command::kRecoverySteps; ++i) {
    const command::RecoveryState& step = stopped->steps.at(i);
    steps.json(Object{}
                   .text("step", command::text_of(static_cast<command::RecoveryStep>(i)))
                   .flag("done", step.done)
                   .flag("possible", step.possible)
                   .text("why", step.why)
                   .str());
  }
  return Object{}
      .text("type", "stop_state")
      .flag("stopped", true)
      .text("level", stopped->level)
      .text("mode", stopped->mode)
      .text("cause", stopped->cause)
      .number("value", stopped->value)
      .text("unit", stopped->unit)
      .json("since_ms", stopped->since ? json::number(stopped->since->milliseconds()) : "null")
      .text("by", stopped->by)
      .flag("latched", stopped->latched)
      .number("challenge", stopped->challenge)
      .json("steps", steps.str())
      .str();
}

std::string audit_text(const command::AuditLine& line) {
  return Object{}
      .text("type", "audit")
      .number("number", line.number)
      .number("time_ms", line.at.milliseconds())
      .text("who", line.who)
      .text("what", line.what)
      .text("result", line.result)
      .str();
}

std::string notice_text(const alarms::Notice& notice) {
  constexpr std::array<std::string_view, 3> kFates{"draft", "reported", "dismissed"};
  return Object{}
      .text("type", "notice")
      .number("id", notice.id)
      .text("kind", alarms::text_of(notice.kind))
      .number("time_ms", notice.at.milliseconds())
      .text("text", notice.text)
      .text("evidence", notice.evidence)
      .text("state", kFates[static_cast<std::size_t>(notice.fate)])
      .json("by", text_or_null(notice.by))
      .str();
}

std::string fuel_text(const rules::FuelLeft& fuel) {
  const auto label = telemetry::label_at(state::kFuelStates, static_cast<std::size_t>(fuel.state));
  return Object{}
      .text("type", "fuel")
      .number("laps", fuel.laps)
      .number("least_laps", fuel.least_laps)
      .number("attempts", fuel.attempts)
      .number("per_lap", fuel.per_lap_l)
      .number("level", fuel.level_l)
      .flag("measured", fuel.measured)
      .flag("estimated", fuel.estimated)
      .text("text", label)
      .str();
}

std::string event_text(const telemetry::Event& event) {
  return Object{}
      .text("type", "event")
      .number("time_ms", event.at.milliseconds())
      .text("text", state::event_text(event))
      .text("severity", severity_of(event))
      .str();
}

std::string mark_text(const std::string& text, const std::string& by, Instant now) {
  return Object{}
      .text("type", "mark")
      .number("time_ms", now.milliseconds())
      .text("text", text)
      .text("by", by)
      .str();
}

std::string link_text(const LinkSources& sources, Instant now) {
  Array paths;
  for (std::size_t path = 0; path < sources.paths; ++path) {
    paths.json(Object{}
                   .number("path", path)
                   .text("direction", "down")
                   .json("windows", down_windows(sources, path))
                   .str());
    paths.json(Object{}
                   .number("path", path)
                   .text("direction", "up")
                   .json("windows", up_windows(sources, path, now))
                   .str());
  }
  return Object{}
      .text("type", "link")
      .text("state", text_of(sources.state))
      .number("since_ms", sources.since.milliseconds())
      .json("paths", paths.str())
      .json("groups", groups_text(sources, now))
      .str();
}

}  // namespace pitwall::service
