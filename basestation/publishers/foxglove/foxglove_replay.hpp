// Foxglove publisher of a replay: a FoxgloveServer whose client controls the playback.
//   in     states and texts of a recording; the state of its playback
//   out    messages to clients; the speed and the time that a client
//          requests, through PlaybackHandler
//   invariants
//          every client and every console shows the same moment
//          the playback state is sent when it changed, once a second, and as the answer to each
//          request
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "basestation/publishers/foxglove/foxglove_server.hpp"
#include "basestation/replay/listener.hpp"
#include "basestation/replay/player.hpp"

namespace pitwall::publishers::foxglove {

class FoxgloveReplay : public replay::Listener {
 public:
  // Sets the speed and jumps to the time, if one is given; takes effect before it returns.
  using PlaybackHandler = std::function<void(double speed, std::optional<Instant> to)>;

  static Result<std::unique_ptr<FoxgloveReplay>, Problem> start(ServerConfig config,
                                                                const replay::Player& player);

  UdpAddress local() const { return server_->local(); }
  service::PublisherFigures figures() const { return server_->figures(); }
  void state(const telemetry::Snapshot& state, telemetry::GroupSet groups,
             Instant received) override;
  void text(recorder::Topic topic, Instant at, std::string_view json) override;
  void restart(Instant to) override;

  void serve(const replay::Player& player, const PlaybackHandler& control_playback, Instant now);

 private:
  static constexpr Duration kPublishPeriod = seconds(1);

  explicit FoxgloveReplay(std::unique_ptr<FoxgloveServer> server) : server_(std::move(server)) {}
  void publish(const replay::Player& player, const std::string& request, Instant now);

  std::unique_ptr<FoxgloveServer> server_;
  Instant reported_{};
  std::optional<PlaybackStatus> status_;
  double speed_ = 1.0;  // the newest that was not a pause
  bool jumped_ = false;
};

}  // namespace pitwall::publishers::foxglove
