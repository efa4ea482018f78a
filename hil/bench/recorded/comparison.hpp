// What a car that is driven again says otherwise than in the recording, signal by signal.
//   in     a tick of the recording and the same one driven again; the CAN database; tolerances
//   out    for each signal that differs: how often, where first, where most; what was not compared
//   units  of the database, of the registry
//   invariants
//          frames are matched by identifier and place among those of a tick: one that only one side
//          says is a difference of its message, and so are bits that belong to no signal
//          a group of telemetry that only one side ever tells is a difference
//          without a tolerance a value differs where its bits do; NaN equals NaN
//   cost   O(fields) a tick with a state; frames of equal bytes are not decoded
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "hil/bench/recorded/drive_again.hpp"
#include "hil/bench/recorded/recorded_run.hpp"
#include "protocol/can/database.hpp"

namespace pitwall::bench {

struct Divergence {
  std::uint64_t tick = 0;
  Instant at{};
  double recorded = kUnset, again = kUnset;
  double size() const;  // NaN where one side has no number
};

struct SignalDifference {
  std::string signal;  // "steering_cmd.steering_motor_cmd", "ego.vx"
  std::uint64_t values = 0;
  Divergence first, largest;
  std::string context;  // of the first: what the car did then, by the recording
};

struct CompareRules {
  std::map<std::string, double> tolerance{};  // by signal; absolute, others have none
  std::set<std::string> ignored{};            // signals, or whole messages and groups
};

class Comparison {
 public:
  Comparison(const can::Database& database, CompareRules rules);

  void add(const RecordedTick& recorded, const AgainTick& again, const FieldSet& measured);

  // By their first divergence; of one tick, in the order in which they were met.
  std::vector<SignalDifference> differences() const;
  // Rules that named nothing which was compared.
  std::vector<std::string> unused_rules() const;
  std::uint64_t ticks() const { return ticks_; }
  std::uint64_t frames() const { return frames_; }
  std::uint64_t values() const { return values_; }
  const FieldSet& measured() const { return measured_; }

 private:
  void add_frames(const RecordedTick& recorded, const AgainTick& again);
  void add_pair(const can::Frame& recorded, const can::Frame& again, const RecordedTick& tick);
  void add_state(const RecordedTick& recorded, const RecordedState& again);
  void note_new(const telemetry::GroupRow& row, const RecordedTick& tick);
  void compare(const std::string& group, const std::string& name, double recorded, double again,
               const RecordedTick& tick);
  bool is_ignored(const std::string& name);
  void note_frame(const can::Frame& frame, double recorded, double again, const RecordedTick& tick);
  void note(const std::string& signal, double recorded, double again, const RecordedTick& tick);

  const can::Database& database_;
  CompareRules rules_;
  std::set<std::string> used_;
  std::map<std::string, SignalDifference> found_;
  std::vector<std::string> order_;
  std::map<telemetry::Group, SignalDifference> new_groups_;  // told now, not in that tick's state
  telemetry::GroupSet recorded_groups_;
  std::string context_;  // by the newest recorded state
  FieldSet measured_;
  std::uint64_t ticks_ = 0, frames_ = 0, values_ = 0;
};

}  // namespace pitwall::bench
