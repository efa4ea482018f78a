// The base's judgement of all that it knows: derived fields, alarms, notices. One object, stepped
// with time, told what changes; no clock of its own.
//   in     the picture, figures of link and base, expectations, operators' acts
//   out    views of every field with a judgement, the list of alarms, drafts for race control
//   law    it is stepped at whole multiples of kGrid, whatever the caller's rhythm: advance(t)
//          makes every step up to t with what was known until then. So the same changes at the same
//          times give the same alarms, however often anybody asked: live, in replay, in a test.
//          Whoever changes something therefore calls advance() with the time of the change first
//   errors acts as alarms::Engine has them
//   cost   a step is some microseconds and allocates nothing while no alarm comes or goes
//
//   watch.advance(picture, received);  picture.update(snapshot, groups);  watch.link(figures);
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include "basestation/picture/alarms/engine.hpp"
#include "basestation/picture/alarms/notices.hpp"
#include "basestation/picture/course.hpp"
#include "basestation/picture/incidents/derive.hpp"
#include "basestation/picture/known.hpp"
#include "basestation/picture/limits.hpp"
#include "basestation/picture/picture.hpp"
#include "basestation/picture/watch/input.hpp"

namespace pitwall::picture {

inline constexpr Duration kGrid = milliseconds(10);

struct WatchConfig {
  DeriveParams derive;
  Limits limits;
  alarms::AlarmSettings alarms;
  std::optional<Course> course;
};

class Watch {
 public:
  explicit Watch(WatchConfig config = {});

  // Every step of the grid in (newest step, now]; at most kStepsAtOnce, older ones are left out and
  // counted: a base that slept for an hour does not judge that hour.
  static constexpr std::int64_t kStepsAtOnce = 60'000;
  void advance(const Picture& picture, Instant now);
  std::uint64_t steps_left_out() const { return left_out_; }

  // After advance() to the time of the change, which is then that of the input.
  Result<bool, Problem> take(const WatchInput& input);
  void link(const LinkFigures& figures) { static_cast<void>(take(figures)); }
  void base(const BaseFigures& figures) { static_cast<void>(take(figures)); }
  void expect(const Expectations& expected) { static_cast<void>(take(expected)); }
  Result<bool, Problem> edit(const LimitEdit& edit) { return take(edit); }
  Result<bool, Problem> edit(const alarms::AlarmEdit& edit) { return take(edit); }
  // A packet with states came; the figures of the link say it, too, but seldom.
  void heard(Instant at) { known_.link.heard = at; }
  // Who is told every input when it was taken: a recording.
  void tell_inputs(std::function<void(const WatchInput&, Instant)> told) {
    told_ = std::move(told);
  }

  const alarms::Engine& alarms() const { return engine_; }
  const alarms::Notices& notices() const { return notices_; }
  const Limits& limits() const { return limits_; }
  const Known& known() const { return known_; }
  const std::optional<Course>& course() const { return course_; }
  LinkState link_state() const { return books_.link.state(); }
  Instant link_since() const { return books_.link.since(); }
  FuelLeft fuel() const { return books_.fuel_left(params_.fuel); }
  const DeriveParams& params() const { return params_; }  // as the file has them
  const TyreGate& tyre_gate() const { return params_.tyres; }

  // Of any field, the car's at `now`, the base's own as of the newest step.
  FieldView view(const Picture& picture, FieldId field, Instant now) const;
  Judgement judge(FieldId field, const FieldView& view) const { return limits_.judge(field, view); }

 private:
  struct Taking;

  void step(const Picture& picture, Instant now);
  alarms::Situations situations(const Picture& picture, Instant now) const;

  DeriveParams params_;
  Limits limits_;
  alarms::Engine engine_;
  std::optional<Course> course_;
  Known known_;
  Books books_;
  alarms::Notices notices_;
  BaseViews views_{};
  std::vector<alarms::Reading> readings_;  // kept for its storage
  std::optional<std::int64_t> newest_step_;
  std::uint64_t left_out_ = 0;
  Instant now_{};  // of the newest advance()
  std::function<void(const WatchInput&, Instant)> told_;
};

}  // namespace pitwall::picture
