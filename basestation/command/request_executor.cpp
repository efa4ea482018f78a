// SPDX-License-Identifier: Apache-2.0
#include "basestation/command/request_executor.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <variant>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::command {
namespace {

using alarms::AlarmAction;
using telemetry::field;
using Done = Result<bool, Problem>;

constexpr double kDisarmedMode = 0.0;
constexpr const char* kNotHolding = "you do not hold the authority";

std::string quantity(double value, const char* unit) { return formatted("%.1f %s", value, unit); }

Unexpected<Problem> refusal(const char* place, const char* why) {
  return Unexpected{Problem{place, why}};
}

// What the car does not believe now: as ordered last, until the car reports it itself.
std::optional<std::uint32_t> excluded_now(const telemetry::StationEndpoint& radio) {
  using telemetry::Group;
  const auto* const ordered = radio.newest(telemetry::CommandType::kSensorsExcluded);
  const Instant reported_at = radio.state().at(Group::kLocalization);
  const bool pending = ordered != nullptr && !ordered->outcome;
  const bool unreported = ordered != nullptr && ordered->outcome == telemetry::Outcome::kApplied &&
                          ordered->decided && reported_at <= *ordered->decided;
  if (pending || unreported) return static_cast<std::uint32_t>(ordered->command.argument);
  const double reported = radio.state().values[field("localization.excluded")];
  if (!radio.state().ever(Group::kLocalization) || !(reported >= 0.0)) return std::nullopt;
  return static_cast<std::uint32_t>(reported);
}

}  // namespace

struct RequestExecutor::Execution {
  RequestExecutor& executor;
  const Person& by;
  Instant now;

  bool holds() const { return executor.authority_.holder(now) == by.console; }
  GateInputs gate_inputs() const {
    return {.vehicle = executor.vehicle_,
            .evaluator = executor.evaluator_,
            .holder = executor.authority_.holder(now),
            .now = now};
  }
  void catch_up() const { executor.evaluator_.advance(executor.vehicle_, now); }
  Done judge(const alarms::EvaluatorInput& input) const {
    catch_up();
    return executor.evaluator_.take(input);
  }
  // 0, which no alarm has, where it is not active.
  alarms::AlarmId id_of(std::string_view key) const {
    for (const alarms::ListedAlarm& alarm : executor.evaluator_.alarms().active())
      if (alarm.key == key) return alarm.id;
    return 0;
  }
  // Of who holds the authority only; with its audit line.
  Done enter(const char* place, const std::string& what) const {
    executor.audit_.add(now, by.name, what,
                        holds() ? "done" : std::string{"refused: "} + kNotHolding);
    if (!holds()) return refusal(place, kNotHolding);
    ++executor.entries_.revision;
    return true;
  }
  void expect() const {
    catch_up();
    executor.evaluator_.expect(executor.entries_.expected);
  }
  // What the car is told of its tank, the base knows too.
  void know_fuel(telemetry::CommandType type, double litres) const {
    if (type != telemetry::CommandType::kFuelEntered) return;
    executor.entries_.expected.fuel_loaded_l = litres;
    ++executor.entries_.expected.fuel_entries;
    ++executor.entries_.revision;
    executor.entries_.fuel_by = by.name;
    executor.entries_.fuel_at = now;
    expect();
  }
  SettingsEditor::Origin origin(const std::string& reason) const {
    catch_up();
    return {.by = by, .holds_authority = holds(), .reason = reason, .at = now};
  }

  Done operator()(const Stop& ask) const {
    executor.queue_.stop(ask.level, telemetry::StopReason::kOperator, by, now, executor.radio_);
    return true;
  }
  Done operator()(const ReleaseStop& ask) const {
    const double challenge = executor.radio_.state().values[field("mode.stop_challenge")];
    if (!holds()) return refuse("release_stop", kNotHolding);
    if (!(challenge > 0.0)) return refuse("release_stop", "the car reports no latched stop");
    return (*this)(IssueCommand{.type = telemetry::CommandType::kReleaseStop,
                                .argument = challenge,
                                .overriding = ask.overriding});
  }
  Done operator()(const Recover& ask) const {
    switch (ask.step) {
      case RecoveryStep::kRelease:
        return release_seen(ask.challenge);
      case RecoveryStep::kAcknowledge:
        return acknowledge_stop();
      case RecoveryStep::kReset:
        return reset_stop();
      case RecoveryStep::kArm:
        return (*this)(IssueCommand{.type = telemetry::CommandType::kArm, .argument = 1.0});
    }
    return true;
  }
  Done operator()(const ClaimAuthority& ask) const {
    AuthorityHandover& authority = executor.authority_;
    switch (ask.claim) {
      case Claim::kTake:
        return authority.take(by, now);
      case Claim::kRenew:
        return authority.renew(by, now);
      case Claim::kDrop:
        return authority.drop(by, now);
      case Claim::kRequest:
        return authority.request(by, now);
      case Claim::kGrant:
        return authority.grant(by, now);
      case Claim::kRefuse:
        return authority.refuse(by, now);
    }
    return true;
  }
  Done operator()(const StageCommand& ask) const {
    const auto ticket = executor.queue_.stage(by, ask.type, ask.argument, gate_inputs());
    return ticket ? Done{true} : Done{Unexpected{ticket.error()}};
  }
  Done operator()(const SendTicket& ask) const {
    auto done =
        executor.queue_.send(ask.ticket, by, ask.overriding, gate_inputs(), executor.radio_);
    const Ticket* const sent = executor.queue_.ticket(ask.ticket);
    if (done && sent != nullptr) know_fuel(sent->command.type, sent->command.argument);
    return done;
  }
  Done operator()(const CancelTicket& ask) const {
    return executor.queue_.cancel(ask.ticket, by, now);
  }
  Done operator()(const IssueCommand& ask) const {
    auto done = executor.queue_.issue(by, ask.type, ask.argument, ask.overriding, gate_inputs(),
                                      executor.radio_);
    if (done) know_fuel(ask.type, ask.argument);
    return done;
  }
  Done operator()(const ExcludeSensor& ask) const {
    const auto excluded = excluded_now(executor.radio_);
    if (!excluded)
      return refuse("sensors excluded", "the car has not reported which sensors it excludes");
    const std::uint32_t set = ask.exclude ? *excluded | ask.bit : *excluded & ~ask.bit;
    return (*this)(IssueCommand{.type = telemetry::CommandType::kSensorsExcluded,
                                .argument = static_cast<double>(set)});
  }
  Done operator()(const AcknowledgeAlarms& ask) const {
    Done done = true;
    const auto acknowledge = [&](alarms::AlarmId id) {
      auto one = judge(AlarmAction{
          .kind = AlarmAction::Kind::kAcknowledge, .alarm = id, .by = by.name, .reason = {}});
      if (!one) done = std::move(one);
    };
    for (const alarms::AlarmId id : ask.alarms) acknowledge(id);
    if (!ask.key.empty()) acknowledge(id_of(ask.key));
    if (!ask.all) return done;
    for (const alarms::ListedAlarm& alarm : executor.evaluator_.alarms().active())
      if (alarm.state == alarms::State::kUnack || alarm.state == alarms::State::kReturnedUnack)
        acknowledge(alarm.id);
    return done;
  }
  Done operator()(const ShelveAlarm& ask) const {
    return judge(AlarmAction{.kind = AlarmAction::Kind::kShelve,
                             .alarm = ask.alarm,
                             .length = ask.length,
                             .by = by.name,
                             .reason = ask.reason});
  }
  Done operator()(const UnshelveAlarm& ask) const {
    return judge(AlarmAction{
        .kind = AlarmAction::Kind::kUnshelve, .alarm = ask.alarm, .by = by.name, .reason = {}});
  }
  Done operator()(const ResetAlarm& ask) const {
    const alarms::AlarmId id = ask.key.empty() ? ask.alarm : id_of(ask.key);
    return judge(
        AlarmAction{.kind = AlarmAction::Kind::kReset, .alarm = id, .by = by.name, .reason = {}});
  }
  Done operator()(const AnswerNotice& ask) const {
    auto done =
        judge(alarms::NoticeAction{.notice = ask.notice, .reported = ask.reported, .by = by.name});
    executor.audit_.add(now, by.name, "notice " + std::to_string(ask.notice) + kind_of(ask.notice),
                        !done          ? "refused: " + done.error().what
                        : ask.reported ? "reported to race control"
                                       : "not needed");
    return done;
  }
  Done operator()(const ExpectRoundSpeed& ask) const {
    const double speed_mps = ask.speed_mps.value_or(kUnset);
    auto entered =
        enter("expect", ask.speed_mps ? "round speed announced: " + quantity(speed_mps, "m/s")
                                      : "no round speed announced");
    if (!entered) return entered;
    executor.entries_.expected.round_speed_mps = speed_mps;
    executor.entries_.round_speed_by = by.name;
    expect();
    return entered;
  }
  Done operator()(const ReportFuel& ask) const {
    auto entered = enter("fuel_loaded", "fuel in the tank: " + quantity(ask.litres, "l"));
    if (!entered) return entered;
    know_fuel(telemetry::CommandType::kFuelEntered, ask.litres);
    // The car reckons by the same entry; one that cannot be told now leaves the base's as it is.
    (void)executor.queue_.issue(by, telemetry::CommandType::kFuelEntered, ask.litres, {},
                                gate_inputs(), executor.radio_);
    return entered;
  }
  Done operator()(const EditAlarm& ask) const {
    return executor.settings_.change(origin(ask.reason), ask.edit);
  }
  Done operator()(const EditLimit& ask) const {
    alarms::LimitEdit edit = ask.edit;
    const alarms::Limit& present = executor.evaluator_.limits().of(edit.field);
    edit.limit.warning_values = ask.warning_values.value_or(present.warning_values);
    edit.limit.bad_values = ask.bad_values.value_or(present.bad_values);
    return executor.settings_.change(origin(ask.reason), std::move(edit));
  }
  Done operator()(const EditBudget& ask) const {
    return executor.settings_.change_budget(origin(ask.reason), ask.up_kbit_s);
  }

 private:
  std::string kind_of(std::uint32_t notice) const {
    for (const alarms::Notice& one : executor.evaluator_.notices().all())
      if (one.id == notice) return " (" + std::string{alarms::text_of(one.kind)} + ")";
    return {};
  }
  bool is_in(std::string_view key, std::initializer_list<alarms::State> states) const {
    const alarms::State state = executor.evaluator_.alarms().state(*alarms::find_alarm(key));
    return std::find(states.begin(), states.end(), state) != states.end();
  }
  Done release_seen(std::optional<double> seen) const {
    const double challenge = executor.radio_.state().values[field("mode.stop_challenge")];
    if (seen && *seen != challenge && challenge > 0.0)
      return refuse("release_stop", "another stop was latched since it was looked at");
    return (*this)(ReleaseStop{});
  }
  Done acknowledge_stop() const {
    Done done{Unexpected{Problem{"acknowledge", "no alarm of a stop waits for it"}}};
    for (const std::string_view key : kStopAlarms)
      if (is_in(key, {alarms::State::kUnack, alarms::State::kReturnedUnack}))
        done = (*this)(AcknowledgeAlarms{.key = std::string{key}});
    return done;
  }
  // The alarms first: a car that was reset is armed, and no alarm of the stop bars that.
  Done reset_stop() const {
    if (!holds()) return refuse("reset", kNotHolding);
    for (const std::string_view key : kStopAlarms) {
      if (!is_in(key, {alarms::State::kLatched})) continue;
      if (auto done = (*this)(ResetAlarm{.key = std::string{key}}); !done) return done;
    }
    const double mode = executor.vehicle_.view(field("mode.mode"), now).value;
    if (mode == kDisarmedMode) return true;  // nothing of the car is left to be reset
    return (*this)(IssueCommand{.type = telemetry::CommandType::kReset, .argument = 1.0});
  }
  Unexpected<Problem> refuse(const char* place, const char* why) const {
    executor.audit_.add(now, by.name, place, std::string{"refused: "} + why);
    return refusal(place, why);
  }
};

RequestExecutor::RequestExecutor(ExecutorConfig config, telemetry::StationEndpoint& radio,
                                 const state::VehicleState& vehicle, alarms::Evaluator& evaluator)
    : radio_(radio),
      vehicle_(vehicle),
      evaluator_(evaluator),
      authority_(radio.authority(), audit_),
      queue_(config.gates, config.second_person, audit_),
      settings_(evaluator, audit_, config.revision, config.budget, std::move(config.save)) {}

Result<bool, Problem> RequestExecutor::execute(const Request& request, const Person& by,
                                               Instant now) {
  auto done = std::visit(Execution{.executor = *this, .by = by, .now = now}, request);
  if (!done) ++refused_;
  return done;
}

void RequestExecutor::steer(const telemetry::JoystickSample& sample, const Person& by,
                            Instant now) {
  radio_.joystick().sample(sample, now);
  if (!steered_) audit_.add(now, by.name, "joystick", "in use");
  steered_ = now;
  steered_by_ = by.name;
}

void RequestExecutor::advance(Instant now) {
  authority_.advance(now);
  queue_.follow(vehicle_, radio_, now);
  if (!steered_ || now - *steered_ <= telemetry::kJoystickDead) return;
  steered_.reset();
  audit_.add(now, steered_by_, "joystick", "no longer in use");
}

void RequestExecutor::refuse(const Person& by, std::string what, const std::string& why,
                             Instant now) {
  ++refused_;
  audit_.add(now, by.name, std::move(what), "refused: " + why);
}

void RequestExecutor::restore(const OperatorEntries& entries) {
  const std::uint64_t revision = entries_.revision;
  entries_ = entries;
  entries_.revision = revision + 1;
}

void RequestExecutor::relay_flag(double flag) {
  double& known = entries_.expected.track_flag;
  if (flag == known || (std::isnan(flag) && std::isnan(known))) return;
  known = flag;
  evaluator_.expect(entries_.expected);
}

}  // namespace pitwall::command
