// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/registry/schema_difference.hpp"

#include <algorithm>
#include <vector>

#include "protocol/telemetry/registry/schema_listing.hpp"
#include "protocol/telemetry/registry/schema_text.hpp"

namespace pitwall::telemetry {
namespace {

class Report {
 public:
  void add(const std::string& place, const std::string& what) {
    if (lines_++ < kDifferencesMax) text_ += place + ": " + what + "\n";
  }
  void add(const std::string& place, const std::string& what, const std::string& here,
           const std::string& there) {
    if (here != there) add(place, what + " " + here + " here, " + there + " there");
  }
  std::size_t lines() const { return lines_; }
  std::string take() {
    if (lines_ > kDifferencesMax)
      text_ += "and " + std::to_string(lines_ - kDifferencesMax) + " more\n";
    return std::move(text_);
  }

 private:
  std::string text_;
  std::size_t lines_ = 0;
};

template <class Row>
const Row* named(const std::vector<Row>& rows, const std::string& name) {
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.name == name; });
  return found == rows.end() ? nullptr : &*found;
}

// Is `longer` what `shorter` becomes by one more label at `at`?
bool one_more(const std::vector<std::string>& shorter, std::vector<std::string> longer,
              std::size_t at) {
  if (longer.size() != shorter.size() + 1) return false;
  longer.erase(longer.begin() + static_cast<std::ptrdiff_t>(at));
  return longer == shorter;
}

void compare_labels(const std::string& place, const std::vector<std::string>& here,
                    const std::vector<std::string>& there, Report& report) {
  if (here == there) return;
  const std::size_t both = std::min(here.size(), there.size());
  std::size_t at = 0;
  while (at < both && here[at] == there[at]) ++at;
  const bool more_there = one_more(here, there, at), more_here = one_more(there, here, at);
  if (!more_there && !more_here) {
    for (std::size_t i = at; i < std::max(here.size(), there.size()); ++i) {
      const std::string mine = i < here.size() ? quoted(here[i]) : "nothing",
                        others = i < there.size() ? quoted(there[i]) : "nothing";
      report.add(place, "value " + std::to_string(i) + " means", mine, others);
    }
    return;
  }
  const std::string label = quoted(more_there ? there[at] : here[at]),
                    where = more_there ? "there" : "here", number = std::to_string(at);
  if (at == both) {
    report.add(place, "value " + number + " is known only " + where + ", as " + label);
  } else {
    report.add(place, label + " is inserted " + where + " as value " + number +
                          ", later values have other numbers");
  }
}

void compare_field(const std::string& place, const ListedField& here, const ListedField& there,
                   Report& report) {
  report.add(place, "unit", here.unit, there.unit);
  report.add(place, "range", here.min + " to " + here.max, there.min + " to " + there.max);
  report.add(place, "resolution", here.resolution, there.resolution);
  report.add(place, "time to live in ms", here.time_to_live, there.time_to_live);
  report.add(place, "needs the authority:", here.needs_authority, there.needs_authority);
  compare_labels(place, here.labels, there.labels, report);
}

// The same field under another name: nobody else has either name, and all but the name agrees.
bool is_renamed(const ListedGroup& here, std::size_t i, const ListedGroup& there) {
  if (i >= here.fields.size() || i >= there.fields.size()) return false;
  ListedField renamed = there.fields[i];
  if (named(here.fields, renamed.name) != nullptr) return false;
  if (named(there.fields, here.fields[i].name) != nullptr) return false;
  renamed.name = here.fields[i].name;
  return renamed == here.fields[i];
}

template <class Row>
std::string order_of(const std::vector<Row>& rows, const std::vector<Row>& others) {
  std::string names;
  for (const Row& row : rows)
    if (named(others, row.name) != nullptr) names += (names.empty() ? "" : " ") + row.name;
  return names;
}

void compare_group(const ListedGroup& here, const ListedGroup& there, Report& report) {
  report.add(here.name, "direction", here.direction, there.direction);
  report.add(here.name, "class", here.priority, there.priority);
  for (std::size_t i = 0; i < here.fields.size(); ++i) {
    const ListedField& field = here.fields[i];
    const std::string place = here.name + "." + field.name;
    if (const ListedField* const other = named(there.fields, field.name)) {
      compare_field(place, field, *other, report);
    } else if (is_renamed(here, i, there)) {
      report.add(place, "is called " + there.fields[i].name + " there");
    } else {
      report.add(place, "is only here");
    }
  }
  for (std::size_t i = 0; i < there.fields.size(); ++i) {
    const ListedField& field = there.fields[i];
    if (named(here.fields, field.name) == nullptr && !is_renamed(here, i, there))
      report.add(here.name + "." + field.name, "is only there");
  }
  report.add(here.name, "order of the fields", order_of(here.fields, there.fields),
             order_of(there.fields, here.fields));
}

}  // namespace

std::string difference(std::string_view here_text, std::string_view there_text) {
  if (here_text == there_text) return {};
  const Listing here = read_listing(here_text), there = read_listing(there_text);
  Report report;
  for (const ListedGroup& group : here.groups) {
    if (const ListedGroup* const other = named(there.groups, group.name)) {
      compare_group(group, *other, report);
    } else {
      report.add(group.name, "this group is only here");
    }
  }
  for (const ListedGroup& group : there.groups)
    if (named(here.groups, group.name) == nullptr)
      report.add(group.name, "this group is only there");
  report.add("groups", "order", order_of(here.groups, there.groups),
             order_of(there.groups, here.groups));
  if (there.bad_lines > 0)
    report.add("text of the other end", std::to_string(there.bad_lines) +
                                            " lines are not understood, the first is line " +
                                            std::to_string(there.first_bad_line));
  if (report.lines() == 0) report.add("text", "differs in a way that has no name");
  return report.take();
}

}  // namespace pitwall::telemetry
