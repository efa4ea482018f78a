// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/export/catalogue.hpp"

#include <array>
#include <cstdint>
#include <string_view>

#include "protocol/telemetry/registry/schema.hpp"
#include "protocol/telemetry/registry/schema_text.hpp"
#include "protocol/telemetry/registry/titles.hpp"

namespace pitwall::telemetry {
namespace {

// Names, units and labels of the registry hold no character that JSON would have escaped.
constexpr bool plain(std::string_view text) {
  for (const char c : text)
    if (c < ' ' || c > '~' || c == '"' || c == '\\') return false;
  return true;
}
static_assert([] {
  for (const FieldRow& row : kFields)
    if (!plain(row.name) || !plain(row.unit) || !plain(row.labels)) return false;
  for (const CommandRow& row : kCommandTable)
    if (!plain(row.name) || !plain(row.unit) || !plain(row.labels)) return false;
  return true;
}());

std::string hex64(std::uint64_t value) {
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4)
    text += "0123456789abcdef"[value >> static_cast<unsigned>(shift) & 15U];
  return quoted(text);
}

std::string pair(std::string_view key, std::string_view value) {
  return quoted(key) + ": " + std::string{value};
}
std::string pair(std::string_view key, double value) { return pair(key, Decimal{value}.text()); }

std::string labels_json(std::string_view labels) {
  std::string text = "[";
  for (std::size_t i = 0; !label_at(labels, i).empty(); ++i)
    text += (i == 0 ? "" : ", ") + quoted(label_at(labels, i));
  return text + "]";
}

template <class Row>
std::string range_json(const Row& row) {
  std::string text = pair("unit", quoted(row.unit)) + ", " + pair("min", row.min) + ", " +
                     pair("max", row.max) + ", " + pair("resolution", row.resolution) + ", " +
                     pair("bits", row.quantized().bits());
  if (!row.labels.empty()) text += ", " + pair("labels", labels_json(row.labels));
  return text;
}

std::string_view text_of(FieldKind kind) {
  constexpr std::array<std::string_view, 3> kTexts{"real", "integer", "yes-no"};
  return kTexts[static_cast<std::size_t>(kind)];
}

std::string field_json(const FieldRow& row) {
  return "      {" + pair("name", quoted(row.name)) + ", " +
         pair("path", quoted(std::string{row_of(row.group).name} + "." + std::string{row.name})) +
         ", " + pair("title", quoted(title_of(row_of(row.group).name, row.name))) + ", " +
         pair("kind", quoted(text_of(row.kind()))) + ", " + range_json(row) + "}";
}

std::string group_json(const GroupRow& row) {
  std::string text = "    {" + pair("name", quoted(row.name)) + ", " +
                     pair("direction", quoted(text_of(row.direction))) + ", " +
                     pair("class", quoted(text_of(row.priority))) + ", " +
                     pair("target_age_ms", row.target_age.milliseconds()) + ", " +
                     pair("weight", row.weight) + ", " +
                     pair("bits", static_cast<double>(group_bits(row.group))) + ", " +
                     pair("hash", hex64(group_hash(row.group))) + ", " + quoted("fields") + ": [\n";
  const auto [first, count] = fields_of(row.group);
  for (FieldIndex i = first; i < first + count; ++i)
    text += field_json(kFields[i]) + (i + 1 < first + count ? ",\n" : "\n");
  return text + "    ]}";
}

std::string command_json(const CommandRow& row) {
  return "    {" + pair("name", quoted(row.name)) + ", " + range_json(row) + ", " +
         pair("time_to_live_ms", row.time_to_live.milliseconds()) + ", " +
         pair("needs_authority", row.needs_authority ? "true" : "false") + ", " +
         pair("offered", row.offered ? "true" : "false") + "}";
}

template <class Table, class Json>
std::string list_json(const Table& table, Json&& json) {
  std::string text = "[\n";
  for (std::size_t i = 0; i < table.size(); ++i)
    text += json(table[i]) + (i + 1 < table.size() ? ",\n" : "\n");
  return text + "  ]";
}

}  // namespace

std::string catalogue_json() {
  return "{\n  " + pair("schema", hex64(kSchemaHash)) + ",\n  " +
         pair("safety", hex64(kSafetyHash)) + ",\n  " +
         pair("groups", list_json(kGroupTable, group_json)) + ",\n  " +
         pair("commands", list_json(kCommandTable, command_json)) + "\n}\n";
}

}  // namespace pitwall::telemetry
