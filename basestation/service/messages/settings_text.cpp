// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/messages/settings_text.hpp"

#include <cmath>

#include "protocol/json/json_text.hpp"

namespace pitwall::service {
namespace {

using json::Array;
using json::Object;

// Who changed it last; null where it is as it came.
std::string author_of(const alarms::AlarmSettings& alarms, std::string_view key) {
  for (auto edit = alarms.edits().rbegin(); edit != alarms.edits().rend(); ++edit) {
    if (edit->key == key) return json::quoted(edit->author);
  }
  return "null";
}

std::string unit_of(state::FieldId id) {
  return std::string{state::is_base(id) ? state::row_of(state::base_field(id)).unit
                                        : telemetry::kFields[id].unit};
}

std::string alarm_text(const alarms::AlarmSettings& alarms, alarms::AlarmIndex index) {
  const alarms::AlarmRow& row = alarms::alarm_row(index);
  const alarms::AlarmSetting& set = alarms.of(index);
  return Object{}
      .text("key", row.key)
      .text("text", row.text)
      .text("path", state::path_of(row.field))
      .text("unit", unit_of(row.field))
      .text("side", row.side == alarms::Side::kAbove ? "above" : "below")
      .text("priority", alarms::text_of(set.priority))
      .number("limit", set.limit)
      .number("deadband", set.deadband)
      .number("on_s", set.on_delay.seconds())
      .number("off_s", set.off_delay.seconds())
      .json("by", author_of(alarms, row.key))
      .str();
}

}  // namespace

std::string settings_text(const command::SettingsEditor& editor,
                          const alarms::AlarmSettings& alarms,
                          const std::optional<Problem>& unreadable) {
  Array list;
  for (alarms::AlarmIndex i = 0; i < alarms::alarm_count(); ++i) list.json(alarm_text(alarms, i));
  return Object{}
      .text("type", "settings")
      .number("revision", editor.revision())
      .flag("kept", editor.kept())
      .text("problem", unreadable ? unreadable_text(*unreadable) : "")
      .number("up_kbit_s", editor.budget().now)
      .number("up_least_kbit_s", editor.budget().least)
      .number("up_most_kbit_s", editor.budget().most)
      .json("alarms", list.str())
      .str();
}

std::string expected_text(const command::OperatorEntries& entries, double fuel_left_l,
                          Instant now) {
  const bool loaded = !std::isnan(entries.expected.fuel_loaded_l);
  return Object{}
      .text("type", "expected")
      .number("round_speed_mps", entries.expected.round_speed_mps)
      .text("round_speed_by", entries.round_speed_by)
      .number("fuel_loaded_l", entries.expected.fuel_loaded_l)
      .text("fuel_by", entries.fuel_by)
      .number("fuel_ms", loaded ? entries.fuel_at.milliseconds() : kUnset)
      .number("fuel_left_l", loaded ? fuel_left_l : kUnset)
      .number("track_flag", entries.expected.track_flag)
      .number("time_ms", now.milliseconds())
      .str();
}

std::string unreadable_text(const Problem& problem) {
  return "settings file unreadable: " + to_string(problem) + "; built-in limits in force";
}

}  // namespace pitwall::service
