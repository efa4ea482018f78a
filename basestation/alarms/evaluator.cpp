// SPDX-License-Identifier: Apache-2.0
#include "basestation/alarms/evaluator.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace pitwall::alarms {
namespace {

using telemetry::field;

std::int64_t step_before(Instant now) {
  const std::int64_t whole = now.ns / kGrid.ns;
  return now.ns % kGrid.ns < 0 ? whole - 1 : whole;
}

}  // namespace

Evaluator::Evaluator(EvaluatorConfig config)
    : params_(config.derive),
      limits_(std::move(config.limits)),
      engine_(std::move(config.alarms)),
      course_(std::move(config.course)),
      readings_(alarm_count()) {}

void Evaluator::advance(const state::VehicleState& vehicle, Instant now) {
  now_ = std::max(now_, now);
  const std::int64_t newest = step_before(now);
  std::int64_t next = newest_step_ ? *newest_step_ + 1 : newest;
  if (newest - next >= kStepsAtOnce) {
    left_out_ += static_cast<std::uint64_t>(newest - kStepsAtOnce + 1 - next);
    next = newest - kStepsAtOnce + 1;
  }
  for (; next <= newest; ++next) {
    step(vehicle, Instant{next * kGrid.ns});
    newest_step_ = next;
  }
}

// Who takes an input, by its kind.
struct Evaluator::Taking {
  Evaluator& evaluator;
  Instant at;

  Result<bool, Problem> operator()(const PacketReceived& received) const {
    evaluator.receive(received.at);
    return true;
  }
  Result<bool, Problem> operator()(const state::LinkFigures& figures) const {
    evaluator.known_.link = figures;
    return true;
  }
  Result<bool, Problem> operator()(const state::BaseFigures& figures) const {
    evaluator.known_.base = figures;
    return true;
  }
  Result<bool, Problem> operator()(const state::Expectations& expected) const {
    evaluator.known_.expected = expected;
    return true;
  }
  Result<bool, Problem> operator()(const AlarmAction& act) const {
    Engine& engine = evaluator.engine_;
    switch (act.kind) {
      case AlarmAction::Kind::kAcknowledge:
        return engine.acknowledge(act.alarm, act.by, at);
      case AlarmAction::Kind::kShelve:
        return engine.shelve(act.alarm, act.length, act.by, act.reason, at);
      case AlarmAction::Kind::kUnshelve:
        return engine.unshelve(act.alarm, act.by, at);
      case AlarmAction::Kind::kReset:
        return engine.reset(act.alarm, act.by, at);
    }
    return true;
  }
  Result<bool, Problem> operator()(const NoticeAction& act) const {
    Notices& notices = evaluator.notices_;
    return notices.decide(act.notice, act.reported ? NoticeFate::kReported : NoticeFate::kDismissed,
                          act.by);
  }
  Result<bool, Problem> operator()(const LimitEdit& edit) const {
    return evaluator.limits_.edit(edit);
  }
  Result<bool, Problem> operator()(const AlarmEdit& edit) const {
    return evaluator.engine_.edit(edit);
  }
};

Result<bool, Problem> Evaluator::take(const EvaluatorInput& input) {
  auto taken = std::visit(Taking{*this, now_}, input);
  if (reported_) reported_(input, now_);
  return taken;
}

void Evaluator::step(const state::VehicleState& vehicle, Instant now) {
  const state::Course* const course = course_ ? &*course_ : nullptr;
  monitors_.step(vehicle, known_, now);
  monitors_.step_race(vehicle, params_.fuel, course, now);
  state::derive(params_, vehicle, known_, monitors_, course, now, views_);
  for (AlarmIndex i = 0; i < readings_.size(); ++i) {
    const state::FieldView seen = view(vehicle, alarm_row(i).field, now);
    readings_[i] = {.value = seen.value, .usable = state::usable(seen) && !std::isnan(seen.value)};
  }
  engine_.step(readings_, situations(vehicle, now), now);
  const state::LinkFigures& link = known_.link;
  const double mode = vehicle.view(field("mode.mode"), now).value;
  notices_.step(
      {.state = monitors_.link.state(),
       .silence = link.received ? now - *link.received : Duration{},
       .loss = std::fmax(link.down_loss, link.up_loss),
       .round_trip_ms = link.round_trip_ms,
       .car_mode = std::isnan(mode)
                       ? std::string_view{}
                       : telemetry::label_at(telemetry::kModes, static_cast<std::size_t>(mode))},
      now);
}

Situations Evaluator::situations(const state::VehicleState& vehicle, Instant now) const {
  using enum Situation;
  constexpr double kDisarmedMode = 0.0, kStanding_mps = 1.0;
  const auto value = [&](telemetry::FieldIndex index) { return vehicle.view(index, now).value; };
  Situations so;
  so.set(kLinkLost, monitors_.link.state() == state::LinkState::kLost);
  so.set(kDisarmed, value(field("mode.mode")) == kDisarmedMode);
  so.set(kEngineOff, !(value(field("engine.running")) > 0.0));
  so.set(kStanding, std::abs(value(field("ego.vx"))) < kStanding_mps);
  constexpr double kReceivers = 4.0;  // bits below this one, of kExcludableNames
  so.set(kReceiverExcluded, std::fmod(value(field("localization.excluded")), kReceivers) > 0.0);
  so.set(kInPit, views_[state::index_of(state::BaseField::kInPit)].value > 0.0);
  return so;
}

state::FieldView Evaluator::view(const state::VehicleState& vehicle, state::FieldId field,
                                 Instant now) const {
  if (!state::is_base(field)) return vehicle.view(field, now);
  state::FieldView view = views_[state::index_of(state::base_field(field))];
  if (newest_step_ && view.quality != state::Quality::kNever) {
    view.age = view.age + std::max(now - Instant{*newest_step_ * kGrid.ns}, Duration{});
  }
  return view;
}

}  // namespace pitwall::alarms
