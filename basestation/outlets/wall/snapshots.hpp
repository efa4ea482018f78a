// The pictures that consoles get: when one is made, and what is in it.
//
//   packet |    |    |    |  (50 a second)
//   frame  |         |       made when a packet comes, so that what is told is new; kEvery apart
//   none comes:      |            |      by itself after kAtLatest
//
//   in     packets with their groups, views of all fields, time
//   out    frames: every field each second and when asked for, else those whose entry changed
//   law    a safety value that changed (a mode, a flag, a stop) is told at once; its age is not
//          what is told is what was told last to all: a client that lost frames is whole again with
//          the next full picture
//   cost   O(fields) a frame
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "basestation/outlets/web/frame.hpp"
#include "basestation/picture/own_field.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::outlets::wall {

using web::Entry;
using web::Frame;

// What consoles see: the live base or a replay.
class Eyes {
 public:
  virtual ~Eyes() = default;
  virtual picture::FieldView view(picture::FieldId field, Instant now) const = 0;
  virtual picture::Judgement judge(picture::FieldId field, const picture::FieldView& v) const = 0;
  virtual std::vector<picture::TrendPoint> past(picture::FieldId field, Instant from, Instant to,
                                                std::size_t points) const = 0;
};

class Snapshots {
 public:
  // Two packets of 50 a second, less the jitter of one.
  static constexpr Duration kEvery = milliseconds(36), kAtLatest = milliseconds(50);
  static constexpr Duration kFullEvery = seconds(1);

  Snapshots();
  void heard() { news_ = true; }  // a packet of the car
  void want_full() { full_wanted_ = true; }
  // The next frame, where one is due.
  std::optional<Frame> make(const Eyes& eyes, Instant now);
  Instant due() const { return last_ + kAtLatest; }

 private:
  bool safety_changed(const Eyes& eyes, Instant now) const;

  std::vector<picture::FieldId> fields_, watched_;
  std::vector<Entry> told_;  // by place in fields_
  bool news_ = false, full_wanted_ = true;
  Instant last_{}, last_full_{};
  std::uint32_t sequence_ = 0;
};

// Every field that a console may ask for: those that come down the radio, and the base's own.
std::vector<picture::FieldId> told_fields();

}  // namespace pitwall::outlets::wall
