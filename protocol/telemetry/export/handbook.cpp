// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/export/handbook.hpp"

#include <string_view>

#include "protocol/telemetry/command/command_table.hpp"
#include "protocol/telemetry/packet/vehicle_state.hpp"
#include "protocol/telemetry/registry/schema_text.hpp"

namespace pitwall::telemetry {
namespace {

std::string decimal(double value) { return std::string{Decimal{value}.text()}; }

std::string unit_of(std::string_view unit) { return unit.empty() ? "-" : std::string{unit}; }

std::string labels_of(std::string_view labels) {
  std::string text;
  for (std::size_t i = 0; !label_at(labels, i).empty(); ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(i) + " " + std::string{label_at(labels, i)};
  return text;
}

template <class Row>
std::string cells(const Row& row) {
  return std::string{row.name} + " | " + unit_of(row.unit) + " | " + decimal(row.min) + " to " +
         decimal(row.max) + " | " + decimal(row.resolution) + " | " +
         std::to_string(row.quantized().bits()) + " | ";
}

std::string introduction() {
  const auto bytes = [](GroupSet set) { return std::to_string(bytes_of(set)); };
  return "# What goes over the radio as state\n\n"
         "Made from the registry by `pitwall-base export markdown`. A code k of a field stands for "
         "min + k * resolution, all ones for \"unset\". A group is sent whole or not at all.\n\n"
         "- " +
         std::to_string(kFieldCount) + " fields in " + std::to_string(kGroups) +
         " groups; all that the car tells is " + bytes(groups_of(Direction::kDown)) +
         " bytes\n- in every packet: " + bytes(groups_of(Direction::kDown, Class::kSafety)) +
         " bytes of the car, " + bytes(groups_of(Direction::kUp, Class::kSafety)) +
         " of the base\n- the vehicle state of " + std::to_string(kVehicleStateSize) +
         " signals is " + bytes(kVehicleStateSet) + " bytes, " +
         std::to_string(kVehicleStateDatagram) + " as an authentic datagram\n";
}

std::string group_section(const GroupRow& row) {
  std::string text = "\n## " + std::string{row.name} + "\n\n" +
                     (row.direction == Direction::kDown ? "From the car" : "From the base") +
                     ", class " + std::string{text_of(row.priority)} + ", target age " +
                     decimal(row.target_age.milliseconds()) + " ms, " +
                     std::to_string(group_bits(row.group)) + " bits.\n\n" +
                     "| field | unit | range | resolution | bits | values |\n"
                     "|---|---|---|---|---|---|\n";
  const auto [first, count] = fields_of(row.group);
  for (FieldIndex i = first; i < first + count; ++i)
    text += "| " + cells(kFields[i]) + labels_of(kFields[i].labels) + " |\n";
  return text;
}

std::string command_section() {
  std::string text =
      "\n## Commands\n\n"
      "| command | unit | range | resolution | bits | time to live | needs authority | values |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const CommandRow& row : kCommandTable)
    text += "| " + cells(row) + decimal(row.time_to_live.milliseconds()) + " ms | " +
            (row.needs_authority ? "yes" : "no") + " | " + labels_of(row.labels) + " |\n";
  return text;
}

}  // namespace

std::string handbook_markdown() {
  std::string text = introduction();
  for (const GroupRow& row : kGroupTable) text += group_section(row);
  return text + command_section();
}

}  // namespace pitwall::telemetry
