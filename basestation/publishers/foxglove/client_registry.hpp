// Registry of Foxglove clients, without sockets: clients, subscriptions, requests.
//   in     clients that join and leave, and their messages; messages of the channels; messages that
//          clients lost; time; thresholds, which clients may read
//   out    messages with their receivers; playback requests
//   invariants
//          read only: a request that would change anything is refused with a status that gives the
//          reason, and is counted; no message of a client reaches another client
//          a client has one subscription per channel; for a latched channel it gets the newest
//          message at once. A client that loses messages because it reads too slowly gets a list of
//          the topics, once a second
//   bound  subscriptions of a client: at most the number of channels
//   errors errors of clients are sent back to them, and counted by kind
//   cost   message(): a header for each subscriber, the body once
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "basestation/publishers/foxglove/protocol.hpp"
#include "basestation/publishers/web/web_server.hpp"
#include "basestation/service/publisher.hpp"

namespace pitwall::publishers::foxglove {

struct Sending {
  web::ClientSet to;
  web::SharedMessage message;
};

class ClientRegistry {
 public:
  // The ids of the channels are their places in the list.
  ClientRegistry(ServerInfo info, std::vector<ChannelRow> channels);

  void joined(web::ClientId client);
  void left(web::ClientId client);
  std::optional<PlaybackControl> receive_text(web::ClientId client, std::string_view text);
  std::optional<PlaybackControl> receive_bytes(web::ClientId client,
                                               std::span<const std::uint8_t> bytes);

  bool wanted(std::size_t channel) const;  // subscribed, or latched for later subscribers
  bool anybody() const { return present_.any(); }
  void message(std::size_t channel, UtcTime at, std::span<const std::uint8_t> body);
  void time(UtcTime at);
  void playback(const PlaybackState& state);
  // Replaces all parameters; sends the changed ones to the clients that watch them.
  void parameters(std::vector<Parameter> parameters);
  void publish(web::ClientId client, Level level, std::string_view message);
  void lost(std::span<const web::Drop> drops);
  // Drops the latched messages, which do not hold after a jump of a recording.
  void forget() { newest_.clear(); }

  std::vector<Sending> take() { return std::exchange(out_, {}); }
  const std::vector<ChannelRow>& channels() const { return channels_; }
  // Number of clients, losses by topic, refusals by kind; not the number of sent messages.
  service::PublisherFigures figures() const;

 private:
  static constexpr std::uint32_t kTimeTag = 1, kFirstTag = 2;  // of messages that may be dropped
  using Body = std::shared_ptr<const std::vector<std::uint8_t>>;
  struct Newest {
    UtcTime at{};
    Body body;
  };

  std::optional<PlaybackControl> handle_request(web::ClientId client,
                                                Result<Request, Problem> request);
  void subscribe(web::ClientId client, const Subscribe& ask);
  void unsubscribe(web::ClientId client, const Unsubscribe& ask);
  void send_parameters(web::ClientId client, const GetParameters& ask);
  void watch(web::ClientId client, const WatchParameters& ask);
  void watch(web::ClientId client, const WatchGraph& ask);
  void refuse(web::ClientId client, std::string_view kind, std::string_view why);
  void send(const web::ClientSet& to, std::string text);
  void send(web::ClientId client, std::size_t channel, const Newest& newest);
  std::string topic_of_tag(std::uint32_t tag) const;

  ServerInfo info_;
  std::vector<ChannelRow> channels_;
  web::ClientSet present_;
  std::vector<std::map<web::ClientId, std::uint32_t>> subscribers_;  // by channel: the id for each
  std::map<std::size_t, Newest> newest_;                             // of latched channels
  struct Readable {
    double value = 0.0;
    web::ClientSet watchers;
  };
  std::map<std::string, Readable> parameters_;  // by name
  web::ClientSet watch_all_;                    // watch all parameters, also future ones
  std::map<std::string, std::uint64_t, std::less<>> refused_, lost_;
  std::vector<Sending> out_;
};

}  // namespace pitwall::publishers::foxglove
