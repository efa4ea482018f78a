// Foxglove WebSocket server for use by one thread: sockets, clients and sources together.
//   in     states and messages of the car and the base; time
//   out    messages to clients; their playback requests
//   invariants
//          no call waits: the sockets have a thread and bounded queues of their own. Without
//          clients only latched messages and texts are encoded
//          a page of this machine may attach; a page from elsewhere only if its origin is in the
//          access rules
//   bound  for a client that does not read, kMessages messages and kMessageBytes wait; beyond that
//          the oldest are dropped
//   errors start(): Problem with the address
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "basestation/publishers/foxglove/client_registry.hpp"
#include "basestation/publishers/foxglove/sources.hpp"
#include "basestation/publishers/web/web_server.hpp"

namespace pitwall::publishers::foxglove {

struct ServerConfig {
  UdpAddress listen{};        // port 0: any that is free
  web::AccessRules access{};  // pages of this machine are admitted in any case
  std::shared_ptr<ssl_ctx_st> tls{};
  std::string name{};  // of the server, as clients show it
  std::optional<TimeRange> playback{};
  ros_view::ViewConfig view{};
  recorder::ClockMap clock{};
};

class FoxgloveServer {
 public:
  static constexpr std::size_t kMessages = 1'024, kMessageBytes = 4 * 1'024 * 1'024;
  static constexpr Duration kTimeEvery = milliseconds(100), kLossEvery = seconds(1);

  static Result<std::unique_ptr<FoxgloveServer>, Problem> start(ServerConfig config);

  UdpAddress local() const { return server_->local(); }
  int fd() const { return server_->fd(); }  // readable while messages of clients wait
  std::vector<PlaybackControl> receive();
  void take(const feed::Item& item);
  void take(const feed::Sample& sample);
  void take(const feed::Reported& reported);
  void playback(const PlaybackState& state) { clients_.playback(state); }
  // Drops latched messages after a jump of the recording, and sends the static ones again.
  void forget(Instant now);
  // Sends what is due; `shown` is the time that clients are to show.
  void turn(Instant now, Instant shown);
  Instant due() const { return time_reported_ + kTimeEvery; }
  UtcTime utc(Instant at) const { return sources_.utc(at); }
  service::PublisherFigures figures() const;

 private:
  FoxgloveServer(ServerConfig config, std::unique_ptr<web::WebServer> server);

  std::unique_ptr<web::WebServer> server_;
  Sources sources_;
  ClientRegistry clients_;
  Sources::Sink sink_;
  Instant time_reported_{}, losses_reported_{};
};

}  // namespace pitwall::publishers::foxglove
