// SPDX-License-Identifier: Apache-2.0
#include "basestation/alarms/engine.hpp"

#include <algorithm>

namespace pitwall::alarms {
namespace {

Problem no(AlarmId id, const char* what) { return {"alarm " + std::to_string(id), what}; }

}  // namespace

Engine::Engine(AlarmSettings settings)
    : settings_(std::move(settings)), entries_(alarm_count()), overruled_by_(alarm_count()) {
  for (AlarmIndex i = 0; i < alarm_count(); ++i) {
    overruled_by_[i] = find_alarm(alarm_row(i).overruled_by);
  }
  activated_.reserve(alarm_count());
}

Engine::Part Engine::part_of(State state) {
  switch (state) {
    case State::kNormal:
      return Part::kNone;
    case State::kShelved:
      return Part::kShelved;
    case State::kSuppressed:
      return Part::kSuppressed;
    default:
      return Part::kActive;
  }
}

bool Engine::overruled(AlarmIndex index) const {
  if (!overruled_by_[index]) return false;
  const State other = entries_[*overruled_by_[index]].alarm.state();
  return other == State::kUnack || other == State::kAcked;
}

void Engine::step(const std::vector<Reading>& readings, Situations situations, Instant now) {
  CHECK(readings.size() == entries_.size());
  const bool was_empty = count() == 0;
  activated_.clear();
  for (AlarmIndex i = 0; i < entries_.size(); ++i) {
    const AlarmRow& row = alarm_row(i);
    Entry& entry = entries_[i];
    const State before = entry.alarm.state();
    const std::uint32_t count_before = entry.alarm.count();
    const bool silent = row.silent_in.overlaps(situations) || overruled(i);
    const bool activated = entry.alarm.update(row, settings_.of(i), readings[i], silent, now);
    const State after = entry.alarm.state();
    if (activated && after != State::kShelved) {
      entry.id = ++ids_;
      entry.by.clear();
      entry.reason.clear();
      rate_.add(now);
      activated_.push_back(i);
    }
    if (after == State::kNormal) entry.first_up = false;
    if (activated || after != before) note(i, before, now, "", "");
    if (entry.alarm.count() != count_before) ++revision_;
  }
  if (was_empty) mark_first();
  if (rate_.advance(now)) ++revision_;
}

// Of those that began the episode: the most urgent, then the first of the table.
void Engine::mark_first() {
  const auto first =
      std::min_element(activated_.begin(), activated_.end(), [&](AlarmIndex a, AlarmIndex b) {
        return settings_.of(a).priority > settings_.of(b).priority;
      });
  if (first != activated_.end()) entries_[*first].first_up = true;
}

void Engine::note(AlarmIndex index, State from, Instant now, std::string_view by,
                  std::string_view reason) {
  const Entry& entry = entries_[index];
  history_.push_back({.number = ++events_,
                      .at = now,
                      .id = entry.id,
                      .key = alarm_row(index).key,
                      .from = from,
                      .to = entry.alarm.state(),
                      .by = std::string{by},
                      .reason = std::string{reason}});
  if (history_.size() > kHistory) history_.pop_front();
  ++revision_;
}

Result<AlarmIndex, Problem> Engine::find(AlarmId id) const {
  for (AlarmIndex i = 0; i < entries_.size(); ++i) {
    if (entries_[i].id == id && entries_[i].alarm.state() != State::kNormal) return i;
  }
  return Unexpected{no(id, "is not in the list any more, or has come anew")};
}

template <class Act>
Result<bool, Problem> Engine::act(AlarmId id, const Origin& origin, Instant now, const Act& act) {
  const auto index = find(id);
  if (!index) return Unexpected{index.error()};
  if (origin.by.empty()) return Unexpected{no(id, "who acts has a name")};
  Entry& entry = entries_[*index];
  const State before = entry.alarm.state();
  if (!act(entry.alarm)) {
    return Unexpected{Problem{"alarm " + std::to_string(id),
                              "is " + std::string{text_of(before)} + ", which does not allow it"}};
  }
  entry.by = origin.by;
  entry.reason = origin.reason;
  note(*index, before, now, origin.by, origin.reason);
  if (entry.alarm.state() == State::kNormal) entry.first_up = false;
  return true;
}

Result<bool, Problem> Engine::acknowledge(AlarmId id, std::string_view by, Instant now) {
  return act(id, {by, ""}, now, [](Alarm& alarm) { return alarm.acknowledge(); });
}

Result<bool, Problem> Engine::shelve(AlarmId id, Duration length, std::string_view by,
                                     std::string_view reason, Instant now) {
  if (!(length > Duration{} && length <= kShelveMax)) {
    return Unexpected{no(id, "is shelved for 10 minutes at most")};
  }
  if (reason.empty()) return Unexpected{no(id, "is shelved for a reason")};
  if (const auto index = find(id); index && alarm_row(*index).always_shown)
    return Unexpected{no(id, "is of a stop: it is never shelved")};
  return act(id, {by, reason}, now, [&](Alarm& alarm) { return alarm.shelve(now + length); });
}

Result<bool, Problem> Engine::unshelve(AlarmId id, std::string_view by, Instant now) {
  return act(id, {by, ""}, now, [](Alarm& alarm) { return alarm.unshelve(); });
}

Result<bool, Problem> Engine::reset(AlarmId id, std::string_view by, Instant now) {
  return act(id, {by, ""}, now, [](Alarm& alarm) { return alarm.reset(); });
}

Result<bool, Problem> Engine::edit(const AlarmEdit& edit) {
  auto edited = settings_.edit(edit);
  if (edited) ++revision_;
  return edited;
}

ListedAlarm Engine::line(AlarmIndex index) const {
  const Entry& entry = entries_[index];
  const AlarmRow& row = alarm_row(index);
  const Priority priority = settings_.of(index).priority;
  return {.id = entry.id,
          .index = index,
          .key = row.key,
          .text = row.text,
          .response = row.response,
          .priority = priority,
          .state = entry.alarm.state(),
          .since = entry.alarm.since(),
          .value = entry.alarm.value(),
          .count = entry.alarm.count(),
          .first_up = entry.first_up,
          .folded = entry.alarm.folded(),
          .flooded = rate_.flood() && priority != Priority::kHigh && !entry.first_up,
          .shelved_until = entry.alarm.shelved_until(),
          .by = entry.by,
          .reason = entry.reason};
}

std::vector<ListedAlarm> Engine::list(Part part) const {
  std::vector<ListedAlarm> lines;
  for (AlarmIndex i = 0; i < entries_.size(); ++i) {
    if (part_of(entries_[i].alarm.state()) == part) lines.push_back(line(i));
  }
  std::sort(lines.begin(), lines.end(), [](const ListedAlarm& a, const ListedAlarm& b) {
    return a.priority != b.priority ? a.priority > b.priority : a.id < b.id;
  });
  return lines;
}

std::vector<ListedAlarm> Engine::active() const { return list(Part::kActive); }
std::vector<ListedAlarm> Engine::shelved() const { return list(Part::kShelved); }
std::vector<ListedAlarm> Engine::suppressed() const { return list(Part::kSuppressed); }

std::size_t Engine::count() const {
  return static_cast<std::size_t>(std::count_if(
      entries_.begin(), entries_.end(),
      [](const Entry& entry) { return part_of(entry.alarm.state()) == Part::kActive; }));
}

std::size_t Engine::count(Priority priority) const {
  std::size_t count = 0;
  for (AlarmIndex i = 0; i < entries_.size(); ++i) {
    const bool listed = part_of(entries_[i].alarm.state()) == Part::kActive;
    count += listed && settings_.of(i).priority == priority ? 1U : 0U;
  }
  return count;
}

std::size_t Engine::unacknowledged(Priority priority) const {
  std::size_t count = 0;
  for (AlarmIndex i = 0; i < entries_.size(); ++i) {
    const Alarm& alarm = entries_[i].alarm;
    const bool listed = part_of(alarm.state()) == Part::kActive;
    count += listed && alarm.unacknowledged() && settings_.of(i).priority == priority ? 1U : 0U;
  }
  return count;
}

}  // namespace pitwall::alarms
