// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/console/catalogue_text.hpp"

#include <cmath>
#include <string_view>

#include "basestation/publishers/console/snapshots.hpp"
#include "basestation/state/derived/attempt.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/telemetry/command/command_table.hpp"
#include "protocol/telemetry/registry/titles.hpp"

namespace pitwall::publishers::console {
namespace {

using json::Array;
using json::Object;
using telemetry::FieldKind;

constexpr unsigned kSetValues = 64;  // bit k is the value k

std::string labels_text(std::string_view labels) {
  Array list;
  for (std::size_t i = 0; !telemetry::label_at(labels, i).empty(); ++i) {
    list.json(json::quoted(telemetry::label_at(labels, i)));
  }
  return list.str();
}

std::string limits_text(const alarms::Limit& limit) {
  Object object;
  const auto add = [&](std::string_view name, double value) {
    if (!std::isnan(value)) object.number(name, value);
  };
  add("warning_low", limit.warning_low);
  add("warning_high", limit.warning_high);
  add("bad_low", limit.bad_low);
  add("bad_high", limit.bad_high);
  const auto add_set = [&](std::string_view name, std::uint64_t set) {
    Array values;
    for (unsigned value = 0; value < kSetValues; ++value) {
      if ((set >> value & 1U) != 0) values.json(json::integer(value));
    }
    if (set != 0) object.json(name, values.str());
  };
  add_set("warning_values", limit.warning_values);
  add_set("bad_values", limit.bad_values);
  return limit.any() ? object.str() : "null";
}

std::string_view text_of(FieldKind kind) {
  switch (kind) {
    case FieldKind::kReal:
      return "real";
    case FieldKind::kInteger:
      return "integer";
    case FieldKind::kYesNo:
      return "yes-no";
  }
  return "?";
}

// What a row of either table has.
struct Row {
  std::string_view group, name, unit, labels;
  FieldKind kind;
  double min, max, resolution;
  Duration period;
};

Row row_of_field(state::FieldId id) {
  if (state::is_base(id)) {
    const state::BaseRow& row = state::row_of(state::base_field(id));
    // Kinds are told as those of the registry.
    const telemetry::FieldRow like{telemetry::Group::kMode, row.name,  row.unit, row.min, row.max,
                                   row.resolution,          row.labels};
    return {row.group, row.name, row.unit,       row.labels,        like.kind(),
            row.min,   row.max,  row.resolution, state::kBasePeriod};
  }
  const telemetry::FieldRow& row = telemetry::kFields[id];
  return {telemetry::row_of(row.group).name,
          row.name,
          row.unit,
          row.labels,
          row.kind(),
          row.min,
          row.max,
          row.resolution,
          row.target_age()};
}

std::string field_text(state::FieldId id, const alarms::Limit& limit) {
  const Row row = row_of_field(id);
  return Object{}
      .number("id", id)
      .text("path", state::path_of(id))
      .text("group", row.group)
      .text("name", row.name)
      .text("title", telemetry::title_of(row.group, row.name))
      .text("unit", row.unit)
      .text("kind", text_of(row.kind))
      .number("min", row.min)
      .number("max", row.max)
      .number("resolution", row.resolution)
      .json("labels", labels_text(row.labels))
      .number("period_ms", row.period.milliseconds())
      .json("limits", limits_text(limit))
      .str();
}

std::string command_text(const telemetry::CommandRow& row) {
  return Object{}
      .text("name", row.name)
      .text("unit", row.unit)
      .number("min", row.min)
      .number("max", row.max)
      .number("resolution", row.resolution)
      .json("labels", labels_text(row.labels))
      .number("time_to_live_ms", row.time_to_live.milliseconds())
      .flag("needs_authority", row.needs_authority)
      .flag("offered", row.offered)
      .str();
}

}  // namespace

std::string catalogue_text(const LimitOf& limit_of, double attempt_laps) {
  Array fields, commands;
  for (const state::FieldId id : reported_fields()) fields.json(field_text(id, limit_of(id)));
  for (const telemetry::CommandRow& row : telemetry::kCommandTable)
    commands.json(command_text(row));
  return Object{}
      .text("type", "catalogue")
      .json("fields", fields.str())
      .json("commands", commands.str())
      .json("race", Object{}
                        .number("attempt_laps", attempt_laps)
                        .number("pass_gap_m", state::kPassGap_m)
                        .str())
      .str();
}

}  // namespace pitwall::publishers::console
