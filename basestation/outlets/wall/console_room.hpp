// All consoles of a base, without any socket: who is there, what each is told, what each asks.
//   in     who joined, left and said what; pictures, texts of the base; time
//   out    messages with whom they are for; requests that somebody else carries out
//   law    who joins is told first who it is, then the catalogue, the newest of every state, the
//          last kLines lines of logs, and a full picture
//          a text that is no request, or takes another role, is answered by an error; nothing else
//          happens
//   errors of what consoles say: told to them and counted
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "basestation/command/person.hpp"
#include "basestation/outlets/wall/requests.hpp"
#include "basestation/outlets/wall/snapshots.hpp"
#include "basestation/outlets/web/client.hpp"
#include "basestation/outlets/web/client_queue.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::outlets::wall {

using web::ClientSet;
using web::Identity;
using web::Message;
using web::SharedMessage;

struct BaseIdentity {
  int car = 0;
  std::string name, mode = "NONE", alarm_config;

  bool operator==(const BaseIdentity&) const = default;
};

struct Sending {
  ClientSet to;
  SharedMessage message;
};

struct RoomCounters {
  std::uint64_t requests = 0, refused = 0;
};

class ConsoleRoom {
 public:
  static constexpr std::size_t kLines = 200;
  // Every text that all consoles are told: for the recorder, and for tools that attach.
  using Sink = std::function<void(std::string_view type, std::string_view text, Instant at)>;

  explicit ConsoleRoom(std::string catalogue) : catalogue_(std::move(catalogue)) {}

  void joined(ClientId client, const Identity& who, Instant now);
  void left(ClientId client);
  // A request for somebody else to carry out; what the room does itself gives none.
  std::optional<Request> said(ClientId client, std::string_view text, const Eyes& eyes,
                              Instant now);
  void said_binary(ClientId client);

  // A state replaces the one of its type; a line is added to the log. `text` is the whole message.
  void tell_state(std::string_view type, std::string text, Instant now);
  void tell_line(std::string_view type, std::string text, Instant now);
  void tell_error(ClientId client, const Problem& problem);
  void tell_all(std::string text);  // told once and not kept
  void tell_catalogue(std::string catalogue);
  // A replay has jumped: nothing that was told holds any more, and all are told anew.
  void forget();
  void identify(const BaseIdentity& identity, Instant now);

  void heard() { snapshots_.heard(); }
  void serve(const Eyes& eyes, UtcTime utc, Instant now);
  Instant due() const { return snapshots_.due(); }
  std::vector<Sending> take() { return std::exchange(out_, {}); }

  command::Person person(ClientId client) const;
  std::optional<Role> role(ClientId client) const;
  std::size_t clients() const { return present_.count(); }
  const RoomCounters& counters() const { return counters_; }
  void record_with(Sink sink) { sinks_.push_back(std::move(sink)); }  // each is told

 private:
  void send(const ClientSet& to, std::string text);
  void record(std::string_view type, std::string_view text, Instant now) const;
  std::string hello(ClientId client, Instant now) const;
  void tell_history(ClientId client, const AskHistory& ask, const Eyes& eyes, Instant now);

  std::string catalogue_;
  BaseIdentity identity_;
  UtcTime utc_{};
  Instant utc_at_{};
  ClientSet present_;
  std::array<Identity, 256> who_{};
  Snapshots snapshots_;
  std::map<std::string, std::string, std::less<>> states_;
  std::map<std::string, std::deque<std::string>, std::less<>> lines_;
  std::vector<Sending> out_;
  RoomCounters counters_;
  std::vector<Sink> sinks_;
};

}  // namespace pitwall::outlets::wall
