// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/parser/dbc_draft.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "protocol/can/parser/dbc_remarks.hpp"
#include "protocol/can/parser/dbc_resolution.hpp"

namespace pitwall::can {
namespace {

constexpr double kMaxPeriod_ms = 24.0 * 3600.0 * 1000.0;

// Those of Vector's own definition of VFrameFormat, for files that use it without defining it.
bool is_fd_format(std::string_view format) {
  return format == "14" || format == "15" || format.ends_with("_FD");
}

// Line and column of "file:line:column".
std::pair<std::uint64_t, std::uint64_t> position(const std::string& place) {
  const std::size_t last = place.rfind(':');
  const std::size_t first = last == std::string::npos ? last : place.rfind(':', last - 1);
  if (first == std::string::npos) return {};
  std::uint64_t line = 0, column = 0;
  std::from_chars(place.data() + first + 1, place.data() + last, line);
  std::from_chars(place.data() + last + 1, place.data() + place.size(), column);
  return {line, column};
}

// What becomes of a message and all of its signals.
std::string left_out(const Message& m) {
  return "the message is left out with its " + std::to_string(m.signals.size()) + " signals";
}

}  // namespace

void refuse_at(const std::string& place, const std::string& what) {
  throw DbcScanner::Stop{{place, what}};
}

void DbcDraft::add(std::uint32_t key, Message m, std::vector<Mark> its_marks) {
  const bool is_new_key = by_key_.insert({key, database.messages.size()}).second;
  const auto [same, is_new_id] = ids_.insert({{m.extended, m.id}, database.messages.size()});
  if (!is_new_id) {
    if (is_new_key) {  // the same id, written without the mark of 29 bits
      by_key_.erase(key);
      leave_out(key);
    }
    const std::string& other = database.messages[same->second].name;
    return find({FindingKind::kMessage, m.place,
                 "message " + m.name + " has the id of message " + other, left_out(m), m.name});
  }
  database.messages.push_back(std::move(m));
  marks.push_back(std::move(its_marks));
}

void DbcDraft::index() {
  for (const Message& m : database.messages) {
    std::vector<std::uint32_t>& sorted = by_name_.emplace_back(m.signals.size());
    for (std::uint32_t i = 0; i < sorted.size(); ++i) sorted[i] = i;
    std::stable_sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
      return m.signals[a].name < m.signals[b].name;
    });
  }
  for (std::size_t i = 0; i < database.nodes.size(); ++i) {
    nodes_.insert({database.nodes[i].name, i});
  }
}

std::optional<std::size_t> DbcDraft::message(std::uint32_t key) const {
  const auto at = by_key_.find(key);
  return at == by_key_.end() ? std::nullopt : std::optional{at->second};
}

std::optional<std::size_t> DbcDraft::signal(std::size_t of, std::string_view name) const {
  const auto& signals = database.messages[of].signals;
  const auto& sorted = by_name_[of];
  const auto at = std::lower_bound(
      sorted.begin(), sorted.end(), name,
      [&](std::uint32_t i, std::string_view wanted) { return signals[i].name < wanted; });
  return at != sorted.end() && signals[*at].name == name ? std::optional<std::size_t>{*at}
                                                         : std::nullopt;
}

std::optional<DbcDraft::Found> DbcDraft::signal(std::uint32_t key, std::string_view name) const {
  const auto m = message(key);
  const auto s = m ? signal(*m, name) : std::nullopt;
  return s ? std::optional{Found{*m, *s}} : std::nullopt;
}

std::optional<std::size_t> DbcDraft::node(std::string_view name) const {
  const auto at = nodes_.find(name);
  return at == nodes_.end() ? std::nullopt : std::optional{at->second};
}

const ValueTable* DbcDraft::table(std::string_view name) const {
  const auto at = tables_.find(name);
  return at == tables_.end() ? nullptr : &database.tables[at->second];
}

std::vector<AttributeDefinition*> DbcDraft::definitions(std::string_view name) {
  std::vector<AttributeDefinition*> out;
  const auto at = definitions_.find(name);
  if (at == definitions_.end()) return out;
  for (const std::size_t i : at->second) out.push_back(&database.definitions[i]);
  return out;
}

const AttributeDefinition* DbcDraft::definition(AttributeOwner owner, std::string_view name) {
  for (const AttributeDefinition* const d : definitions(name)) {
    if (d->owner == owner) return d;
  }
  return nullptr;
}

bool DbcDraft::add(ValueTable t) {
  const auto [at, is_new] = tables_.insert({t.name, database.tables.size()});
  if (is_new) {
    database.tables.push_back(std::move(t));
  } else {
    database.tables[at->second] = std::move(t);
  }
  return is_new;
}

bool DbcDraft::add(AttributeDefinition d) {
  for (AttributeDefinition* const known : definitions(d.name)) {
    if (known->owner != d.owner) continue;
    *known = std::move(d);
    return false;
  }
  definitions_[d.name].push_back(database.definitions.size());
  database.definitions.push_back(std::move(d));
  return true;
}

void DbcDraft::find(Finding finding) {
  if (found_[static_cast<std::size_t>(finding.kind)]++ < kMaxFindings) {
    database.findings.push_back(std::move(finding));
  } else {
    ++database.findings_left_off[static_cast<std::size_t>(severity_of(finding.kind))];
  }
}

void DbcDraft::flaw(Message& m, Finding finding) {
  if (found_[static_cast<std::size_t>(finding.kind)] < kMaxFindings) {
    m.flaws.push_back({finding.place, text_of(finding)});
  }
  find(std::move(finding));
}

void DbcDraft::set_long_name(std::uint32_t key, std::string name) {
  if (const auto m = message(key)) long_names_.push_back({*m, std::nullopt, std::move(name)});
}

void DbcDraft::set_long_name(Found found, std::string name) {
  long_names_.push_back({found.message, found.signal, std::move(name)});
}

// Names longer than 32 characters are given apart; everything else refers to the short ones.
void DbcDraft::lengthen_names() {
  for (LongName& l : long_names_) {
    Message& m = database.messages[l.message];
    (l.signal ? m.signals[*l.signal].name : m.name) = std::move(l.name);
  }
}

void DbcDraft::mark_equal_names() {
  std::map<std::string_view, std::string_view> seen;
  for (Message& m : database.messages) {
    const auto [at, is_new] = seen.insert({m.name, m.place});
    if (is_new) continue;
    flaw(m, {FindingKind::kMessage, m.place,
             "message " + m.name + " is already defined at " + std::string{at->second},
             "both are kept", m.name});
  }
}

void DbcDraft::apply_attributes(Message& m, std::optional<std::string_view> usual_format,
                                std::optional<std::string_view> usual_period) {
  std::optional<std::string_view> format = usual_format, period = usual_period;
  for (const Attribute& a : m.attributes) {
    if (a.name == "VFrameFormat") format = a.value;
    if (a.name == "GenMsgCycleTime") period = a.value;
  }
  m.fd = m.fd || (format && is_fd_format(*format));
  if (!period) return;
  double period_ms = 0.0;
  const char* const end = period->data() + period->size();
  const auto [stop, error] = std::from_chars(period->data(), end, period_ms);
  if (error == std::errc{} && stop == end && period_ms >= 0.0 && period_ms <= kMaxPeriod_ms) {
    m.period = from_seconds(period_ms * 1e-3);
  } else {
    find({FindingKind::kAttribute, m.place,
          "message " + m.name + ": the GenMsgCycleTime \"" + std::string{*period} +
              "\" is no time in milliseconds",
          "", m.name + ".GenMsgCycleTime"});
  }
}

void DbcDraft::add_remarks(const Message& m) {
  for (Finding& f : remarks_on(m)) find(std::move(f));
  for (const Signal& s : m.signals) {
    for (Finding& f : remarks_on(m, s)) find(std::move(f));
  }
}

Database DbcDraft::finish() {
  lengthen_names();
  mark_equal_names();
  for (std::size_t i = 0; i < database.messages.size(); ++i) {
    for (Finding& f : resolve(database.messages[i], marks[i])) {
      flaw(database.messages[i], std::move(f));
    }
  }
  using enum AttributeOwner;
  const auto usual_format = database.attribute("VFrameFormat", kMessage, {});
  const auto usual_period = database.attribute("GenMsgCycleTime", kMessage, {});
  for (Message& m : database.messages) {
    apply_attributes(m, usual_format, usual_period);
    add_remarks(m);
  }
  for (Finding& f : unlisted_nodes(database)) find(std::move(f));
  std::stable_sort(
      database.findings.begin(), database.findings.end(),
      [](const Finding& a, const Finding& b) { return position(a.place) < position(b.place); });
  auto& all = database.messages;
  std::sort(all.begin(), all.end(), [](const Message& a, const Message& b) {
    return std::pair{a.extended, a.id} < std::pair{b.extended, b.id};
  });
  return std::move(database);
}

}  // namespace pitwall::can
