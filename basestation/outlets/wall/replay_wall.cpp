// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/wall/replay_wall.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include "basestation/outlets/wall/catalogue_text.hpp"
#include "basestation/outlets/wall/judge_text.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"

namespace pitwall::outlets::wall {
namespace {

constexpr Duration kTurn = milliseconds(40);  // 25 pictures a second at most

}  // namespace

ReplayWall::ReplayWall(WallConfig config, replay::Player player, web::WebServer& server)
    : config_(std::move(config)),
      player_(std::move(player)),
      server_(server),
      room_(catalogue_text([this](picture::FieldId id)
                               -> const picture::Limit& { return config_.watch.limits.of(id); },
                           config_.watch.derive.fuel.attempt_laps)) {
  restart(player_.begin());
  jumps_ = 0;
  room_.identify({.car = config_.car, .name = config_.name, .mode = "REPLAY", .alarm_config = {}},
                 player_.now());
}

void ReplayWall::serve(Duration passed) {
  hear();
  player_.advance(passed, *this);
  watch_->advance(picture_, player_.now());
  tell(passed);
  room_.serve(*this, UtcTime{player_.clock().to_file(player_.now()).ns}, player_.now());
  for (Sending& sending : room_.take()) server_.send(sending.to, std::move(sending.message));
}

void ReplayWall::hear() {
  while (const auto news = server_.next_news()) {
    switch (news->kind) {
      case web::ClientNews::Kind::kJoined:
        room_.joined(news->client, news->who, player_.now());
        break;
      case web::ClientNews::Kind::kLeft:
        room_.left(news->client);
        break;
      case web::ClientNews::Kind::kSaid:
        if (const auto request = room_.said(news->client, news->text, *this, player_.now())) {
          obey(news->client, *request);
        }
        break;
      case web::ClientNews::Kind::kBinary:
        room_.said_binary(news->client);
        break;
    }
  }
}

void ReplayWall::obey(web::ClientId client, const Request& request) {
  const auto* const ask = std::get_if<AskPlayback>(&request);
  if (ask == nullptr) return room_.tell_error(client, {"replay", "a recording takes no commands"});
  std::optional<Instant> to;
  if (ask->to_ms) to = Instant{static_cast<std::int64_t>(*ask->to_ms * kNanosecondsPerMillisecond)};
  wind(ask->speed.value_or(player_.speed()), to);
}

void ReplayWall::wind(double speed, std::optional<Instant> to) {
  player_.set_speed(speed);
  if (to) player_.jump(*to, *this);
  untold_ = kTellEvery;
}

void ReplayWall::tell(Duration passed) {
  untold_ = untold_ + passed;
  if (untold_ < kTellEvery) return;
  untold_ = {};
  room_.tell_state("playback", playback_text(), player_.now());
}

std::string ReplayWall::playback_text() const {
  return json::Object{}
      .text("type", "playback")
      .number("begin_ms", player_.begin().milliseconds())
      .number("end_ms", player_.end().milliseconds())
      .number("now_ms", player_.now().milliseconds())
      .number("speed", player_.ended() && player_.speed() > 0.0 ? 0.0 : player_.speed())
      .number("jumps", jumps_)
      .str();
}

picture::FieldView ReplayWall::view(picture::FieldId id, Instant now) const {
  return watch_->view(picture_, id, now);
}

picture::Judgement ReplayWall::judge(picture::FieldId id, const picture::FieldView& v) const {
  return watch_->judge(id, v);
}

std::vector<picture::TrendPoint> ReplayWall::past(picture::FieldId id, Instant from, Instant to,
                                                  std::size_t points) const {
  if (picture::is_base(id)) return {};
  return trends_->range(id, from, to, points);
}

void ReplayWall::state(const telemetry::Snapshot& state, telemetry::GroupSet groups,
                       Instant received) {
  for (replay::Listener* const other : others_) other->state(state, groups, received);
  unsettled_ = false;
  watch_->advance(picture_, received);
  watch_->heard(received);
  picture_.update(state, groups);
  trends_->note(state, groups);
  heard_ = received;
  room_.heard();
}

void ReplayWall::text(recorder::Topic topic, Instant at, std::string_view json) {
  using enum recorder::Topic;
  for (replay::Listener* const other : others_) other->text(topic, at, json);
  const std::string_view type = recorder::name_of(topic);
  switch (topic) {
    case kHello:  // the mode is REPLAY
    case kRecorder:
    case kJoystick:
      return;
    case kJudge:
      return settle(json);
    case kInput:
      return tell_judge(at, json);
    case kAlarms:
    case kAuthority:
    case kLink:
    case kFuel:
    case kExpected:
    case kSettings:
      return room_.tell_state(type, std::string{json}, at);
    default:
      return room_.tell_line(type, std::string{json}, at);
  }
}

// With the limits that were in force then, on the course that is known now.
void ReplayWall::settle(std::string_view json) {
  auto settings = read_judge_text(json);
  // A change within a process comes as an input besides, and forgets nothing.
  if (!settings || !(settings->begins || unsettled_)) return;
  unsettled_ = false;
  settings->config.course = config_.watch.course;
  watch_.emplace(std::move(settings->config));
}

void ReplayWall::tell_judge(Instant at, std::string_view json) {
  const auto input = read_input_text(json, at);
  if (!input) return;
  watch_->advance(picture_, at);
  static_cast<void>(watch_->take(*input));
}

void ReplayWall::restart(Instant to) {
  for (replay::Listener* const other : others_) other->restart(to);
  picture_ = {};
  trends_.emplace();
  watch_.emplace(config_.watch);
  unsettled_ = true;
  heard_.reset();
  room_.forget();
  ++jumps_;
  // Before anything is told anew: who hears of the jump afterwards would forget that, too.
  room_.tell_state("playback", playback_text(), to);
}

void run_replay(ReplayWall& wall, int server, int stop, Duration duration,
                const std::function<void(Instant now)>& also) {
  const Instant begun = transport::monotonic_now();
  const std::array<int, 2> watched{stop, server};
  for (Instant last = begun;;) {
    const std::uint32_t ready = transport::wait_readable(watched, last + kTurn);
    const Instant now = transport::monotonic_now();
    wall.serve(now - last);
    if (also) also(now);
    last = now;
    if ((ready & 1U) != 0 || (duration.ns > 0 && now >= begun + duration)) return;
  }
}

}  // namespace pitwall::outlets::wall
