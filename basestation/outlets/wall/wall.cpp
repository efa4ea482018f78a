// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/wall/wall.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include "basestation/outlets/wall/catalogue_text.hpp"
#include "basestation/outlets/wall/wall_texts.hpp"
#include "protocol/transport/clock.hpp"

namespace pitwall::outlets::wall {
namespace {

using telemetry::field;

constexpr Unexpected<Problem> refused(std::string place, std::string what) {
  return Unexpected{Problem{std::move(place), std::move(what)}};
}

const char* mode_of(intake::Station::Source source) {
  switch (source) {
    case intake::Station::Source::kNone:
      return "NONE";
    case intake::Station::Source::kSimulation:
      return "HIL";
    case intake::Station::Source::kCar:
      return "REAL";
  }
  return "NONE";
}

}  // namespace

Wall::Wall(WallConfig config, intake::Station& station, web::WebServer& server)
    : config_(std::move(config)),
      server_(server),
      watch_(config_.watch),
      talk_(station.endpoint().authority(), audit_),
      desk_(config_.gates, audit_),
      room_(catalogue_text([this](picture::FieldId id) -> const picture::Limit& {
        return watch_.limits().of(id);
      })) {}

void Wall::packet(const intake::Station& station, const telemetry::Arrival& arrival) {
  const telemetry::Snapshot& state = station.endpoint().state();
  watch_.advance(picture_, arrival.received);
  watch_.heard(arrival.received);
  picture_.update(state, arrival.groups);
  trends_.note(state, arrival.groups);
  meter_.packet(arrival.groups, arrival.received);
  room_.heard();
}

void Wall::remember(const telemetry::Snapshot& state, telemetry::GroupSet groups) {
  picture_.update(state, groups);
  trends_.note(state, groups);
}

Instant Wall::due() const { return std::min(room_.due(), measured_ + kLinkEvery); }

void Wall::serve(intake::Station& station, Instant now) {
  hear(station, now);
  if (now - measured_ >= kLinkEvery) measure(station, now);
  watch_.advance(picture_, now);
  talk_.advance(now);
  desk_.follow(picture_, station.endpoint(), now);
  tell(station, now);
  room_.serve(*this, transport::utc_now(), now);
  for (Sending& sending : room_.take()) server_.send(sending.to, std::move(sending.message));
}

void Wall::hear(intake::Station& station, Instant now) {
  while (const auto news = server_.next_news()) {
    switch (news->kind) {
      case web::ClientNews::Kind::kJoined:
        room_.joined(news->client, news->who, now);
        break;
      case web::ClientNews::Kind::kLeft:
        talk_.left(room_.person(news->client), now);
        room_.left(news->client);
        break;
      case web::ClientNews::Kind::kSaid:
        if (const auto request = room_.said(news->client, news->text, *this, now)) {
          do_now(station, news->client, *request, now);
        }
        break;
      case web::ClientNews::Kind::kBinary:
        room_.said_binary(news->client);
        break;
    }
  }
}

command::GateInputs Wall::gate_inputs(Instant now) const {
  return {.picture = picture_, .watch = watch_, .holder = talk_.holder(now), .now = now};
}

std::optional<command::Override> Wall::override_of(const AskSend& ask) const {
  if (!ask.overrides) return std::nullopt;
  command::Override overriding;
  overriding.reason = ask.reason;
  // A second person is known by a token of an operator; nobody else is one.
  const auto who = config_.tokens.find(ask.token);
  if (who && who->role == web::Role::kOperator) overriding.second.name = who->name;
  return overriding;
}

using Done = Result<bool, Problem>;

struct Wall::Doing {
  Wall& wall;
  intake::Station& station;
  command::Person by;
  Instant now;

  telemetry::StationEndpoint& radio() const { return station.endpoint(); }
  bool holds() const { return wall.talk_.holder(now) == by.console; }
  alarms::Engine& alarms() const {
    wall.watch_.advance(wall.picture_, now);
    return wall.watch_.alarms();
  }

  Done operator()(const AskHistory&) const { return true; }  // the room's own
  Done operator()(const AskPing&) const { return true; }
  Done operator()(const AskMark& ask) const {
    wall.room_.tell_line("mark", mark_text(ask.text, by.name, now), now);
    return true;
  }
  Done operator()(const AskAcknowledge& ask) const {
    Done done = true;
    for (const std::uint32_t id : ask.alarms) {
      auto one = alarms().acknowledge(id, by.name, now);
      if (!one) done = std::move(one);
    }
    return done;
  }
  Done operator()(const AskShelve& ask) const {
    constexpr double kSecondsPerMinute = 60.0;
    return alarms().shelve(ask.alarm, from_seconds(ask.minutes * kSecondsPerMinute), by.name,
                           ask.reason, now);
  }
  Done operator()(const AskUnshelve& ask) const {
    return alarms().unshelve(ask.alarm, by.name, now);
  }
  Done operator()(const AskReset& ask) const { return alarms().reset(ask.alarm, by.name, now); }
  Done operator()(const AskStop& ask) const {
    wall.desk_.stop(ask.level, telemetry::StopReason::kOperator, by, now, radio());
    return true;
  }
  Done operator()(const AskReleaseStop&) const {
    if (!holds()) return refused("release_stop", "you do not hold the authority");
    const double challenge = radio().state().values[field("mode.stop_challenge")];
    if (!(challenge > 0.0)) return refused("release_stop", "the car says of no latched stop");
    const auto ticket = wall.desk_.stage(by, telemetry::CommandType::kReleaseStop, challenge,
                                         wall.gate_inputs(now));
    if (!ticket) return Unexpected{ticket.error()};
    return wall.desk_.send(*ticket, by, std::nullopt, wall.gate_inputs(now), radio());
  }
  Done operator()(const AskAuthority& ask) const {
    switch (ask.claim) {
      case Claim::kTake:
        return wall.talk_.take(by, now);
      case Claim::kRenew:
        return wall.talk_.renew(by, now);
      case Claim::kDrop:
        return wall.talk_.drop(by, now);
      case Claim::kRequest:
        return wall.talk_.request(by, now);
      case Claim::kGrant:
        return wall.talk_.grant(by, now);
      case Claim::kRefuse:
        return wall.talk_.refuse(by, now);
    }
    return true;
  }
  Done operator()(const AskStage& ask) const {
    for (const telemetry::CommandRow& row : telemetry::kCommandTable) {
      if (row.name != ask.name) continue;
      const auto ticket = wall.desk_.stage(by, row.type, ask.argument, wall.gate_inputs(now));
      return ticket ? Done{true} : Done{Unexpected{ticket.error()}};
    }
    return refused("stage.name", "no such command");
  }
  Done operator()(const AskSend& ask) const {
    return wall.desk_.send(ask.ticket, by, wall.override_of(ask), wall.gate_inputs(now), radio());
  }
  Done operator()(const AskCancel& ask) const { return wall.desk_.cancel(ask.ticket, by, now); }
  Done operator()(const AskPlayback&) const { return refused("playback", "this is no replay"); }
  Done operator()(const AskNotice& ask) const {
    alarms::Notices& notices = wall.watch_.notices();
    return ask.send ? notices.send(ask.id, by.name) : notices.dismiss(ask.id, by.name);
  }
};

void Wall::do_now(intake::Station& station, web::ClientId client, const Request& request,
                  Instant now) {
  const auto done = std::visit(
      Doing{.wall = *this, .station = station, .by = room_.person(client), .now = now}, request);
  if (!done) room_.tell_error(client, done.error());
}

void Wall::measure(intake::Station& station, Instant now) {
  measured_ = now;
  const telemetry::LinkReport report = station.report(now);
  meter_.note(count_of(report, station.rate().packets(), station.lost_packets()), now);
  const telemetry::PathFigures& heard = report.paths[0].heard;
  const picture::FieldView up_loss = picture_.view(field("radio.loss_0"), now);
  picture::LinkFigures figures;
  if (station.rate().ever()) figures.heard = now - station.rate().since_last(now);
  figures.loss_1s = meter_.loss(seconds(1));
  figures.down_loss = meter_.loss(seconds(5));
  figures.loss_30s = meter_.loss(seconds(30));
  if (up_loss.quality <= picture::Quality::kLate) figures.up_loss = up_loss.value;
  if (report.round_trip) figures.round_trip_ms = report.round_trip->milliseconds();
  figures.jitter_ms = heard.jitter.milliseconds();
  figures.packets_hz = station.rate().rate_hz(now);
  constexpr double kBytesPerKbit = 125.0;
  figures.down_kbit_s = 0.0;
  figures.up_kbit_s = 0.0;
  for (std::size_t path = 0; path < station.paths(); ++path) {
    figures.down_kbit_s += report.paths[path].heard.rate_bytes_per_s / kBytesPerKbit;
    figures.up_kbit_s += meter_.path(path, seconds(5)).up_kbit_s;
  }
  watch_.advance(picture_, now);
  watch_.link(figures);
  picture::BaseFigures base;
  base.authority_lost = talk_.lost();
  base.schema_differs = report.established && !station.endpoint().schema_agrees();
  watch_.base(base);

  std::array<double, picture::kBaseFields> values{};
  for (const picture::BaseRow& row : picture::kBaseTable) {
    const picture::FieldView seen = watch_.view(picture_, picture::id_of(row.field), now);
    const bool old = seen.quality >= picture::Quality::kStale;
    values[picture::index_of(row.field)] = old ? kUnset : seen.value;
  }
  own_trends_.note(now, values);
  if (now - told_link_ < kTellLinkEvery) return;
  told_link_ = now;
  room_.tell_state("link",
                   link_text({.report = report,
                              .meter = meter_,
                              .picture = picture_,
                              .state = watch_.link_state(),
                              .since = watch_.link_since(),
                              .paths = station.paths(),
                              .up_cap_kbit_s = config_.up_cap_kbit_s},
                             now),
                   now);
}

void Wall::tell(intake::Station& station, Instant now) {
  room_.identify({.car = config_.car,
                  .name = config_.name,
                  .mode = mode_of(station.source()),
                  .alarm_config = watch_.alarms().settings().version_text()},
                 now);
  tell_alarms(now);
  tell_desk(station, now);
  tell_events(station, now);
  std::string fuel = fuel_text(watch_.fuel());
  if (fuel != fuel_told_) {
    fuel_told_ = fuel;
    room_.tell_state("fuel", std::move(fuel), now);
  }
  states_told_ = true;
}

void Wall::tell_alarms(Instant now) {
  const alarms::Engine& engine = watch_.alarms();
  if (!states_told_ || engine.revision() != alarms_told_) {
    alarms_told_ = engine.revision();
    room_.tell_state("alarms", alarms_text(engine), now);
  }
  for (const alarms::AlarmEvent& event : engine.history()) {
    if (event.number <= alarm_events_told_) continue;
    alarm_events_told_ = event.number;
    room_.tell_line("alarm_event", alarm_event_text(event), now);
  }
  if (watch_.notices().revision() == notices_told_) return;
  notices_told_ = watch_.notices().revision();
  for (const alarms::Notice& notice : watch_.notices().all()) {
    if (std::ranges::find(notices_said_, notice) != notices_said_.end()) continue;
    room_.tell_line("notice", notice_text(notice), now);
  }
  notices_said_.assign(watch_.notices().all().begin(), watch_.notices().all().end());
}

void Wall::tell_desk(intake::Station& station, Instant now) {
  const bool renewed = talk_.holder(now) != 0 && now - authority_said_ >= seconds(1);
  if (!states_told_ || talk_.revision() != authority_told_ || renewed) {
    authority_told_ = talk_.revision();
    authority_said_ = now;
    room_.tell_state("authority", authority_text(talk_, station.endpoint().authority(), now), now);
  }
  for (const command::Ticket& ticket : desk_.take_changed()) {
    room_.tell_line("command", ticket_text(ticket), now);
  }
  for (const command::AuditLine& line : audit_.lines()) {
    if (line.number <= audit_told_) continue;
    audit_told_ = line.number;
    room_.tell_line("audit", audit_text(line), now);
  }
}

void Wall::tell_events(intake::Station& station, Instant now) {
  const auto& events = station.events();
  const std::uint64_t heard = station.events_heard();
  const std::uint64_t fresh = std::min<std::uint64_t>(heard - events_told_, events.size());
  for (std::size_t i = events.size() - fresh; i < events.size(); ++i) {
    room_.tell_line("event", event_text(events[i]), now);
  }
  events_told_ = heard;
}

picture::FieldView Wall::view(picture::FieldId id, Instant now) const {
  return watch_.view(picture_, id, now);
}

picture::Judgement Wall::judge(picture::FieldId id, const picture::FieldView& v) const {
  return watch_.judge(id, v);
}

std::vector<picture::TrendPoint> Wall::past(picture::FieldId id, Instant from, Instant to,
                                            std::size_t points) const {
  if (!picture::is_base(id)) return trends_.range(id, from, to, points);
  return own_trends_.range(picture::index_of(picture::base_field(id)), from, to, points,
                           picture::kBasePeriod);
}

}  // namespace pitwall::outlets::wall
