// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/registry/schema_listing.hpp"

#include <array>

#include "protocol/telemetry/registry/schema.hpp"

namespace pitwall::telemetry {
namespace {

// Up to the next separator, which is taken off too.
std::string_view cut(std::string_view& text, char separator) {
  const std::string_view part = text.substr(0, text.find(separator));
  text.remove_prefix(part.size() < text.size() ? part.size() + 1 : part.size());
  return part;
}

std::vector<std::string> labels_of(std::string_view text) {
  std::vector<std::string> labels;
  while (!text.empty()) labels.emplace_back(cut(text, '|'));
  return labels;
}

bool read_words(std::string_view& line, std::initializer_list<std::string*> words) {
  for (std::string* const word : words) {
    *word = cut(line, ' ');
    if (word->empty()) return false;
  }
  return true;
}

bool read_field(std::string_view line, bool command, std::vector<ListedField>& fields) {
  ListedField f;
  if (!read_words(line, {&f.name, &f.unit, &f.min, &f.max, &f.resolution})) return false;
  if (command && !read_words(line, {&f.time_to_live, &f.needs_authority})) return false;
  f.labels = labels_of(line);
  fields.push_back(std::move(f));
  return true;
}

constexpr std::string_view kGroupWord = "group ", kCommandWord = "command ";
const std::string kCommands = "commands";

bool read_group(std::string_view line, std::vector<ListedGroup>& groups) {
  ListedGroup g;
  if (!read_words(line, {&g.name, &g.direction, &g.priority}) || !line.empty()) return false;
  groups.push_back(std::move(g));
  return true;
}

bool read_line(std::string_view line, Listing& listing) {
  auto& groups = listing.groups;
  if (line.starts_with(kGroupWord)) return read_group(line.substr(kGroupWord.size()), groups);
  if (line.starts_with(kCommandWord)) {
    if (groups.empty() || groups.back().name != kCommands)
      groups.push_back({kCommands, "", "", {}});
    return read_field(line.substr(kCommandWord.size()), true, groups.back().fields);
  }
  return !groups.empty() && read_field(line, false, groups.back().fields);
}

template <class Write>
std::string text_by(Write&& write) {
  std::string text;
  write([&](std::string_view part) { text += part; });
  return text;
}

}  // namespace

Listing read_listing(std::string_view text) {
  Listing listing;
  text = text.substr(0, kListingMax);
  for (std::size_t number = 1; !text.empty(); ++number) {
    if (read_line(cut(text, '\n'), listing)) continue;
    if (listing.bad_lines++ == 0) listing.first_bad_line = number;
  }
  return listing;
}

std::string group_text(Group group) {
  return text_by([&](auto&& sink) { write_group(group, sink); });
}
std::string safety_text() {
  return text_by([](auto&& sink) { write_safety(sink); });
}
std::string schema_text() {
  return text_by([](auto&& sink) { write_schema(sink); });
}

}  // namespace pitwall::telemetry
