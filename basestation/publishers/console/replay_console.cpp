// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/console/replay_console.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include "basestation/publishers/console/catalogue_text.hpp"
#include "basestation/service/messages/evaluator_text.hpp"
#include "basestation/service/messages/lap_text.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"

namespace pitwall::publishers::console {
namespace {

constexpr Duration kTurn = milliseconds(40);  // 25 pictures a second at most

}  // namespace

ReplayConsole::ReplayConsole(service::ServiceConfig config, replay::Player player,
                             service::RecordingIndex index, web::WebServer& server)
    : config_(std::move(config)),
      player_(std::move(player)),
      index_(std::move(index)),
      server_(server),
      clients_(catalogue_text(
                   [this](state::FieldId id) -> const alarms::Limit& {
                     return config_.evaluator.limits.of(id);
                   },
                   config_.evaluator.derive.fuel.attempt_laps),
               messages_) {
  messages_.subscribe([this](std::string_view, std::string_view text, Instant) {
    clients_.send_to_all(std::string{text});
  });
  if (laps() != nullptr) messages_.set_state("laps", service::laps_text(*laps()), player_.begin());
  restart(player_.begin());
  jumps_ = 0;
  clients_.identify(
      {.car = config_.car, .name = config_.name, .mode = "REPLAY", .alarm_config = {}},
      player_.now());
}

void ReplayConsole::serve(Duration passed) {
  receive();
  player_.advance(passed, *this);
  evaluator_->advance(vehicle_, player_.now());
  publish(passed);
  clients_.serve(*this, UtcTime{player_.clock().to_file(player_.now()).ns}, player_.now());
  for (Sending& sending : clients_.take()) server_.send(sending.to, std::move(sending.message));
}

void ReplayConsole::receive() {
  while (const auto news = server_.next_event()) {
    switch (news->kind) {
      case web::ClientEvent::Kind::kJoined:
        clients_.joined(news->client, news->who, player_.now());
        break;
      case web::ClientEvent::Kind::kLeft:
        clients_.left(news->client);
        break;
      case web::ClientEvent::Kind::kText:
        if (const auto request =
                clients_.receive_text(news->client, news->text, *this, player_.now())) {
          execute(news->client, *request);
        }
        break;
      case web::ClientEvent::Kind::kBinary:
        clients_.receive_binary(news->client);
        break;
      case web::ClientEvent::Kind::kPage:
        server_.answer(news->request, web::refusal(404, "a replay has no bench server"));
        break;
    }
  }
}

void ReplayConsole::execute(web::ClientId client, const Request& request) {
  const auto* const ask = std::get_if<AskPlayback>(&request);
  if (ask == nullptr)
    return clients_.send_error(client, {"replay", "a recording takes no commands"});
  std::optional<Instant> to;
  if (ask->to_ms) to = Instant{static_cast<std::int64_t>(*ask->to_ms * kNanosecondsPerMillisecond)};
  control_playback(ask->speed.value_or(player_.speed()), to);
}

void ReplayConsole::control_playback(double speed, std::optional<Instant> to) {
  player_.set_speed(speed);
  if (to) player_.jump(*to, *this);
  unreported_ = kPublishPeriod;
}

void ReplayConsole::publish(Duration passed) {
  unreported_ = unreported_ + passed;
  if (unreported_ < kPublishPeriod) return;
  unreported_ = {};
  messages_.set_state("playback", playback_text(), player_.now());
}

std::string ReplayConsole::playback_text() const {
  return json::Object{}
      .text("type", "playback")
      .number("begin_ms", player_.begin().milliseconds())
      .number("end_ms", player_.end().milliseconds())
      .number("now_ms", player_.now().milliseconds())
      .number("speed", player_.ended() && player_.speed() > 0.0 ? 0.0 : player_.speed())
      .number("jumps", jumps_)
      .str();
}

state::FieldView ReplayConsole::view(state::FieldId id, Instant now) const {
  return evaluator_->view(vehicle_, id, now);
}

alarms::Evaluation ReplayConsole::evaluate(state::FieldId id, const state::FieldView& v) const {
  return evaluator_->evaluate(id, v);
}

std::vector<state::TrendPoint> ReplayConsole::past(state::FieldId id, Instant from, Instant to,
                                                   std::size_t points) const {
  if (state::is_base(id)) return {};
  return index_.trends().range(id, from, to, points);
}

void ReplayConsole::state(const telemetry::Snapshot& state, telemetry::GroupSet groups,
                          Instant received) {
  for (replay::Listener* const other : others_) other->state(state, groups, received);
  settings_pending_ = false;
  evaluator_->advance(vehicle_, received);
  evaluator_->receive(received);
  vehicle_.update(state, groups);
  received_ = received;
  clients_.receive();
}

void ReplayConsole::text(recorder::Topic topic, Instant at, std::string_view json) {
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
      return apply_judge_input(at, json);
    case kAlarms:
    case kAuthority:
    case kLink:
    case kFuel:
    case kExpected:
    case kSettings:
      return messages_.set_state(type, std::string{json}, at);
    default:
      return messages_.add_line(type, std::string{json}, at);
  }
}

// With the limits that were in force then, on the course that is known now.
void ReplayConsole::settle(std::string_view json) {
  auto settings = service::read_judge_text(json);
  // A change within a process comes as an input besides, and forgets nothing.
  if (!settings || !(settings->begins || settings_pending_)) return;
  settings_pending_ = false;
  settings->config.course = config_.evaluator.course;
  evaluator_.emplace(std::move(settings->config));
}

void ReplayConsole::apply_judge_input(Instant at, std::string_view json) {
  const auto input = service::read_input_text(json, at);
  if (!input) return;
  evaluator_->advance(vehicle_, at);
  static_cast<void>(evaluator_->take(*input));
}

void ReplayConsole::restart(Instant to) {
  for (replay::Listener* const other : others_) other->restart(to);
  vehicle_ = {};
  evaluator_.emplace(config_.evaluator);
  settings_pending_ = true;
  received_.reset();
  messages_.clear("laps");
  clients_.want_full();
  ++jumps_;
  // Before anything is told anew: who hears of the jump afterwards would forget that, too.
  messages_.set_state("playback", playback_text(), to);
}

void run_replay(ReplayConsole& console, int server, int stop, Duration duration,
                const std::function<void(Instant now)>& also) {
  const Instant begun = transport::monotonic_now();
  const std::array<int, 2> watched{stop, server};
  for (Instant last = begun;;) {
    const std::uint32_t ready = transport::wait_readable(watched, last + kTurn);
    const Instant now = transport::monotonic_now();
    console.serve(now - last);
    if (also) also(now);
    last = now;
    if ((ready & 1U) != 0 || (duration.ns > 0 && now >= begun + duration)) return;
  }
}

}  // namespace pitwall::publishers::console
