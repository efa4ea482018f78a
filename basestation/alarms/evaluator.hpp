// Alarm evaluator: derived fields, alarms and notices of one car. The caller gives the time and
// each change; the evaluator has no clock of its own.
//   in     the vehicle state, figures of link and base, expectations, operator actions
//   out    views of every field with an evaluation, the list of alarms, drafts for race control
//   invariants
//          advance(t) makes a step at every multiple of kGrid up to t, with what was known until
//          then. So the same changes at the same times give the same alarms, however often
//          advance() is called: live, in replay, in a test. Before a change the caller calls
//          advance() with the time of the change
//   errors operator actions: as Engine
//   cost   a step takes some microseconds, and allocates nothing while no alarm changes state
//
//   evaluator.advance(vehicle, received);  vehicle.update(snapshot, groups);
//   evaluator.link(figures);
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include "basestation/alarms/engine.hpp"
#include "basestation/alarms/evaluator_input.hpp"
#include "basestation/alarms/limits.hpp"
#include "basestation/alarms/notices.hpp"
#include "basestation/state/course.hpp"
#include "basestation/state/derived/derive.hpp"
#include "basestation/state/known.hpp"
#include "basestation/state/vehicle_state.hpp"

namespace pitwall::alarms {

inline constexpr Duration kGrid = milliseconds(10);

struct EvaluatorConfig {
  state::DeriveParams derive;
  Limits limits;
  AlarmSettings alarms;
  std::optional<state::Course> course;
};

class Evaluator {
 public:
  explicit Evaluator(EvaluatorConfig config = {});

  // Makes every step of the grid in (newest step, now], at most kStepsAtOnce. Older steps are left
  // out and counted: a base that was suspended for an hour does not evaluate that hour.
  static constexpr std::int64_t kStepsAtOnce = 60'000;
  void advance(const state::VehicleState& vehicle, Instant now);
  std::uint64_t steps_left_out() const { return left_out_; }

  // Call it after advance() to the time of the change, which becomes the time of the input.
  Result<bool, Problem> take(const EvaluatorInput& input);
  void link(const state::LinkFigures& figures) { static_cast<void>(take(figures)); }
  void base(const state::BaseFigures& figures) { static_cast<void>(take(figures)); }
  void expect(const state::Expectations& expected) { static_cast<void>(take(expected)); }
  Result<bool, Problem> edit(const LimitEdit& edit) { return take(edit); }
  Result<bool, Problem> edit(const AlarmEdit& edit) { return take(edit); }
  // Notes the time of a packet with states. The figures of the link have it too, but come seldom.
  void receive(Instant at) { known_.link.received = at; }
  // Sets the receiver of every input with its time: the recording.
  void tell_inputs(std::function<void(const EvaluatorInput&, Instant)> reported) {
    reported_ = std::move(reported);
  }

  const Engine& alarms() const { return engine_; }
  const Notices& notices() const { return notices_; }
  const Limits& limits() const { return limits_; }
  const state::Known& known() const { return known_; }
  const std::optional<state::Course>& course() const { return course_; }
  state::LinkState link_state() const { return monitors_.link.state(); }
  Instant link_since() const { return monitors_.link.since(); }
  rules::FuelLeft fuel() const { return monitors_.fuel.left(params_.fuel); }
  const state::DeriveParams& params() const { return params_; }  // as in the file
  const state::TyreGate& tyre_gate() const { return params_.tyres; }

  // View of any field: one of the car at `now`, one of the base as of the newest step.
  state::FieldView view(const state::VehicleState& vehicle, state::FieldId field,
                        Instant now) const;
  Evaluation evaluate(state::FieldId field, const state::FieldView& view) const {
    return limits_.evaluate(field, view);
  }

 private:
  struct Taking;

  void step(const state::VehicleState& vehicle, Instant now);
  Situations situations(const state::VehicleState& vehicle, Instant now) const;

  state::DeriveParams params_;
  Limits limits_;
  Engine engine_;
  std::optional<state::Course> course_;
  state::Known known_;
  state::MonitorState monitors_;
  Notices notices_;
  state::BaseViews views_{};
  std::vector<Reading> readings_;  // kept for its storage
  std::optional<std::int64_t> newest_step_;
  std::uint64_t left_out_ = 0;
  Instant now_{};  // of the newest advance()
  std::function<void(const EvaluatorInput&, Instant)> reported_;
};

}  // namespace pitwall::alarms
