// Foxglove publisher of a replay: a FoxgloveServer whose client controls the playback.
//   in     what a recording says; how its playback stands
//   out    messages to clients; asked(): speed and time that a client wants
//   invariants
//          every client and every console sees the same moment
//          a state of the playback is told when it changed, once a second, and as the answer to
//          each request
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
  // Speed, and the time to jump to, if any; does what it says before it returns.
  using Wind = std::function<void(double speed, std::optional<Instant> to)>;

  static Result<std::unique_ptr<FoxgloveReplay>, Problem> start(ServerConfig config,
                                                                const replay::Player& player);

  transport::UdpAddress local() const { return server_->local(); }
  service::PublisherFigures figures() const { return server_->figures(); }
  void state(const telemetry::Snapshot& state, telemetry::GroupSet groups,
             Instant received) override;
  void text(recorder::Topic topic, Instant at, std::string_view json) override;
  void restart(Instant to) override;

  void serve(const replay::Player& player, const Wind& wind, Instant now);

 private:
  static constexpr Duration kTellEvery = seconds(1);

  explicit FoxgloveReplay(std::unique_ptr<FoxgloveServer> server) : server_(std::move(server)) {}
  void publish(const replay::Player& player, const std::string& request, Instant now);

  std::unique_ptr<FoxgloveServer> server_;
  Instant reported_{};
  std::optional<PlaybackStatus> status_;
  double speed_ = 1.0;  // the newest that was no pause
  bool jumped_ = false;
};

}  // namespace pitwall::publishers::foxglove
