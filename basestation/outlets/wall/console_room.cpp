// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/wall/console_room.hpp"

#include <memory>
#include <utility>

#include "protocol/json/json_text.hpp"

namespace pitwall::outlets::wall {
namespace {

using json::Object;

constexpr int kProtocolVersion = 1;

ClientSet only(ClientId client) { return ClientSet{}.set(client); }

}  // namespace

void ConsoleRoom::send(const ClientSet& to, std::string text) {
  if (to.none()) return;
  out_.push_back({to, std::make_shared<const Message>(Message{.text = std::move(text)})});
}

void ConsoleRoom::record(std::string_view type, std::string_view text, Instant now) const {
  for (const Sink& sink : sinks_) sink(type, text, now);
}

std::string ConsoleRoom::hello(ClientId client, Instant now) const {
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

void ConsoleRoom::joined(ClientId client, const Identity& who, Instant now) {
  present_.set(client);
  who_[client] = who;
  if (who.name.empty()) who_[client].name = "console " + std::to_string(client);
  send(only(client), hello(client, now));
  send(only(client), catalogue_);
  for (const auto& [type, text] : states_) send(only(client), text);
  for (const auto& [type, log] : lines_) {
    for (const std::string& line : log) send(only(client), line);
  }
  snapshots_.want_full();
}

void ConsoleRoom::left(ClientId client) {
  present_.reset(client);
  who_[client] = {};
}

std::optional<Role> ConsoleRoom::role(ClientId client) const {
  if (!present_.test(client)) return std::nullopt;
  return who_[client].role;
}

command::Person ConsoleRoom::person(ClientId client) const {
  return {.console = client, .name = who_[client].name};
}

std::optional<Request> ConsoleRoom::said(ClientId client, std::string_view text, const Eyes& eyes,
                                         Instant now) {
  if (!present_.test(client)) return std::nullopt;
  auto request = parse_request(text);
  if (!request) {
    tell_error(client, request.error());
    return std::nullopt;
  }
  if (role_for(*request) == Role::kOperator && who_[client].role != Role::kOperator) {
    tell_error(client, {"role", "a viewer looks only"});
    return std::nullopt;
  }
  ++counters_.requests;
  if (const auto* ask = std::get_if<AskHistory>(&*request)) {
    tell_history(client, *ask, eyes, now);
    return std::nullopt;
  }
  if (const auto* ask = std::get_if<AskPing>(&*request)) {
    send(only(client),
         Object{}.text("type", "pong").number("at", ask->at).number("time_ns", now.ns).str());
    return std::nullopt;
  }
  return *std::move(request);
}

void ConsoleRoom::said_binary(ClientId client) {
  tell_error(client, {"message", "this base takes texts only"});
}

void ConsoleRoom::tell_history(ClientId client, const AskHistory& ask, const Eyes& eyes,
                               Instant now) {
  if (!picture::is_field(ask.field)) return tell_error(client, {"history.field", "no such field"});
  const auto points = eyes.past(ask.field, now - from_seconds(ask.from_s),
                                now - from_seconds(ask.to_s), ask.points);
  out_.push_back({only(client), std::make_shared<const Message>(
                                    Message{.frame = web::history_frame(ask.field, points, now)})});
}

void ConsoleRoom::tell_state(std::string_view type, std::string text, Instant now) {
  record(type, text, now);
  states_.insert_or_assign(std::string{type}, text);
  send(present_, std::move(text));
}

void ConsoleRoom::tell_line(std::string_view type, std::string text, Instant now) {
  record(type, text, now);
  std::deque<std::string>& log = lines_[std::string{type}];
  log.push_back(text);
  if (log.size() > kLines) log.pop_front();
  send(present_, std::move(text));
}

void ConsoleRoom::tell_error(ClientId client, const Problem& problem) {
  ++counters_.refused;
  send(
      only(client),
      Object{}.text("type", "error").text("place", problem.place).text("what", problem.what).str());
}

void ConsoleRoom::tell_all(std::string text) { send(present_, std::move(text)); }

void ConsoleRoom::tell_catalogue(std::string catalogue) {
  catalogue_ = std::move(catalogue);
  send(present_, catalogue_);
}

void ConsoleRoom::forget() {
  states_.clear();
  lines_.clear();
  snapshots_.want_full();
}

void ConsoleRoom::identify(const BaseIdentity& identity, Instant now) {
  if (identity == identity_) return;
  identity_ = identity;
  for (std::size_t client = web::kFirstClient; client <= web::kLastClient; ++client) {
    if (!present_.test(client)) continue;
    send(only(static_cast<ClientId>(client)), hello(static_cast<ClientId>(client), now));
  }
  record("hello", hello(0, now), now);
}

void ConsoleRoom::serve(const Eyes& eyes, UtcTime utc, Instant now) {
  utc_ = utc;
  utc_at_ = now;
  auto frame = snapshots_.make(eyes, now);
  if (!frame || present_.none()) return;
  frame->car = static_cast<std::uint8_t>(identity_.car);
  out_.push_back({present_, std::make_shared<const Message>(Message{.frame = *std::move(frame)})});
}

}  // namespace pitwall::outlets::wall
