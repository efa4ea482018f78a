// SPDX-License-Identifier: Apache-2.0
#include "basestation/picture/watch/watch.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace pitwall::picture {
namespace {

using telemetry::field;

std::int64_t step_before(Instant now) {
  const std::int64_t whole = now.ns / kGrid.ns;
  return now.ns % kGrid.ns < 0 ? whole - 1 : whole;
}

}  // namespace

Watch::Watch(WatchConfig config)
    : params_(config.derive),
      limits_(std::move(config.limits)),
      engine_(std::move(config.alarms)),
      course_(std::move(config.course)),
      readings_(alarms::alarm_count()) {}

void Watch::advance(const Picture& picture, Instant now) {
  now_ = std::max(now_, now);
  const std::int64_t newest = step_before(now);
  std::int64_t next = newest_step_ ? *newest_step_ + 1 : newest;
  if (newest - next >= kStepsAtOnce) {
    left_out_ += static_cast<std::uint64_t>(newest - kStepsAtOnce + 1 - next);
    next = newest - kStepsAtOnce + 1;
  }
  for (; next <= newest; ++next) {
    step(picture, Instant{next * kGrid.ns});
    newest_step_ = next;
  }
}

// Who takes an input, by its kind.
struct Watch::Taking {
  Watch& watch;
  Instant at;

  Result<bool, Problem> operator()(const Heard& heard) const {
    watch.heard(heard.at);
    return true;
  }
  Result<bool, Problem> operator()(const LinkFigures& figures) const {
    watch.known_.link = figures;
    return true;
  }
  Result<bool, Problem> operator()(const BaseFigures& figures) const {
    watch.known_.base = figures;
    return true;
  }
  Result<bool, Problem> operator()(const Expectations& expected) const {
    watch.known_.expected = expected;
    return true;
  }
  Result<bool, Problem> operator()(const AlarmAct& act) const {
    alarms::Engine& engine = watch.engine_;
    switch (act.kind) {
      case AlarmAct::Kind::kAcknowledge:
        return engine.acknowledge(act.alarm, act.by, at);
      case AlarmAct::Kind::kShelve:
        return engine.shelve(act.alarm, act.length, act.by, act.reason, at);
      case AlarmAct::Kind::kUnshelve:
        return engine.unshelve(act.alarm, act.by, at);
      case AlarmAct::Kind::kReset:
        return engine.reset(act.alarm, act.by, at);
    }
    return true;
  }
  Result<bool, Problem> operator()(const NoticeAct& act) const {
    alarms::Notices& notices = watch.notices_;
    return act.send ? notices.send(act.notice, act.by) : notices.dismiss(act.notice, act.by);
  }
  Result<bool, Problem> operator()(const LimitEdit& edit) const { return watch.limits_.edit(edit); }
  Result<bool, Problem> operator()(const alarms::AlarmEdit& edit) const {
    return watch.engine_.edit(edit);
  }
};

Result<bool, Problem> Watch::take(const WatchInput& input) {
  auto taken = std::visit(Taking{*this, now_}, input);
  if (told_) told_(input, now_);
  return taken;
}

void Watch::step(const Picture& picture, Instant now) {
  const Course* const course = course_ ? &*course_ : nullptr;
  books_.step(picture, known_, now);
  books_.step_race(picture, params_.fuel, course, now);
  derive(params_, picture, known_, books_, course, now, views_);
  for (alarms::AlarmIndex i = 0; i < readings_.size(); ++i) {
    const FieldView seen = view(picture, alarms::alarm_row(i).field, now);
    readings_[i] = {.value = seen.value, .usable = usable(seen) && !std::isnan(seen.value)};
  }
  engine_.step(readings_, situations(picture, now), now);
  const LinkFigures& link = known_.link;
  const double mode = picture.view(field("mode.mode"), now).value;
  notices_.step(
      {.state = books_.link.state(),
       .silence = link.heard ? now - *link.heard : Duration{},
       .loss = std::fmax(link.down_loss, link.up_loss),
       .round_trip_ms = link.round_trip_ms,
       .car_mode = std::isnan(mode)
                       ? std::string_view{}
                       : telemetry::label_at(telemetry::kModes, static_cast<std::size_t>(mode))},
      now);
}

alarms::Situations Watch::situations(const Picture& picture, Instant now) const {
  using enum alarms::Situation;
  constexpr double kDisarmedMode = 0.0, kStanding_mps = 1.0;
  const auto value = [&](telemetry::FieldIndex index) { return picture.view(index, now).value; };
  alarms::Situations so;
  so.set(kLinkLost, books_.link.state() == LinkState::kLost);
  so.set(kDisarmed, value(field("mode.mode")) == kDisarmedMode);
  so.set(kEngineOff, !(value(field("engine.running")) > 0.0));
  so.set(kStanding, std::abs(value(field("ego.vx"))) < kStanding_mps);
  so.set(kInPit, views_[index_of(BaseField::kInPit)].value > 0.0);
  return so;
}

FieldView Watch::view(const Picture& picture, FieldId field, Instant now) const {
  if (!is_base(field)) return picture.view(field, now);
  FieldView view = views_[index_of(base_field(field))];
  if (newest_step_ && view.quality != Quality::kNever) {
    view.age = view.age + std::max(now - Instant{*newest_step_ * kGrid.ns}, Duration{});
  }
  return view;
}

}  // namespace pitwall::picture
