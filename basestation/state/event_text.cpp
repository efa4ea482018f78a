// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/event_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "basestation/state/value_text.hpp"
#include "protocol/telemetry/command/command_table.hpp"
#include "protocol/telemetry/delivery/event_content.hpp"
#include "protocol/telemetry/registry/labels.hpp"
#include "protocol/telemetry/session/link_threats.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::state {
namespace {

std::string label(std::string_view labels, std::size_t index) {
  const std::string_view text = telemetry::label_at(labels, index);
  return text.empty() ? "no. " + std::to_string(index) : std::string{text};
}

std::string after(Instant from, Instant to) {
  return " after " + formatted("%g", std::round((to - from).milliseconds())) + " ms";
}

struct EventText {
  std::string operator()(const telemetry::LostEvents& e) const {
    return std::to_string(e.count) + " events were lost: the car's queue was full";
  }
  std::string operator()(const telemetry::FaultEvent& e) const {
    const std::string name = label(telemetry::kStopCauses, e.cause);
    return (e.begins ? "fault: " : "fault is over: ") + name + " (" +
           formatted("%g", static_cast<double>(e.value)) + ")";
  }
  std::string operator()(const telemetry::ModeEvent& e) const {
    std::string text =
        "mode: " + label(telemetry::kModes, e.from) + " -> " + label(telemetry::kModes, e.to);
    if (e.cause != 0) text += ", " + label(telemetry::kStopCauses, e.cause);
    return text;
  }
  std::string operator()(const telemetry::FlagEvent& e) const {
    const bool track = e.which == telemetry::FlagKind::kTrack;
    const std::string_view labels = track ? telemetry::kTrackFlags : telemetry::kVehicleFlags;
    return (track ? "track flag: " : "vehicle flag: ") + label(labels, e.from) + " -> " +
           label(labels, e.to);
  }
  std::string operator()(const telemetry::ArmingEvent& e) const {
    return "arming: " + label(telemetry::kArmings, e.arming);
  }
  std::string operator()(const telemetry::LapEvent& e) const {
    return formatted("lap %u: %.3f s", unsigned{e.number}, static_cast<double>(e.time_s));
  }
  std::string operator()(const telemetry::RestartEvent& e) const {
    return "part " + std::to_string(e.part) + " of the car restarted";
  }
  // Bytes of the air: what is no printable ASCII is shown as '?'.
  std::string operator()(const telemetry::TextEvent& e) const {
    constexpr char kFirst = ' ', kLast = '~';
    std::string text{e.text};
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c < kFirst || c > kLast; }, '?');
    return text;
  }
  std::string operator()(const telemetry::ThreatEvent& e) const {
    if (e.threat >= telemetry::kThreats) return "radio: an attack that this base does not know";
    std::array<char, telemetry::kThreatLine> text{};
    const auto threat = static_cast<telemetry::Threat>(e.threat);
    return std::string{
        telemetry::write_line({threat, e.begins, e.most_per_s, {}}, e.seen_by_base, text)};
  }
};

}  // namespace

std::string command_text(const telemetry::Command& command) {
  const telemetry::CommandRow& row = telemetry::row_of(command.type);
  std::string text = std::string{row.name} + " ";
  if (row.unit == telemetry::CommandRow::kBitSet && command.argument >= 0.0) {
    return text + bits_text(row.labels, static_cast<std::uint32_t>(command.argument));
  }
  if (!row.labels.empty() && command.argument >= 0.0) {
    return text + "\"" + label(row.labels, static_cast<std::size_t>(command.argument)) + "\"";
  }
  text += formatted("%g", command.argument);
  return row.unit.empty() ? text : text + " " + std::string{row.unit};
}

std::string progress_text(const telemetry::CommandProgress& p, Instant now) {
  std::string text;
  if (p.outcome) {
    text = telemetry::text_of(*p.outcome);
    if (p.decided) text += after(p.issued, *p.decided);
    return text;
  }
  if (p.received) return "received by the car" + after(p.issued, *p.received);
  return (p.sent ? "sent, no answer for " : "not sent for ") +
         formatted("%g", std::round((now - p.issued).milliseconds())) + " ms";
}

std::string event_text(const telemetry::Event& event) {
  const auto content = telemetry::content_of(event);
  if (!content) return "an event that this base does not know";
  return std::visit(EventText{}, *content);
}

}  // namespace pitwall::state
