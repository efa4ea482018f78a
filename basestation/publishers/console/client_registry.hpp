// Registry of console clients, without sockets: clients, messages out, requests in.
//   in     clients that join and leave, and their texts; snapshots and messages of the base; time
//   out    messages with their receivers; requests that the caller executes
//   invariants  a new client gets first its identity, then the catalogue, the newest message of
//          each state type, the last lines of each log, and a full frame
//          a text that is not a request, or that needs another role, is answered by an error and
//          has no other effect
//   errors errors in texts of clients are sent back to them and counted
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "basestation/command/audit.hpp"
#include "basestation/publishers/console/requests.hpp"
#include "basestation/publishers/console/snapshots.hpp"
#include "basestation/publishers/web/admission/client.hpp"
#include "basestation/publishers/web/client_queue.hpp"
#include "basestation/service/messages/message_log.hpp"
#include "basestation/service/messages/message_text.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::publishers::console {

using web::ClientSet;
using web::Identity;
using web::Message;
using web::SharedMessage;

struct Sending {
  ClientSet to;
  SharedMessage message;
};

struct RequestCounters {
  std::uint64_t requests = 0, refused = 0;
};

class ClientRegistry {
 public:
  // The log outlives it.
  ClientRegistry(std::string catalogue, const service::MessageLog& messages)
      : catalogue_(std::move(catalogue)), messages_(messages) {}

  void joined(ClientId client, const Identity& who, Instant now);
  void left(ClientId client);
  // Returns a request that the caller must execute; nullopt if the registry has handled it.
  std::optional<Request> receive_text(ClientId client, std::string_view text,
                                      const StateSource& source, Instant now);
  void receive_binary(ClientId client);

  void send_error(ClientId client, const Problem& problem);
  void send_to_all(std::string text);
  void send_catalogue(std::string catalogue);
  // Makes the next frame a full one, after a jump of a replay.
  void want_full() { snapshots_.want_full(); }
  void identify(const service::CarIdentity& identity, Instant now);

  void receive() { snapshots_.receive(); }
  void serve(const StateSource& source, UtcTime utc, Instant now);
  Instant due() const { return snapshots_.due(); }
  std::vector<Sending> take() {
    greet_new_clients();
    return std::exchange(out_, {});
  }

  command::Person person(ClientId client) const;
  std::optional<Role> role(ClientId client) const;
  std::size_t clients() const { return present_.count(); }
  const RequestCounters& counters() const { return counters_; }

 private:
  struct NewClient {
    ClientId client = 0;
    Instant came{};
  };

  void send(const ClientSet& to, std::string text);
  // Greets all clients that have joined since the last call together, so that they share messages;
  // called before anything else is sent.
  void greet_new_clients();
  std::string hello(ClientId client, Instant now) const;
  void send_lap(ClientId client, const AskLap& ask, const StateSource& source, Instant now);
  void send_history(ClientId client, const AskHistory& ask, const StateSource& source, Instant now);

  std::string catalogue_;
  const service::MessageLog& messages_;
  service::CarIdentity identity_;
  UtcTime utc_{};
  Instant utc_at_{};
  ClientSet present_;
  std::vector<NewClient> new_clients_;  // not greeted yet
  std::array<Identity, 256> who_{};
  Snapshots snapshots_;
  std::vector<Sending> out_;
  RequestCounters counters_;
};

}  // namespace pitwall::publishers::console
