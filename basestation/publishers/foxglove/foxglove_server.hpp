// A Foxglove WebSocket server as one thread uses it: sockets, clients and sources together.
//   in     what came from the car, what the base told; time
//   out    messages to clients; what they ask of a recording's playback
//   invariants
//          nothing waits: the sockets have a thread and bounded queues of their own. While nobody
//          is there nothing is encoded but what who comes must be told
//          a page of this machine may attach; one of elsewhere only where its origin was named
//   bound  of a client that does not read kMessages messages and kMessageBytes wait, the oldest go
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
  transport::UdpAddress listen{};  // port 0: any that is free
  web::AccessRules access{};       // who; its pages of this machine are let in besides
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

  transport::UdpAddress local() const { return server_->local(); }
  int fd() const { return server_->fd(); }  // readable while clients have said something
  std::vector<PlaybackControl> receive();
  void take(const feed::Item& item);
  void take(const feed::Sample& sample);
  void take(const feed::Reported& reported);
  void playback(const PlaybackState& state) { room_.playback(state); }
  // A recording has jumped.
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
  ClientRegistry room_;
  Sources::Sink sink_;
  Instant time_reported_{}, losses_reported_{};
};

}  // namespace pitwall::publishers::foxglove
