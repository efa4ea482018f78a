// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/wall/errands.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <utility>
#include <variant>

#include "basestation/outlets/wall/wall_texts.hpp"

namespace pitwall::outlets::wall {
namespace {

using telemetry::field;
using Done = Result<bool, Problem>;

constexpr const char* kNotHolding = "you do not hold the authority";

std::string number(double value, const char* unit) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "%.1f %s", value, unit);
  return text.data();
}

using picture::AlarmAct;

struct Doing {
  const ErrandParts& wall;
  intake::Station& station;
  const command::Person& by;
  Instant now;

  telemetry::StationEndpoint& radio() const { return station.endpoint(); }
  bool holds() const { return wall.talk.holder(now) == by.console; }
  Done judge(const picture::WatchInput& input) const {
    wall.watch.advance(wall.picture, now);
    return wall.watch.take(input);
  }
  command::GateInputs gate_inputs() const {
    return {
        .picture = wall.picture, .watch = wall.watch, .holder = wall.talk.holder(now), .now = now};
  }
  std::optional<command::Override> override_of(const AskSend& ask) const {
    if (!ask.overrides) return std::nullopt;
    command::Override overriding;
    overriding.reason = ask.reason;
    // A second person is known by a token of an operator; nobody else is one.
    const auto who = wall.tokens.find(ask.token);
    if (who && who->role == web::Role::kOperator) overriding.second.name = who->name;
    return overriding;
  }
  // With its line in the audit log.
  Done say(const char* place, const std::string& what) const {
    if (!holds()) {
      wall.audit.add(now, by.name, what, std::string{"refused: "} + kNotHolding);
      return refuse(place, kNotHolding);
    }
    wall.audit.add(now, by.name, what, "done");
    return true;
  }
  void expect() const {
    ++wall.said.revision;
    wall.watch.advance(wall.picture, now);
    wall.watch.expect(wall.said.expected);
  }
  command::SettingsDesk::Said because(const std::string& reason) const {
    wall.watch.advance(wall.picture, now);
    return {.by = by, .holds_authority = holds(), .reason = reason, .at = now};
  }

  Done operator()(const AskHistory&) const { return true; }  // the room's own
  Done operator()(const AskPing&) const { return true; }
  Done operator()(const AskMark& ask) const {
    wall.room.tell_line("mark", mark_text(ask.text, by.name, now), now);
    return true;
  }
  Done operator()(const AskAcknowledge& ask) const {
    Done done = true;
    for (const std::uint32_t id : ask.alarms) {
      auto one = judge(
          AlarmAct{.kind = AlarmAct::Kind::kAcknowledge, .alarm = id, .by = by.name, .reason = {}});
      if (!one) done = std::move(one);
    }
    return done;
  }
  Done operator()(const AskShelve& ask) const {
    constexpr double kSecondsPerMinute = 60.0;
    return judge(AlarmAct{.kind = AlarmAct::Kind::kShelve,
                          .alarm = ask.alarm,
                          .length = from_seconds(ask.minutes * kSecondsPerMinute),
                          .by = by.name,
                          .reason = ask.reason});
  }
  Done operator()(const AskUnshelve& ask) const {
    return judge(AlarmAct{
        .kind = AlarmAct::Kind::kUnshelve, .alarm = ask.alarm, .by = by.name, .reason = {}});
  }
  Done operator()(const AskReset& ask) const {
    return judge(
        AlarmAct{.kind = AlarmAct::Kind::kReset, .alarm = ask.alarm, .by = by.name, .reason = {}});
  }
  Done operator()(const AskStop& ask) const {
    wall.desk.stop(ask.level, telemetry::StopReason::kOperator, by, now, radio());
    return true;
  }
  Done operator()(const AskReleaseStop&) const {
    if (!holds()) return refuse("release_stop", kNotHolding);
    const double challenge = radio().state().values[field("mode.stop_challenge")];
    if (!(challenge > 0.0)) return refuse("release_stop", "the car says of no latched stop");
    const auto ticket =
        wall.desk.stage(by, telemetry::CommandType::kReleaseStop, challenge, gate_inputs());
    if (!ticket) return Unexpected{ticket.error()};
    return wall.desk.send(*ticket, by, std::nullopt, gate_inputs(), radio());
  }
  Done operator()(const AskAuthority& ask) const {
    switch (ask.claim) {
      case Claim::kTake:
        return wall.talk.take(by, now);
      case Claim::kRenew:
        return wall.talk.renew(by, now);
      case Claim::kDrop:
        return wall.talk.drop(by, now);
      case Claim::kRequest:
        return wall.talk.request(by, now);
      case Claim::kGrant:
        return wall.talk.grant(by, now);
      case Claim::kRefuse:
        return wall.talk.refuse(by, now);
    }
    return true;
  }
  Done operator()(const AskStage& ask) const {
    for (const telemetry::CommandRow& row : telemetry::kCommandTable) {
      if (row.name != ask.name) continue;
      const auto ticket = wall.desk.stage(by, row.type, ask.argument, gate_inputs());
      return ticket ? Done{true} : Done{Unexpected{ticket.error()}};
    }
    return refuse("stage.name", "no such command");
  }
  Done operator()(const AskSend& ask) const {
    return wall.desk.send(ask.ticket, by, override_of(ask), gate_inputs(), radio());
  }
  Done operator()(const AskCancel& ask) const { return wall.desk.cancel(ask.ticket, by, now); }
  Done operator()(const AskPlayback&) const { return refuse("playback", "this is no replay"); }
  Done operator()(const AskNotice& ask) const {
    return judge(picture::NoticeAct{.notice = ask.id, .send = ask.send, .by = by.name});
  }
  Done operator()(const AskExpect& ask) const {
    const double speed_mps = ask.round_speed_mps.value_or(kUnset);
    auto said =
        say("expect", ask.round_speed_mps ? "round speed announced: " + number(speed_mps, "m/s")
                                          : "no round speed announced");
    if (!said) return said;
    wall.said.expected.round_speed_mps = speed_mps;
    wall.said.round_speed_by = by.name;
    expect();
    return said;
  }
  Done operator()(const AskFuelLoaded& ask) const {
    auto said = say("fuel_loaded", "fuel in the tank: " + number(ask.litres, "l"));
    if (!said) return said;
    wall.said.expected.fuel_loaded_l = ask.litres;
    ++wall.said.expected.fuel_entries;
    wall.said.fuel_by = by.name;
    wall.said.fuel_at = now;
    expect();
    return said;
  }
  Done operator()(const AskEditAlarm& ask) const {
    return wall.settings.change(because(ask.reason), ask.edit);
  }
  Done operator()(const AskEditLimit& ask) const {
    picture::LimitEdit edit = ask.edit;
    const picture::Limit& present = wall.watch.limits().of(edit.field);
    edit.limit.warning_values = ask.warning_values.value_or(present.warning_values);
    edit.limit.bad_values = ask.bad_values.value_or(present.bad_values);
    return wall.settings.change(because(ask.reason), std::move(edit));
  }
  Done operator()(const AskEditBudget& ask) const {
    return wall.settings.change_budget(because(ask.reason), ask.up_kbit_s);
  }
  // The bench is no car: it takes an operator, and no authority.
  Done operator()(const AskBench& ask) const {
    Done asked = wall.bench != nullptr
                     ? wall.bench->ask(ask.wish, by.console, by.name)
                     : Done{refuse("bench", "this base knows of no bench desk (--bench)")};
    wall.audit.add(now, by.name, text_of(ask.wish),
                   asked ? "sent" : "refused: " + asked.error().what);
    return asked;
  }
};

}  // namespace

Done carry_out(const Request& request, const ErrandParts& parts, intake::Station& station,
               const command::Person& by, Instant now) {
  return std::visit(Doing{.wall = parts, .station = station, .by = by, .now = now}, request);
}

}  // namespace pitwall::outlets::wall
