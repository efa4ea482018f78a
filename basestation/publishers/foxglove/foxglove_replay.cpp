// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/foxglove/foxglove_replay.hpp"

#include <utility>

namespace pitwall::publishers::foxglove {
namespace {

PlaybackStatus status_of(const replay::Player& player) {
  if (player.ended() && player.speed() > 0.0) return PlaybackStatus::kEnded;
  return player.speed() == 0.0 ? PlaybackStatus::kPaused : PlaybackStatus::kPlaying;
}

}  // namespace

Result<std::unique_ptr<FoxgloveReplay>, Problem> FoxgloveReplay::start(
    ServerConfig config, const replay::Player& player) {
  config.clock = player.clock();
  config.playback = TimeRange{UtcTime{player.clock().to_file(player.begin()).ns},
                              UtcTime{player.clock().to_file(player.end()).ns}};
  auto server = FoxgloveServer::start(std::move(config));
  if (!server) return Unexpected{server.error()};
  return std::unique_ptr<FoxgloveReplay>{new FoxgloveReplay{*std::move(server)}};
}

void FoxgloveReplay::state(const telemetry::Snapshot& state, telemetry::GroupSet groups,
                           Instant received) {
  server_->take(feed::Sample{.state = state, .groups = groups, .received = received});
}

void FoxgloveReplay::text(recorder::Topic topic, Instant at, std::string_view json) {
  server_->take(feed::Reported{.topic = topic, .at = at, .json = std::string{json}});
}

void FoxgloveReplay::restart(Instant to) {
  server_->forget(to);
  jumped_ = true;
}

void FoxgloveReplay::serve(const replay::Player& player, const PlaybackHandler& control_playback,
                           Instant now) {
  for (const PlaybackControl& ask : server_->receive()) {
    std::optional<Instant> to;
    if (ask.seek) to = player.clock().to_base(Instant{ask.seek->ns});
    control_playback(ask.play ? static_cast<double>(ask.speed) : 0.0, to);
    publish(player, ask.request, now);
  }
  if (status_ != status_of(player) || jumped_ || now - reported_ >= kPublishPeriod)
    publish(player, {}, now);
  server_->turn(now, player.now());
}

void FoxgloveReplay::publish(const replay::Player& player, const std::string& request,
                             Instant now) {
  if (player.speed() != 0.0) speed_ = player.speed();
  reported_ = now;
  status_ = status_of(player);
  server_->playback({.status = *status_,
                     .at = server_->utc(player.now()),
                     .speed = static_cast<float>(speed_),
                     .did_seek = std::exchange(jumped_, false),
                     .request = request});
}

}  // namespace pitwall::publishers::foxglove
