// Parser of the canonical text of a registry (schema_text.hpp), which the other end sends.
//   in     any text; at most its first kListingMax bytes are read
//   out    groups with their fields, and commands as the group named "commands"
//   errors an invalid line is counted, with the number of the first one; the other lines are kept
//   cost   allocates; not for the 100 Hz path
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/telemetry/registry/registry.hpp"

namespace pitwall::telemetry {

inline constexpr std::size_t kListingMax = 64 * 1'024;

struct ListedField {
  std::string name, unit, min, max, resolution;
  std::string time_to_live, needs_authority;  // for commands only
  std::vector<std::string> labels;

  bool operator==(const ListedField&) const = default;
};

struct ListedGroup {
  std::string name, direction, priority;
  std::vector<ListedField> fields;

  bool operator==(const ListedGroup&) const = default;
};

struct Listing {
  std::vector<ListedGroup> groups;
  std::size_t bad_lines = 0, first_bad_line = 0;
};

Listing read_listing(std::string_view text);

std::string group_text(Group group);
std::string safety_text();  // the safety groups of both directions and the commands
std::string schema_text();  // everything

}  // namespace pitwall::telemetry
