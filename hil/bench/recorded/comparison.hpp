// Comparison of a replayed car with its recording, signal by signal.
//   in     a tick of the recording and the same tick driven again; the CAN database; tolerances
//   out    each signal that differs: how often, the first difference, the largest; fields that were
//          not compared
//   units  of the database, of the telemetry registry
//   invariants
//          frames are matched by identifier and order within a tick. A frame that only one side
//          sends is a difference of its message, and so are differing bits that belong to no signal
//          a telemetry group that only one side ever has is a difference
//          without a tolerance, values differ if their bits differ; NaN equals NaN
//   cost   O(fields) for a tick with a state; equal frames are not decoded
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
  double size() const;  // NaN if one side has no number
};

struct SignalDifference {
  std::string signal;  // "steering_cmd.steering_motor_cmd", "ego.vx"
  std::uint64_t values = 0;
  Divergence first, largest;
  std::string context;  // of the first difference: position, speed, mode in the recording
};

struct CompareRules {
  std::map<std::string, double> tolerance{};  // absolute, by signal; 0 for all others
  std::set<std::string> ignored{};            // signals, or whole messages or groups
};

class Comparison {
 public:
  Comparison(const can::Database& database, CompareRules rules);

  void add(const RecordedTick& recorded, const AgainTick& again, const FieldSet& measured);

  // In order of the first divergence; within one tick, in the order of detection.
  std::vector<SignalDifference> differences() const;
  // Rules that matched nothing that was compared.
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
  // sent in the replay, not in the recorded state of the tick
  std::map<telemetry::Group, SignalDifference> new_groups_;
  telemetry::GroupSet recorded_groups_;
  std::string context_;  // from the newest recorded state
  FieldSet measured_;
  std::uint64_t ticks_ = 0, frames_ = 0, values_ = 0;
};

}  // namespace pitwall::bench
