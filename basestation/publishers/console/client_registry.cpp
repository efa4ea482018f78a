// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/console/client_registry.hpp"

#include <memory>
#include <utility>

#include "protocol/json/json_text.hpp"

namespace pitwall::publishers::console {
namespace {

using json::Object;

constexpr int kProtocolVersion = 1;

ClientSet only(ClientId client) { return ClientSet{}.set(client); }

}  // namespace

void ClientRegistry::send(const ClientSet& to, std::string text) {
  greet_new_clients();
  if (to.none()) return;
  out_.push_back({to, std::make_shared<const Message>(Message{.text = std::move(text)})});
}

std::string ClientRegistry::hello(ClientId client, Instant now) const {
  const UtcTime utc{utc_.ns + (now - utc_at_).ns};
  return Object{}
      .text("type", "hello")
      .number("version", kProtocolVersion)
      .number("car", identity_.car)
      .text("name", identity_.name)
      .text("mode", identity_.mode)
      .text("role", text_of(who_[client].role))
      .number("client", client)
      .text("alarm_config", identity_.alarm_config)
      .number("time_ns", now.ns)
      .number("utc_ms", utc.ns / milliseconds(1).ns)
      .str();
}

void ClientRegistry::joined(ClientId client, const Identity& who, Instant now) {
  present_.set(client);
  who_[client] = who;
  if (who.name.empty()) who_[client].name = "console " + std::to_string(client);
  new_clients_.push_back({client, now});
  snapshots_.want_full();
}

void ClientRegistry::greet_new_clients() {
  if (new_clients_.empty()) return;
  ClientSet all;
  for (const auto& [client, came] : std::exchange(new_clients_, {})) {
    send(only(client), hello(client, came));
    all.set(client);
  }
  send(all, catalogue_);
  for (const auto& [type, text] : messages_.states()) send(all, text);
  for (const auto& [type, log] : messages_.lines()) {
    for (const std::string& line : log) send(all, line);
  }
}

void ClientRegistry::left(ClientId client) {
  std::erase_if(new_clients_, [&](const NewClient& newcomer) { return newcomer.client == client; });
  present_.reset(client);
  who_[client] = {};
}

std::optional<Role> ClientRegistry::role(ClientId client) const {
  if (!present_.test(client)) return std::nullopt;
  return who_[client].role;
}

command::Person ClientRegistry::person(ClientId client) const {
  return {.console = client, .name = who_[client].name};
}

std::optional<Request> ClientRegistry::receive_text(ClientId client, std::string_view text,
                                                    const StateSource& source, Instant now) {
  if (!present_.test(client)) return std::nullopt;
  auto request = parse_request(text);
  if (!request) {
    send_error(client, request.error());
    return std::nullopt;
  }
  if (role_for(*request) == Role::kOperator && who_[client].role != Role::kOperator) {
    send_error(client, {"role", "a viewer looks only"});
    return std::nullopt;
  }
  ++counters_.requests;
  if (const auto* ask = std::get_if<AskHistory>(&*request)) {
    send_history(client, *ask, source, now);
    return std::nullopt;
  }
  if (const auto* ask = std::get_if<AskLap>(&*request)) {
    send_lap(client, *ask, source, now);
    return std::nullopt;
  }
  if (const auto* ask = std::get_if<AskPing>(&*request)) {
    send(only(client),
         Object{}.text("type", "pong").number("at", ask->at).number("time_ns", now.ns).str());
    return std::nullopt;
  }
  return *std::move(request);
}

void ClientRegistry::receive_binary(ClientId client) {
  send_error(client, {"message", "this base takes texts only"});
}

void ClientRegistry::send_history(ClientId client, const AskHistory& ask, const StateSource& source,
                                  Instant now) {
  if (!state::is_field(ask.field)) return send_error(client, {"history.field", "no such field"});
  greet_new_clients();
  const auto points = source.past(ask.field, now - from_seconds(ask.from_s),
                                  now - from_seconds(ask.to_s), ask.points);
  out_.push_back({only(client), std::make_shared<const Message>(
                                    Message{.frame = web::history_frame(ask.field, points, now)})});
}

void ClientRegistry::send_lap(ClientId client, const AskLap& ask, const StateSource& source,
                              Instant now) {
  const state::LapLog* const laps = source.laps();
  const state::Lap* const lap = laps != nullptr ? laps->find(ask.lap) : nullptr;
  if (lap == nullptr) return send_error(client, {"lap.lap", "no such lap"});
  greet_new_clients();
  out_.push_back({only(client), std::make_shared<const Message>(
                                    Message{.frame = web::lap_frame(*lap, laps->step_m(), now)})});
}

void ClientRegistry::send_error(ClientId client, const Problem& problem) {
  ++counters_.refused;
  send(
      only(client),
      Object{}.text("type", "error").text("place", problem.place).text("what", problem.what).str());
}

void ClientRegistry::send_to_all(std::string text) { send(present_, std::move(text)); }

void ClientRegistry::send_catalogue(std::string catalogue) {
  catalogue_ = std::move(catalogue);
  send(present_, catalogue_);
}

void ClientRegistry::identify(const service::CarIdentity& identity, Instant now) {
  if (identity == identity_) return;
  identity_ = identity;
  for (std::size_t client = web::kFirstClient; client <= web::kLastClient; ++client) {
    if (!present_.test(client)) continue;
    send(only(static_cast<ClientId>(client)), hello(static_cast<ClientId>(client), now));
  }
}

void ClientRegistry::serve(const StateSource& source, UtcTime utc, Instant now) {
  greet_new_clients();
  utc_ = utc;
  utc_at_ = now;
  auto frame = snapshots_.make(source, now);
  if (!frame || present_.none()) return;
  frame->car = static_cast<std::uint8_t>(identity_.car);
  out_.push_back({present_, std::make_shared<const Message>(Message{.frame = *std::move(frame)})});
}

}  // namespace pitwall::publishers::console
