// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/wall/wall.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include "basestation/outlets/wall/catalogue_text.hpp"
#include "basestation/outlets/wall/checklist_text.hpp"
#include "basestation/outlets/wall/errands.hpp"
#include "basestation/outlets/wall/settings_text.hpp"
#include "basestation/outlets/wall/wall_texts.hpp"
#include "protocol/telemetry/packet/header.hpp"
#include "protocol/transport/clock.hpp"

namespace pitwall::outlets::wall {
namespace {

using telemetry::field;

constexpr double kNotRecording = 0.0;  // of picture::kRecordingStates
constexpr std::array kBudgetUse{field("radio.budget_use_0"), field("radio.budget_use_1")};

command::SettingsDesk::Save saver_of(const std::shared_ptr<JudgementStore>& store) {
  if (!store) return {};
  return [store](const command::SettingsDesk::Wanted& wanted) { return store->save(wanted); };
}

}  // namespace

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

void use_judgement(WallConfig& config, std::shared_ptr<JudgementStore> store,
                   double up_cap_kbit_s) {
  const settings::Judgement& judged = store->judgement();
  config.revision = judged.revision;
  config.up_kbit_s = std::min(judged.up_kbit_s, up_cap_kbit_s);  // unset stays unset
  config.watch = judged;
  config.store = std::move(store);
}

Wall::Wall(WallConfig config, intake::Station& station, web::WebServer& server)
    : config_(std::move(config)),
      server_(server),
      watch_(config_.watch),
      talk_(station.endpoint().authority(), audit_),
      desk_(config_.gates, audit_),
      settings_(watch_, audit_, config_.revision,
                {.most = config_.up_cap_kbit_s,
                 .now = std::isnan(config_.up_kbit_s) ? config_.up_cap_kbit_s : config_.up_kbit_s},
                saver_of(config_.store)),
      room_(catalogue()) {
  if (const auto problem = settings_problem()) {
    audit_.add(transport::monotonic_now(), "base", unreadable_text(*problem), "not read");
  }
}

std::optional<Problem> Wall::settings_problem() const {
  return config_.store ? config_.store->unreadable() : std::nullopt;
}

std::string Wall::catalogue() const {
  return catalogue_text(
      [this](picture::FieldId id) -> const picture::Limit& { return watch_.limits().of(id); },
      watch_.params().fuel.attempt_laps);
}

void Wall::packet(const intake::Station& station, const telemetry::Arrival& arrival) {
  const telemetry::Snapshot& state = station.endpoint().state();
  watch_.advance(picture_, arrival.received);
  if (arrival.groups.count() == 0) {
    static_cast<void>(watch_.take(picture::Heard{arrival.received}));
  } else {
    watch_.heard(arrival.received);
  }
  picture_.update(state, arrival.groups);
  trends_.note(state, arrival.groups);
  meter_.packet(arrival.groups, arrival.received);
  room_.heard();
}

void Wall::remember(const telemetry::Snapshot& state, telemetry::GroupSet groups) {
  picture_.update(state, groups);
  trends_.note(state, groups);
}

void Wall::recall(const Recalled& recalled, Instant now) {
  said_ = recalled.said;
  ++said_.revision;
  picture::Expectations known = said_.expected;
  known.fuel_loaded_l = recalled.fuel_left_l;  // the rest is burnt
  watch_.advance(picture_, now);
  watch_.expect(known);
}

Instant Wall::due() const { return std::min(room_.due(), measured_ + kLinkEvery); }

void Wall::serve(intake::Station& station, Instant now) {
  hear(station, now);
  watch_.advance(picture_, now);
  const bool news = watch_.link_state() != link_told_;
  if (news || now - measured_ >= kLinkEvery) measure(station, now);
  if (news) room_.heard();
  talk_.advance(now);
  set_budget(station);
  desk_.follow(picture_, station.endpoint(), now);
  tell(station, now);
  if (auto text = pauses_.news(transport::bench_pause(), now))
    room_.tell_state("bench_time", *std::move(text), now);
  room_.serve(*this, transport::utc_now(), now);
  for (Sending& sending : room_.take()) server_.send(sending.to, std::move(sending.message));
}

void Wall::hear(intake::Station& station, Instant now) {
  while (const auto news = server_.next_news(config_.place)) {
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

void Wall::do_now(intake::Station& station, web::ClientId client, const Request& request,
                  Instant now) {
  const ErrandParts parts{.picture = picture_,
                          .watch = watch_,
                          .audit = audit_,
                          .talk = talk_,
                          .desk = desk_,
                          .settings = settings_,
                          .said = said_,
                          .room = room_,
                          .tokens = config_.tokens,
                          .bench = bench_};
  const auto done = carry_out(request, parts, station, room_.person(client), now);
  if (!done) room_.tell_error(client, done.error());
}

void Wall::attach(bench::BenchLink& bench) {
  bench_ = &bench;
  bench.tell_to({.tell =
                     [this](const bench::Told& told, Instant now) {
                       if (told.line) return room_.tell_line(told.type, told.text, now);
                       room_.tell_state(told.type, told.text, now);
                     },
                 .refused =
                     [this](std::uint8_t client, const Problem& problem, Instant now) {
                       audit_.add(now, room_.person(client).name, "bench",
                                  "refused: " + problem.what);
                       room_.tell_error(client, problem);
                     }});
}

void Wall::measure(intake::Station& station, Instant now) {
  measured_ = now;
  const telemetry::LinkReport report = station.report(now);
  meter_.note(count_of(report, station.rate().packets(), station.lost_packets()), now,
              report.round_trip ? report.round_trip->milliseconds() : kUnset);
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
  figures.threats = report.threats.bits;
  constexpr double kBytesPerKbit = 125.0;
  figures.down_kbit_s = 0.0;
  figures.up_kbit_s = 0.0;
  figures.down_cap_kbit_s = 0.0;
  const double overhead_kbit_s =  // the car's budget counts IP and UDP, the link's figures do not
      figures.packets_hz * telemetry::kIpUdpOverhead / kBytesPerKbit;
  for (std::size_t path = 0; path < station.paths(); ++path) {
    const telemetry::PathFigures& down = report.paths[path].heard;
    const double down_kbit_s = down.rate_bytes_per_s / kBytesPerKbit;
    const picture::FieldView use = picture_.view(kBudgetUse[path], now);
    if (picture::usable(use)) {
      meter_.note_use(path, (down_kbit_s + overhead_kbit_s) / (1.0 - down.loss), use.value);
    }
    figures.down_kbit_s += down_kbit_s;
    figures.down_cap_kbit_s += meter_.down_cap_kbit_s(path);
    figures.up_kbit_s += meter_.path(path, seconds(5)).up_kbit_s;
  }
  watch_.advance(picture_, now);
  watch_.link(figures);
  watch_.base(own_figures(station, report, now));
  relay_flag(station);

  std::array<double, picture::kBaseFields> values{};
  for (const picture::BaseRow& row : picture::kBaseTable) {
    const picture::FieldView seen = watch_.view(picture_, picture::id_of(row.field), now);
    const bool old = seen.quality >= picture::Quality::kStale;
    values[picture::index_of(row.field)] = old ? kUnset : seen.value;
  }
  own_trends_.note(now, values);
  if (watch_.link_state() == link_told_ && now - told_link_ < kTellLinkEvery) return;
  told_link_ = now;
  link_told_ = watch_.link_state();
  room_.tell_state("link",
                   link_text({.report = report,
                              .meter = meter_,
                              .picture = picture_,
                              .state = watch_.link_state(),
                              .since = watch_.link_since(),
                              .paths = station.paths(),
                              .up_cap_kbit_s = settings_.budget().now},
                             now),
                   now);
}

picture::BaseFigures Wall::own_figures(const intake::Station& station,
                                       const telemetry::LinkReport& report, Instant now) const {
  picture::BaseFigures base;
  base.authority_lost = talk_.lost();
  base.schema_differs = report.established && !station.endpoint().schema_agrees();
  base.settings_unreadable = settings_problem().has_value();
  base.joystick_lost = joystick_ && joystick_(now) == command::JoystickState::kLost;
  if (const auto error = transport::utc_error()) base.clock_offset_ms = error->milliseconds();
  base.recording = kNotRecording;
  if (recorder_figures_) recorder_figures_(base, now);
  return base;
}

// The flag that the car has taken from us, for conflicts with race control's.
void Wall::relay_flag(const intake::Station& station) {
  const auto* const flag = station.endpoint().newest(telemetry::CommandType::kTrackFlag);
  if (flag == nullptr || flag->fate != telemetry::Outcome::kApplied) return;
  const double relayed = flag->command.argument > 0.0 ? flag->command.argument : kUnset;
  double& known = said_.expected.track_flag;
  if (relayed == known || (std::isnan(relayed) && std::isnan(known))) return;
  known = relayed;
  watch_.expect(said_.expected);
}

void Wall::set_budget(intake::Station& station) {
  const command::UpBudget& budget = settings_.budget();
  if (std::isnan(budget.now) || budget.now == budget_set_) return;
  budget_set_ = budget.now;
  station.endpoint().set_budget_share(budget.now / budget.most);
}

void Wall::tell(intake::Station& station, Instant now) {
  room_.identify({.car = config_.car,
                  .name = config_.name,
                  .mode = mode_of(station.source()),
                  .alarm_config = settings_version()},
                 now);
  tell_alarms(now);
  tell_desk(station, now);
  tell_events(station, now);
  std::string fuel = fuel_text(watch_.fuel());
  if (fuel != fuel_told_) {
    fuel_told_ = fuel;
    room_.tell_state("fuel", std::move(fuel), now);
  }
  tell_settings(now);
  tell_checks(now);
  states_told_ = true;
}

std::string Wall::settings_version() const {
  return std::to_string(settings_.revision()) + "-" + watch_.alarms().settings().version_text();
}

void Wall::tell_checks(Instant now) {
  if (states_told_ && now - told_checks_ < kTellChecksEvery) return;
  told_checks_ = now;
  const auto checks =
      command::checks_of({.picture = picture_,
                          .watch = watch_,
                          .holder = talk_.holder(now),
                          .holder_name = talk_.holder_person().name,
                          .settings = {.version = settings_version(),
                                       .kept = settings_.kept(),
                                       .readable = !settings_problem()},
                          .joystick = joystick_ ? joystick_(now) : command::JoystickState::kNone,
                          .now = now});
  room_.tell_state("checklist", checklist_text(checks, now), now);
}

// Of what was filled in: as the judge was told where it has not reckoned with it yet.
double Wall::fuel_left_l(Instant now) const {
  const double level_l = watch_.fuel().level_l;
  const bool reckoned = now - said_.fuel_at >= seconds(1) && !std::isnan(level_l);
  return reckoned ? level_l : watch_.known().expected.fuel_loaded_l;
}

// Again and again what people said: so the newest part of a recording has it, and the fuel left.
void Wall::tell_settings(Instant now) {
  const bool again = said_.revision != 0 && now - said_at_ >= kTellSaidEvery;
  if (!states_told_ || said_.revision != said_told_ || again) {
    said_told_ = said_.revision;
    said_at_ = now;
    room_.tell_state("expected", expected_text(said_, fuel_left_l(now), now), now);
  }
  if (states_told_ && settings_.revision() == settings_told_) return;
  settings_told_ = settings_.revision();
  if (states_told_) room_.tell_catalogue(catalogue());
  room_.tell_state("settings",
                   settings_text(settings_, watch_.alarms().settings(), settings_problem()), now);
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
