// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/dbc/dbc_findings.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "protocol/json/json_text.hpp"

namespace pitwall::cli {
namespace {

using can::Finding;
using can::FindingSeverity;

constexpr std::size_t kMostLines = 10;    // of one kind, before they become one line
constexpr std::size_t kMostSubjects = 5;  // that this line names

std::string line_of(const Finding& f) {
  return f.place + ": " + can::name_of(can::severity_of(f.kind)) + ": " + can::text_of(f) + "\n";
}

// A kind as one line.
std::string group_line(const std::string& file, std::span<const Finding* const> group) {
  const can::FindingKind kind = group.front()->kind;
  std::string out = file + ": " + can::name_of(can::severity_of(kind)) + ": " +
                    std::to_string(group.size()) + " " + can::plural_of(kind) + ": ";
  for (std::size_t i = 0; i < kMostSubjects; ++i) {
    const Finding& f = *group[i];
    out += (i == 0 ? "" : ", ") + (f.subject.empty() ? f.place : f.subject);
  }
  if (group.size() > kMostSubjects) {
    out += " and " + std::to_string(group.size() - kMostSubjects) + " more";
  }
  return out + " (--all lists them)\n";
}

std::string left_off_line(const can::Database& d, FindingSeverity severity) {
  const std::size_t count = d.findings_left_off[static_cast<std::size_t>(severity)];
  if (count == 0) return "";
  return d.name + ": " + can::name_of(severity) + ": " + std::to_string(count) +
         " more that are not listed\n";
}

}  // namespace

std::string findings_text(const can::Database& d, bool lists_all) {
  const std::vector<const Finding*> all = can::worst_first(d);
  std::string out;
  for (std::size_t i = 0; i < all.size();) {
    const auto end = std::find_if(all.begin() + static_cast<std::ptrdiff_t>(i), all.end(),
                                  [&](const Finding* f) { return f->kind != all[i]->kind; });
    const auto group = std::span{all}.subspan(i, static_cast<std::size_t>(end - all.begin()) - i);
    const bool is_error = can::severity_of(all[i]->kind) == FindingSeverity::kError;
    if (is_error || lists_all || group.size() <= kMostLines) {
      for (const Finding* const f : group) out += line_of(*f);
    } else {
      out += group_line(d.name, group);
    }
    i += group.size();
  }
  for (std::size_t s = 0; s < can::kFindingSeverities; ++s) {
    out += left_off_line(d, static_cast<FindingSeverity>(s));
  }
  return out;
}

std::string errors_text(const can::Database& d) {
  std::string out;
  for (const Finding* const f : can::worst_first(d)) {
    if (can::severity_of(f->kind) == FindingSeverity::kError) out += line_of(*f);
  }
  return out + left_off_line(d, FindingSeverity::kError);
}

std::string findings_json(const can::Database& d) {
  json::Array out;
  for (const Finding* const f : can::worst_first(d)) {
    out.json(json::Object{}
                 .text("severity", can::name_of(can::severity_of(f->kind)))
                 .text("place", f->place)
                 .text("what", f->what)
                 .text("outcome", f->outcome)
                 .text("subject", f->subject)
                 .str());
  }
  return out.str();
}

}  // namespace pitwall::cli
