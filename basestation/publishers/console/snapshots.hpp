// State snapshots for consoles: when one is made, and its content.
//
//   packet |    |    |    |  (50 a second)
//   frame  |         |       made when a packet comes, so that its content is new; kEvery apart
//   no packet:       |            |      made after kAtLatest
//
//   in     packets with their groups, views of all fields, time
//   out    frames: every field each second and on request, otherwise the fields whose entry changed
//   invariants
//          a change of a safety value (a mode, a flag, a stop) is sent at once; a change of its age
//          is not
//          changes are relative to the last frame sent to all clients: a client that lost frames is
//          complete again with the next full one
//   cost   O(fields) a frame
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "basestation/publishers/web/frame.hpp"
#include "basestation/state/laps/lap_log.hpp"
#include "basestation/state/station_field.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::publishers::console {

using web::Entry;
using web::Frame;

// Source of what consoles show: the live base or a replay.
class StateSource {
 public:
  virtual ~StateSource() = default;
  virtual state::FieldView view(state::FieldId field, Instant now) const = 0;
  virtual alarms::Evaluation evaluate(state::FieldId field, const state::FieldView& v) const = 0;
  virtual std::vector<state::TrendPoint> past(state::FieldId field, Instant from, Instant to,
                                              std::size_t points) const = 0;
  virtual const state::LapLog* laps() const = 0;  // nullptr: without a course
};

class Snapshots {
 public:
  // Two packets of 50 a second, less the jitter of one.
  static constexpr Duration kEvery = milliseconds(36), kAtLatest = milliseconds(50);
  static constexpr Duration kFullEvery = seconds(1);

  Snapshots();
  void receive() { news_ = true; }  // a packet of the car
  void want_full() { full_wanted_ = true; }
  // Returns the next frame if one is due.
  std::optional<Frame> make(const StateSource& source, Instant now);
  Instant due() const { return last_ + kAtLatest; }

 private:
  bool safety_changed(const StateSource& source, Instant now) const;

  std::vector<state::FieldId> fields_, watched_;
  std::vector<Entry> reported_;  // by place in fields_
  bool news_ = false, full_wanted_ = true;
  Instant last_{}, last_full_{};
  std::uint32_t sequence_ = 0;
};

// Every field that a console may show: those that the car sends, and the base's own.
std::vector<state::FieldId> reported_fields();

}  // namespace pitwall::publishers::console
