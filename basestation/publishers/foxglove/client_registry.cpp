// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/foxglove/client_registry.hpp"

#include <algorithm>
#include <memory>

namespace pitwall::publishers::foxglove {
namespace {

using web::ClientId;
using web::ClientSet;

ClientSet only(ClientId client) { return ClientSet{}.set(client); }

}  // namespace

ClientRegistry::ClientRegistry(ServerInfo info, std::vector<ChannelRow> channels)
    : info_(std::move(info)), channels_(std::move(channels)), subscribers_(channels_.size()) {
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    channels_[i].id = static_cast<std::uint32_t>(i);
  }
}

void ClientRegistry::send(const ClientSet& to, std::string text) {
  if (to.none()) return;
  out_.push_back({to, std::make_shared<const web::Message>(web::Message{.text = std::move(text)})});
}

void ClientRegistry::joined(ClientId client) {
  present_.set(client);
  send(only(client), server_info_text(info_));
  send(only(client), advertise_text(channels_));
}

void ClientRegistry::left(ClientId client) {
  present_.reset(client);
  for (auto& subscribers : subscribers_) subscribers.erase(client);
  for (auto& [name, parameter] : parameters_) parameter.watchers.reset(client);
  watch_all_.reset(client);
}

std::optional<PlaybackControl> ClientRegistry::receive_text(ClientId client,
                                                            std::string_view text) {
  return handle_request(client, parse_text(text));
}

std::optional<PlaybackControl> ClientRegistry::receive_bytes(ClientId client,
                                                             std::span<const std::uint8_t> bytes) {
  return handle_request(client, parse_binary(bytes));
}

std::optional<PlaybackControl> ClientRegistry::handle_request(ClientId client,
                                                              Result<Request, Problem> request) {
  if (!present_.test(client)) return std::nullopt;
  if (!request) {
    refuse(client, "malformed", to_string(request.error()));
    return std::nullopt;
  }
  if (const auto* const ask = std::get_if<Subscribe>(&*request)) subscribe(client, *ask);
  if (const auto* const ask = std::get_if<Unsubscribe>(&*request)) unsubscribe(client, *ask);
  if (const auto* const ask = std::get_if<GetParameters>(&*request)) send_parameters(client, *ask);
  if (const auto* const ask = std::get_if<WatchParameters>(&*request)) watch(client, *ask);
  if (const auto* const ask = std::get_if<WatchGraph>(&*request)) watch(client, *ask);
  if (const auto* const ask = std::get_if<Refusable>(&*request)) {
    refuse(client, ask->capability,
           "this server is read only: it has no " + std::string{ask->capability} +
               "; use the console");
  }
  auto* const control = std::get_if<PlaybackControl>(&*request);
  if (control == nullptr) return std::nullopt;
  if (info_.playback) return std::move(*control);
  refuse(client, "playbackControl", "a live car cannot be played back");
  return std::nullopt;
}

void ClientRegistry::subscribe(ClientId client, const Subscribe& ask) {
  for (const auto& [id, channel] : ask.wanted) {
    const auto named = [channel = channel] { return "channel " + std::to_string(channel); };
    if (channel >= channels_.size()) {
      refuse(client, "subscribe", "there is no " + named());
      continue;
    }
    const bool taken = std::ranges::any_of(subscribers_, [&, id = id](const auto& subscribers) {
      const auto found = subscribers.find(client);
      return found != subscribers.end() && found->second == id;
    });
    if (taken || !subscribers_[channel].try_emplace(client, id).second) {
      refuse(client, "subscribe",
             taken ? "that subscription id is in use" : named() + " is subscribed already");
      continue;
    }
    if (const auto newest = newest_.find(channel); newest != newest_.end()) {
      send(client, channel, newest->second);
    }
  }
}

void ClientRegistry::unsubscribe(ClientId client, const Unsubscribe& ask) {
  for (const std::uint32_t id : ask.ids) {
    std::size_t gone = 0;
    for (auto& subscribers : subscribers_) {
      const auto found = subscribers.find(client);
      if (found == subscribers.end() || found->second != id) continue;
      subscribers.erase(found);
      ++gone;
    }
    if (gone == 0) refuse(client, "unsubscribe", "no subscription " + std::to_string(id));
  }
}

void ClientRegistry::send_parameters(ClientId client, const GetParameters& ask) {
  std::vector<Parameter> reported;
  for (const auto& [name, parameter] : parameters_) {
    const bool wanted = ask.names.empty() || std::ranges::count(ask.names, name) > 0;
    if (wanted) reported.push_back({name, parameter.value});
  }
  send(only(client), parameters_text(reported, ask.request));
}

void ClientRegistry::watch(ClientId client, const WatchParameters& ask) {
  if (ask.names.empty()) watch_all_.set(client, !ask.ends);
  for (auto& [name, parameter] : parameters_) {
    const bool meant = ask.names.empty() ? ask.ends : std::ranges::count(ask.names, name) > 0;
    if (meant) parameter.watchers.set(client, !ask.ends);
  }
}

// The graph does not change, so who watches it is told once.
void ClientRegistry::watch(ClientId client, const WatchGraph& ask) {
  if (!ask.ends) send(only(client), graph_text(channels_, info_.name));
}

void ClientRegistry::parameters(std::vector<Parameter> parameters) {
  std::map<ClientId, std::vector<Parameter>> reported;
  std::map<std::string, Readable> now;
  for (Parameter& parameter : parameters) {
    const auto before = parameters_.find(parameter.name);
    Readable readable{.value = parameter.value, .watchers = {}};
    if (before != parameters_.end()) readable.watchers = before->second.watchers;
    if (before == parameters_.end() || before->second.value != parameter.value) {
      const ClientSet watchers = readable.watchers | watch_all_;
      for (std::size_t client = 0; client < watchers.size(); ++client)
        if (watchers.test(client)) reported[static_cast<ClientId>(client)].push_back(parameter);
    }
    now.insert_or_assign(std::move(parameter.name), readable);
  }
  parameters_ = std::move(now);
  for (const auto& [client, changed] : reported) send(only(client), parameters_text(changed, ""));
}

void ClientRegistry::refuse(ClientId client, std::string_view kind, std::string_view why) {
  const auto known = refused_.try_emplace(std::string{kind}).first;
  ++known->second;
  publish(client, Level::kError, why);
}

void ClientRegistry::publish(ClientId client, Level level, std::string_view message) {
  send(only(client), status_text(level, message));
}

bool ClientRegistry::wanted(std::size_t channel) const {
  return !subscribers_[channel].empty() || channels_[channel].latched;
}

void ClientRegistry::message(std::size_t channel, UtcTime at, std::span<const std::uint8_t> body) {
  if (!wanted(channel)) return;
  const Newest newest{
      .at = at,
      .body = std::make_shared<const std::vector<std::uint8_t>>(body.begin(), body.end())};
  if (channels_[channel].latched) newest_.insert_or_assign(channel, newest);
  for (const auto& [client, id] : subscribers_[channel]) send(client, channel, newest);
}

void ClientRegistry::send(ClientId client, std::size_t channel, const Newest& newest) {
  web::Bytes bytes{.head_bytes = kMessageHeader,
                   .body = newest.body,
                   .tag = kFirstTag + static_cast<std::uint32_t>(channel)};
  std::ranges::copy(message_header(subscribers_[channel].at(client), newest.at),
                    bytes.head.begin());
  out_.push_back({only(client),
                  std::make_shared<const web::Message>(web::Message{.binary = std::move(bytes)})});
}

void ClientRegistry::time(UtcTime at) {
  if (present_.none()) return;
  web::Bytes bytes{.body = std::make_shared<const std::vector<std::uint8_t>>(time_bytes(at)),
                   .tag = kTimeTag};
  out_.push_back(
      {present_, std::make_shared<const web::Message>(web::Message{.binary = std::move(bytes)})});
}

void ClientRegistry::playback(const PlaybackState& state) {
  if (present_.none()) return;
  web::Bytes bytes{.body =
                       std::make_shared<const std::vector<std::uint8_t>>(playback_bytes(state))};
  out_.push_back(
      {present_, std::make_shared<const web::Message>(web::Message{.binary = std::move(bytes)})});
}

std::string ClientRegistry::topic_of_tag(std::uint32_t tag) const {
  const std::size_t channel = tag - kFirstTag;
  return tag >= kFirstTag && channel < channels_.size() ? channels_[channel].topic : "time";
}

void ClientRegistry::lost(std::span<const web::Drop> drops) {
  std::map<ClientId, std::string> reported;
  for (const web::Drop& drop : drops) {
    const std::string topic = topic_of_tag(drop.tag);
    lost_[topic] += drop.count;
    std::string& text = reported[drop.client];
    text += (text.empty() ? "" : ", ") + topic + " " + std::to_string(drop.count);
  }
  for (const auto& [client, text] : reported) {
    if (!present_.test(client)) continue;
    publish(client, Level::kWarning, "lost because this client does not read fast enough: " + text);
  }
}

service::PublisherFigures ClientRegistry::figures() const {
  service::PublisherFigures figures{.publisher = "foxglove", .clients = present_.count()};
  figures.dropped.assign(lost_.begin(), lost_.end());
  figures.refused.assign(refused_.begin(), refused_.end());
  return figures;
}

}  // namespace pitwall::publishers::foxglove
