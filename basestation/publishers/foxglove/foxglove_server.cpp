// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/foxglove/foxglove_server.hpp"

#include <utility>

#include "basestation/publishers/foxglove/thresholds.hpp"
#include "protocol/transport/clock.hpp"

namespace pitwall::publishers::foxglove {

Result<std::unique_ptr<FoxgloveServer>, Problem> FoxgloveServer::start(ServerConfig config) {
  web::HttpConfig http;
  http.access = config.access;
  http.access.local_pages = true;
  http.tls = config.tls;
  http.subprotocols.assign(kSubprotocols.begin(), kSubprotocols.end());
  http.queue = {.snapshots = kMessages, .snapshot_bytes = kMessageBytes};
  auto server = web::WebServer::start(config.listen, std::move(http));
  if (!server) return Unexpected{Problem{"--foxglove", server.error().what}};
  return std::unique_ptr<FoxgloveServer>{new FoxgloveServer{std::move(config), *std::move(server)}};
}

FoxgloveServer::FoxgloveServer(ServerConfig config, std::unique_ptr<web::WebServer> server)
    : server_(std::move(server)),
      sources_(std::move(config.view), std::move(config.clock)),
      clients_({.name = std::move(config.name),
                .session = std::to_string(transport::utc_now().ns),
                .playback = config.playback},
               sources_.channels()),
      sink_([this](std::size_t channel, UtcTime at, std::span<const std::uint8_t> body) {
        clients_.message(channel, at, body);
      }) {
  sources_.statics(transport::monotonic_now(), sink_);
}

std::vector<PlaybackControl> FoxgloveServer::receive() {
  std::vector<PlaybackControl> asked;
  while (const auto news = server_->next_event()) {
    std::optional<PlaybackControl> control;
    switch (news->kind) {
      case web::ClientEvent::Kind::kJoined:
        clients_.joined(news->client);
        break;
      case web::ClientEvent::Kind::kLeft:
        clients_.left(news->client);
        break;
      case web::ClientEvent::Kind::kText:
        control = clients_.receive_text(news->client, news->text);
        break;
      case web::ClientEvent::Kind::kBinary: {
        const auto* const bytes = reinterpret_cast<const std::uint8_t*>(news->text.data());
        control = clients_.receive_bytes(news->client, {bytes, news->text.size()});
        break;
      }
      case web::ClientEvent::Kind::kPage:
        break;  // HTTP has no pages at this port
    }
    if (control) asked.push_back(*std::move(control));
  }
  return asked;
}

void FoxgloveServer::take(const feed::Item& item) {
  if (const auto* const sample = std::get_if<std::unique_ptr<const feed::Sample>>(&item)) {
    take(**sample);
  } else if (const auto* const reported = std::get_if<feed::Reported>(&item)) {
    take(*reported);
  } else if (clients_.anybody()) {
    sources_.take(*std::get<std::unique_ptr<const feed::BaseStatus>>(item), sink_);
  }
}

void FoxgloveServer::take(const feed::Sample& sample) {
  if (clients_.anybody()) sources_.take(sample, sink_);
}

void FoxgloveServer::take(const feed::Reported& reported) {
  sources_.take(reported, sink_);
  if (reported.topic == recorder::Topic::kSettings)
    clients_.parameters(thresholds_of(reported.json));
}

void FoxgloveServer::forget(Instant now) {
  clients_.forget();
  sources_.statics(now, sink_);
}

void FoxgloveServer::turn(Instant now, Instant shown) {
  if (now >= due()) {
    time_reported_ = now;
    clients_.time(utc(shown));
  }
  if (now - losses_reported_ >= kLossEvery) {
    losses_reported_ = now;
    clients_.lost(server_->take_drops());
  }
  for (Sending& sending : clients_.take()) server_->send(sending.to, std::move(sending.message));
}

service::PublisherFigures FoxgloveServer::figures() const {
  service::PublisherFigures figures = clients_.figures();
  const web::WebCounters web = server_->counters();
  figures.sent = web.messages_sent;
  figures.failed = web.posts_dropped;
  figures.refused.emplace_back("http", web.refused_http);
  figures.refused.emplace_back("malformed http", web.bad_http);
  figures.refused.emplace_back("left too much unread", web.closed_unread);
  return figures;
}

}  // namespace pitwall::publishers::foxglove
