// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/car_service.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "basestation/service/messages/message_text.hpp"
#include "basestation/service/messages/settings_text.hpp"

namespace pitwall::service {
namespace {

constexpr double kNotRecording = 0.0;  // of state::kRecordingStates

command::ExecutorConfig executor_config(const ServiceConfig& config) {
  command::ExecutorConfig executor{
      .gates = config.gates,
      .second_person = config.second_person,
      .revision = config.revision,
      .budget = {.most = config.up_cap_kbit_s,
                 .now = std::isnan(config.up_kbit_s) ? config.up_cap_kbit_s : config.up_kbit_s}};
  if (config.store) {
    executor.save = [store = config.store](const command::SettingsEditor::Wanted& wanted) {
      return store->save(wanted);
    };
  }
  return executor;
}

}  // namespace

void use_limits(ServiceConfig& config, std::shared_ptr<LimitsStore> store, double up_cap_kbit_s) {
  const settings::Judgement& kept = store->judgement();
  config.revision = kept.revision;
  config.up_kbit_s = std::min(kept.up_kbit_s, up_cap_kbit_s);  // unset stays unset
  config.evaluator = kept;
  config.store = std::move(store);
}

const char* mode_text(link::Station::Source source) {
  switch (source) {
    case link::Station::Source::kNone:
      return "NONE";
    case link::Station::Source::kSimulation:
      return "HIL";
    case link::Station::Source::kCar:
      return "REAL";
  }
  return "NONE";
}

CarService::CarService(ServiceConfig config, const telemetry::LinkEndpointConfig& radio,
                       telemetry::Randomness& randomness)
    : config_(std::move(config)),
      station_(radio, randomness),
      evaluator_(config_.evaluator),
      requests_(executor_config(config_), station_.endpoint(), vehicle_, evaluator_),
      stop_(config_.gates) {
  if (const auto& course = evaluator_.course()) laps_.emplace(course->length_m());
}

std::optional<Problem> CarService::settings_problem() const {
  return config_.store ? config_.store->unreadable() : std::nullopt;
}

CarIdentity CarService::identity() const {
  return {.car = config_.car,
          .name = config_.name,
          .mode = mode_text(station_.source()),
          .alarm_config = std::to_string(requests_.settings().revision()) + "-" +
                          evaluator_.alarms().settings().version_text(),
          .second_person = config_.second_person};
}

bool CarService::receive(std::span<const std::uint8_t> datagram, telemetry::PathId path,
                         UdpAddress from, Instant at) {
  if (!station_.take(datagram, path, from, at)) return false;
  const telemetry::Snapshot& state = station_.endpoint().state();
  const telemetry::Arrival& arrival = *station_.arrival();
  evaluator_.advance(vehicle_, arrival.received);
  if (arrival.groups.count() == 0) {
    static_cast<void>(evaluator_.take(alarms::PacketReceived{arrival.received}));
  } else {
    evaluator_.receive(arrival.received);
  }
  vehicle_.update(state, arrival.groups);
  take_history(state, arrival.groups);
  monitor_.packet(arrival.groups, arrival.received);
  return true;
}

void CarService::restore(const telemetry::Snapshot& state, telemetry::GroupSet groups) {
  vehicle_.update(state, groups);
  take_history(state, groups);
}

void CarService::take_history(const telemetry::Snapshot& state, telemetry::GroupSet groups) {
  trends_.note(state, groups);
  if (laps_) laps_->note(state, groups);
}

void CarService::restore(const command::OperatorEntries& entries, double fuel_left_l, Instant now) {
  requests_.restore(entries);
  state::Expectations expected = entries.expected;
  expected.fuel_used_l = expected.fuel_loaded_l - fuel_left_l;
  evaluator_.advance(vehicle_, now);
  evaluator_.expect(expected);
}

void CarService::advance(Instant now) {
  if (const auto problem = settings_problem(); problem && !settings_reported_) {
    requests_.note({.name = "base"}, unreadable_text(*problem), "not read", now);
    settings_reported_ = true;
  }
  evaluator_.advance(vehicle_, now);
  if (evaluator_.link_state() != link_measured_ || now - measured_ >= kMeasureEvery) measure(now);
  requests_.advance(now);
  if (stop_.is_due(now)) {
    stop_.advance({.gates = {.vehicle = vehicle_,
                             .evaluator = evaluator_,
                             .holder = requests_.authority().holder(now),
                             .now = now},
                   .queue = requests_.queue(),
                   .events = station_.events()});
  }
  set_budget();
  publisher_.publish(*this, messages_, now);
}

void CarService::measure(Instant now) {
  measured_ = now;
  const state::LinkFigures figures = monitor_.measure(station_, vehicle_, now);
  evaluator_.advance(vehicle_, now);
  evaluator_.link(figures);
  evaluator_.base(own_figures(now));
  relay_flag();

  std::array<double, state::kBaseFields> values{};
  for (const state::BaseRow& row : state::kBaseTable) {
    const state::FieldView seen = view(state::id_of(row.field), now);
    const bool old = seen.quality >= state::Quality::kStale;
    values[state::index_of(row.field)] = old ? kUnset : seen.value;
  }
  own_trends_.note(now, values);
  link_measured_ = evaluator_.link_state();
  publisher_.publish_link(*this, messages_, now);
}

state::BaseFigures CarService::own_figures(Instant now) const {
  state::BaseFigures base;
  base.authority_lost = requests_.authority().lost();
  base.schema_differs = station_.report(now).established && !station_.endpoint().schema_agrees();
  base.settings_unreadable = settings_problem().has_value();
  base.joystick_lost = joystick_ && joystick_(now) == command::JoystickState::kLost;
  const auto error = config_.utc_error ? config_.utc_error() : std::nullopt;
  if (error) base.clock_offset_ms = error->milliseconds();
  base.recording = kNotRecording;
  if (recorder_figures_) recorder_figures_(base, now);
  return base;
}

// The flag that the car has taken from us, for conflicts with race control's.
void CarService::relay_flag() {
  const auto* const flag = station_.endpoint().newest(telemetry::CommandType::kTrackFlag);
  if (flag == nullptr || flag->outcome != telemetry::Outcome::kApplied) return;
  requests_.relay_flag(flag->command.argument > 0.0 ? flag->command.argument : kUnset);
}

void CarService::set_budget() {
  const command::UpBudget& budget = requests_.settings().budget();
  if (std::isnan(budget.now) || budget.now == budget_set_) return;
  budget_set_ = budget.now;
  station_.endpoint().set_budget_share(budget.now / budget.most);
}

void CarService::mark(const std::string& text, const command::Person& by, Instant now) {
  messages_.add_line("mark", mark_text(text, by.name, now), now);
}

std::vector<command::Check> CarService::checks(Instant now) const {
  const CarIdentity self = identity();
  return command::checks_of({.vehicle = vehicle_,
                             .evaluator = evaluator_,
                             .holder = requests_.authority().holder(now),
                             .holder_name = requests_.authority().holder_person().name,
                             .settings = {.version = self.alarm_config,
                                          .kept = requests_.settings().kept(),
                                          .readable = !settings_problem()},
                             .joystick = joystick_ ? joystick_(now) : command::JoystickState::kNone,
                             .now = now});
}

std::vector<state::TrendPoint> CarService::past(state::FieldId field, Instant from, Instant to,
                                                std::size_t points) const {
  if (!state::is_base(field)) return trends_.range(field, from, to, points);
  return own_trends_.range(state::index_of(state::base_field(field)), from, to, points,
                           state::kBasePeriod);
}

}  // namespace pitwall::service
