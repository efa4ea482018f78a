// Web server of the consoles: HTTP and WebSocket on a thread of its own, so that no browser delays
// data from the car.
//   in     messages for clients; documents, from the start and later
//   out    clients that joined or left, and their messages
//   invariants
//          two bounded queues connect this thread and the caller's; neither side waits for the
//          other. A client with too many unhandled requests is not read further, so that TCP flow
//          control stops it. A client that does not read: client_queue.hpp
//          a console belongs to the car that it has selected, until it leaves: its messages go to
//          the reader of that car only
//          malformed HTTP is answered 400, 413 or 431 and closed; a text that is not UTF-8, too
//          long a message or broken framing closes that socket with the code of RFC 6455; other
//          sockets are not affected
//          clients without a token take no place from clients with one: connections that are not
//          consoles yet have limits of their own, see admission/waiting_room.hpp
//   bound  kCars cars; kConnections in all, consoles 16 to 254 of them, the last kReserved places
//          for operators; a client is read at the rate of admission/pace.hpp
//   errors start(): Problem with the address as place; afterwards counters
//   source RFC 9112, RFC 6455, by Boost.Beast
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "basestation/publishers/web/admission/client.hpp"
#include "basestation/publishers/web/client_queue.hpp"
#include "basestation/publishers/web/http_responder.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::publishers::web {

struct ClientEvent {
  enum class Kind : std::uint8_t { kJoined, kLeft, kText, kBinary, kPage };
  Kind kind = Kind::kJoined;
  ClientId client = 0;
  Identity who{};             // kJoined
  std::string text{};         // kText, kBinary; kPage: the page of a bench
  std::uint64_t request = 0;  // kPage: to be answered by answer()
};

// Tagged bytes that a client lost because it did not read.
struct Drop {
  ClientId client = 0;
  std::uint32_t tag = 0;
  std::uint64_t count = 0;
};

struct WebCounters {
  std::uint64_t connections = 0, refused_room = 0;  // refused: more than kConnections at once
  std::uint64_t closed_waiting = 0;                 // longest silent when new ones came
  std::uint64_t refused_places = 0;                 // all places of consoles were taken
  std::uint64_t refused_short = 0;                  // memory or descriptors ran short
  std::uint64_t closed_short = 0;                   // memory ran short: most unread, or newest
  std::uint64_t closed_revoked = 0;                 // their token is no longer valid
  std::uint64_t refused_tls = 0;                    // no TLS at a TLS port, or another failure
  std::uint64_t bad_http = 0, refused_http = 0;     // malformed; answered 4xx
  std::uint64_t joined = 0, left = 0;
  std::uint64_t texts_received = 0, messages_sent = 0, bytes_sent = 0;
  std::uint64_t pictures_dropped = 0;  // of clients that did not read, in total
  std::uint64_t closed_unread = 0;     // too much unread
  std::uint64_t posts_dropped = 0;     // this thread did not keep up with the caller
  std::uint64_t faults = 0;            // exceptions of the libraries, caught
};

class WebServer {
 public:
  static constexpr std::size_t kConnections = 400;
  static constexpr std::size_t kReserved = 32;   // places of consoles for operators only
  static constexpr std::size_t kUnhandled = 16;  // pending requests of one client
  static constexpr std::size_t kCars = 4;
  static constexpr std::size_t kPostsMax = 4'096;  // messages that wait for the web thread
  static constexpr std::size_t kPagesMax = 16;     // pages of a bench that are awaited

  static Result<std::unique_ptr<WebServer>, Problem> start(UdpAddress listen, HttpConfig config);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  UdpAddress local() const;
  // For the consoles of one car, in the order of HttpConfig::cars: readable while news wait. News
  // of operators come before those of viewers; those of one client stay in order.
  int fd(std::size_t car = 0) const;
  std::optional<ClientEvent> next_event(std::size_t car = 0);
  // Replaces the document of this path, or adds one.
  void show(const std::string& path, Shown document);
  void send(const ClientSet& to, SharedMessage message);
  // Answers a request for a page.
  void answer(std::uint64_t request, HttpAnswer answer);
  WebCounters counters() const;
  // Tagged bytes lost since the last call.
  std::vector<Drop> take_drops();

 private:
  struct Engine;
  explicit WebServer(std::unique_ptr<Engine> engine);
  std::unique_ptr<Engine> engine_;
};

}  // namespace pitwall::publishers::web
