// Alarm list: state of every alarm of the table, updated together.
//   in     readings of the fields, the situation of the car, actions of operators, time; the caller
//          steps it at whole multiples of the grid (evaluator.hpp), so that the rate of polling has
//          no effect
//   out    the list, its history, and its alarm rate against the rate that operators can handle
//   invariants
//          the same inputs in the same order give the same list and history
//          no action and no order of events loses an unacknowledged alarm: it stays in the list,
//          shelved or suppressed, until an operator acknowledges this very occurrence
//          a lost link raises exactly one alarm, and suppresses every alarm on values of the car
//          except those of a stop; a stop is never shelved
//          flood: from more than 10 new alarms in 10 min until 5 or fewer. During a flood the list
//          shows the first alarm of each episode and the high ones. An episode lasts while any
//          alarm is in the list
//   ids    one per occurrence. An action with the id of an earlier occurrence is refused, because
//          the operator meant that one
//   errors actions: Problem with the id as place
//   cost   no allocation in step() while nothing changes
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "basestation/alarms/alarm.hpp"
#include "basestation/alarms/alarm_table.hpp"
#include "basestation/alarms/rate.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::alarms {

using AlarmId = std::uint32_t;  // of an occurrence, from 1

// A line of the list, ready to be shown.
struct ListedAlarm {
  AlarmId id = 0;
  AlarmIndex index = 0;
  std::string_view key, text, response;
  Priority priority = Priority::kLow;
  State state = State::kNormal;
  Instant since{};
  double value = kUnset;
  std::uint32_t count = 0;
  bool first_up = false, folded = false;
  bool flooded = false;  // not shown while the list is flooded
  std::optional<Instant> shelved_until;
  std::string by, reason;  // of the newest action on it
};

struct AlarmEvent {
  std::uint64_t number = 0;  // from 1
  Instant at{};
  AlarmId id = 0;
  std::string_view key;
  State from = State::kNormal, to = State::kNormal;
  std::string by, reason;  // empty: no operator caused it

  bool operator==(const AlarmEvent&) const = default;
};

class Engine {
 public:
  static constexpr std::size_t kHistory = 1'000;  // events kept; all are counted

  explicit Engine(AlarmSettings settings = {});

  // `readings`: one per row of the table.
  void step(const std::vector<Reading>& readings, Situations situations, Instant now);

  Result<bool, Problem> acknowledge(AlarmId id, std::string_view by, Instant now);
  Result<bool, Problem> shelve(AlarmId id, Duration length, std::string_view by,
                               std::string_view reason, Instant now);
  Result<bool, Problem> unshelve(AlarmId id, std::string_view by, Instant now);
  Result<bool, Problem> reset(AlarmId id, std::string_view by, Instant now);
  Result<bool, Problem> edit(const AlarmEdit& edit);

  // High alarms first, then in order of activation. Between two changes of revision() only the
  // values change.
  std::vector<ListedAlarm> active() const;
  std::vector<ListedAlarm> shelved() const;
  std::vector<ListedAlarm> suppressed() const;
  std::uint64_t revision() const { return revision_; }
  const std::deque<AlarmEvent>& history() const { return history_; }
  std::uint64_t events() const { return events_; }
  std::size_t count() const;  // in the active list
  std::size_t count(Priority priority) const;
  std::size_t unacknowledged(Priority priority) const;
  State state(AlarmIndex index) const { return entries_[index].alarm.state(); }
  const AlarmRate& rate() const { return rate_; }
  const AlarmSettings& settings() const { return settings_; }

 private:
  struct Entry {
    Alarm alarm;
    AlarmId id = 0;
    bool first_up = false;
    std::string by, reason;
  };
  enum class Part : std::uint8_t { kNone, kActive, kShelved, kSuppressed };

  static Part part_of(State state);
  bool overruled(AlarmIndex index) const;
  std::vector<ListedAlarm> list(Part part) const;
  ListedAlarm line(AlarmIndex index) const;
  struct Origin {
    std::string_view by, reason;
  };
  Result<AlarmIndex, Problem> find(AlarmId id) const;
  void note(AlarmIndex index, State from, Instant now, std::string_view by,
            std::string_view reason);
  void mark_first();
  template <class Act>
  Result<bool, Problem> act(AlarmId id, const Origin& origin, Instant now, const Act& act);

  AlarmSettings settings_;
  std::vector<Entry> entries_;
  std::vector<std::optional<AlarmIndex>> overruled_by_;
  std::vector<AlarmIndex> activated_;  // became active in this step
  std::deque<AlarmEvent> history_;
  AlarmRate rate_;
  std::uint64_t revision_ = 0, events_ = 0;
  AlarmId ids_ = 0;
};

}  // namespace pitwall::alarms
