// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/ros_view/group_message.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <utility>

#include "protocol/json/json_text.hpp"
#include "protocol/ros/cdr.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::publishers::ros_view {
namespace {

using telemetry::FieldRow;
using telemetry::Group;

// What registry and base table have in common.
struct Row {
  std::string_view name, unit, labels;
  double min, max;
};

bool is_upper_or_digit(char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }
char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

std::string comment_of(const Row& row) {
  if (row.labels == telemetry::kNoYes) return "0 no, 1 yes; NaN: not known";
  if (row.unit == FieldRow::kBitSet) return "a set of bits; NaN: not known";
  if (!row.labels.empty()) return "one of the constants; NaN: not known";
  return (row.unit.empty() ? "" : std::string{row.unit} + ", ") + json::number(row.min) + " to " +
         json::number(row.max) + "; NaN: not known";
}

// A description refers to its constants' names: they stay where they are for good.
class Names {
 public:
  std::string_view keep(std::string text) { return kept_.emplace_back(std::move(text)); }

 private:
  std::deque<std::string> kept_;
};

void add_constants(const Row& row, Names& names, std::vector<ros::Constant>& constants) {
  if (row.labels.empty() || row.labels == telemetry::kNoYes) return;
  const bool bits = row.unit == FieldRow::kBitSet;
  const std::string field = std::string{row.name} + (bits ? " bit" : "");
  std::uint64_t value = bits ? 1 : 0;
  const auto count = static_cast<std::size_t>(std::ranges::count(row.labels, '|')) + 1;
  for (std::size_t i = 0; i < count; ++i) {
    std::string name = constant_name(field, telemetry::label_at(row.labels, i));
    while (std::ranges::find(constants, name, &ros::Constant::name) != constants.end())
      name += "_TOO";
    constants.push_back({bits ? "uint32" : "float64", names.keep(std::move(name)),
                         names.keep(std::to_string(value) + (bits ? "" : ".0"))});
    value = bits ? value << 1U : value + 1;
  }
}

GroupMessage message_of(std::string_view group, std::span<const Row> rows, Names& names) {
  GroupMessage message;
  message.group = group;
  message.name = message_name(group);
  ros::StructDescription& type = message.type.type;
  type.name = std::string{kPackage} + "/msg/" + message.name;
  ros::FieldDescription header{.name = "header", .comment = "stamp: when it was sampled"};
  ros::describe_field<ros::Header>(message.type, header);
  type.fields.push_back(std::move(header));
  for (const Row& row : rows) {
    type.fields.push_back(
        {.name = std::string{row.name}, .type = ros::TypeId::kDouble, .comment = comment_of(row)});
    add_constants(row, names, type.constants);
  }
  return message;
}

void add_of_car(std::vector<GroupMessage>& messages, Names& names) {
  for (const telemetry::GroupRow& group : telemetry::kGroupTable) {
    if (group.direction != telemetry::Direction::kDown) continue;
    const auto [first, count] = telemetry::fields_of(group.group);
    std::vector<Row> rows;
    for (std::size_t i = first; i < first + count; ++i) {
      const FieldRow& f = telemetry::kFields[i];
      rows.push_back({f.name, f.unit, f.labels, f.min, f.max});
    }
    messages.push_back(message_of(group.name, rows, names));
    for (std::size_t i = first; i < first + count; ++i) messages.back().rows.push_back(i);
  }
}

void add_of_base(std::vector<GroupMessage>& messages, Names& names) {
  std::map<std::string_view, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < state::kBaseFields; ++i)
    groups[state::kBaseTable[i].group].push_back(i);
  for (auto& [group, places] : groups) {
    std::vector<Row> rows;
    for (const std::size_t place : places) {
      const state::BaseRow& f = state::kBaseTable[place];
      rows.push_back({f.name, f.unit, f.labels, f.min, f.max});
    }
    messages.push_back(message_of(group, rows, names));
    messages.back().of_base = true;
    messages.back().rows = std::move(places);
  }
}

}  // namespace

std::string message_name(std::string_view group) {
  std::string name;
  bool begins = true;
  for (const char c : group) {
    if (c != '_') name += begins ? upper(c) : c;
    begins = c == '_';
  }
  return name;
}

std::string constant_name(std::string_view field, std::string_view label) {
  std::string name;
  const auto append = [&name](std::string_view text) {
    for (const char c : text) {
      if (is_upper_or_digit(upper(c))) {
        name += upper(c);
      } else if (!name.empty() && name.back() != '_') {
        name += '_';
      }
    }
    if (!name.ends_with('_')) name += '_';
  };
  append(field);
  const std::size_t bare = name.size();
  append(label);
  if (name.size() == bare) name += "NONE_";
  name.pop_back();
  return name;
}

const std::vector<GroupMessage>& group_messages() {
  static Names names;
  static const std::vector<GroupMessage> messages = [] {
    std::vector<GroupMessage> made;
    add_of_car(made, names);
    add_of_base(made, names);
    return made;
  }();
  return messages;
}

std::size_t message_index(Group group) {
  CHECK(telemetry::row_of(group).direction == telemetry::Direction::kDown);
  const auto& messages = group_messages();
  const auto found =
      std::ranges::find(messages, telemetry::row_of(group).name, &GroupMessage::group);
  CHECK(found != messages.end() && !found->of_base);
  return static_cast<std::size_t>(found - messages.begin());
}

void encode_group(const ros::Header& header, std::span<const double> values,
                  std::vector<std::uint8_t>& out) {
  ros::CdrWriter writer{out};
  writer.put(header);
  for (const double value : values) writer.put(value);
}

}  // namespace pitwall::publishers::ros_view
