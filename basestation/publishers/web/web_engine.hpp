// Implementation of web_server.cpp: state of the web thread, and the WebSocket of one console. Only
// for that file, because it includes Boost.Beast.
//   invariants
//          news, posts and counters are under the lock; all else belongs to the web thread
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "basestation/publishers/web/admission/pace.hpp"
#include "basestation/publishers/web/admission/pending_connections.hpp"
#include "basestation/publishers/web/web_server.hpp"
#include "basestation/publishers/web/wire.hpp"
#include "protocol/transport/clock.hpp"

namespace pitwall::publishers::web {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::system::error_code;
using Tcp = asio::ip::tcp;

inline constexpr std::size_t kHeaderMax = 16 * 1'024;
inline constexpr auto kHttpTimeout = std::chrono::seconds(15);
inline constexpr auto kHousekeepingPeriod = std::chrono::seconds(1);
inline constexpr Duration kLogRepeatPeriod = seconds(10);  // between log lines of the same cause
// Pause of accept() when no descriptor is free.
inline constexpr auto kAcceptPause = std::chrono::milliseconds(50);
inline constexpr auto kSilence = std::chrono::seconds(60);  // of a socket, with unanswered pings
inline constexpr auto kClosing = std::chrono::seconds(2);
inline constexpr int kSendBuffer = 64 * 1'024;  // small: messages wait in the droppable queue
inline constexpr bool kCompressed = false;      // no permessage-deflate
inline constexpr std::size_t kNewsMax = 8'192;

inline std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

struct WebServer::Engine {
  class HttpSession;
  class Socket;

  Engine(const Tcp::endpoint& endpoint, HttpConfig config)
      : acceptor(io, endpoint),
        responder(std::move(config)),
        housekeeping_timer(io),
        accepting(io) {
    responder.serve_at(acceptor.local_endpoint().port());
    if (responder.config().tls == nullptr) return;
    SSL_CTX* const tls = responder.config().tls.get();
    SSL_CTX_up_ref(tls);  // the asio context releases one reference
    context.emplace(tls);
  }

  void run();
  void accept();
  void accepted(Tcp::socket socket);
  // Reason to refuse this connection, or empty. Counts the memory that the newest ones still need.
  std::string no_room_for(const Tcp::socket& socket) const;
  void refuse(std::uint64_t WebCounters::*counter, const std::string& why);
  // Once a second: revoked tokens, shortage of memory.
  void run_housekeeping();
  void drop_revoked();
  void make_room();     // on a shortage of memory
  void drop_largest();  // the viewer with most unread
  void drop_newest();   // the newest viewer, while an allocation has failed
  void publish(std::size_t car, Role by, ClientEvent news);
  void call();
  void deliver();
  // Returns 0 if no place is free for this role.
  ClientId free_number(Role role);
  template <class Change>
  void count(const Change& change) {
    const std::lock_guard hold(lock);
    change(counters);
  }

  struct Post {
    ClientSet to;
    SharedMessage message;  // nullptr: one request of these clients was handled
  };
  struct EventQueues {
    std::deque<ClientEvent> operators, viewers;  // news, by role
    ClientSet leaving;  // kLeft still waits among the news: number not reusable yet
    transport::FileDescriptor event_fd;  // never changes
  };
  mutable std::mutex lock;
  std::array<EventQueues, kCars> queues;  // by car; from here on under the lock
  std::vector<Post> posts;
  std::map<std::string, Shown> shown;           // documents not yet given to the responder
  std::map<std::uint64_t, HttpAnswer> answers;  // by request, not yet given to its session
  bool post_under_way = false;
  WebCounters counters;
  std::map<std::pair<ClientId, std::uint32_t>, std::uint64_t> drops;  // by client and tag

  std::size_t connections = 0;  // from here on for the web thread only
  std::size_t new_clients = 0,
              earlier_clients = 0;  // accepted in this and in the last kHousekeepingPeriod
  ClientId newest = kLastClient;
  PendingConnections::Connection newest_connection = 0;
  PendingConnections waiting;
  std::map<PendingConnections::Connection, std::weak_ptr<HttpSession>> sessions;
  std::string last_refusal;  // cause of the newest refusal
  std::optional<Instant> last_refusal_at;
  // Declared after the members that sessions in its handlers use, so that it is destroyed first.
  asio::io_context io{1};
  Tcp::acceptor acceptor;
  HttpResponder responder;
  std::optional<asio::ssl::context> context;
  asio::steady_timer housekeeping_timer, accepting;
  std::array<std::shared_ptr<Socket>, 256> sockets{};              // by client
  std::map<std::uint64_t, std::shared_ptr<HttpSession>> awaiting;  // a page, by request
  std::uint64_t newest_request = 0;
  std::thread thread;
};

// WebSocket of one console. It lives while an operation is pending or the engine holds it.
class WebServer::Engine::Socket : public std::enable_shared_from_this<Socket> {
 public:
  Socket(Engine& engine, Wire&& stream, ClientId client, HttpAnswer answer)
      : engine_(engine),
        stream_(std::move(stream)),
        timer_(engine.io),
        rest_(engine.io),
        client_(client),
        who_(*std::move(answer.visitor)),
        car_(answer.car),
        subprotocol_(answer.subprotocol),
        queue_(engine.responder.config().queue) {}
  ~Socket() { --engine_.connections; }

  void accept(const http::request<http::string_body>& request) {
    beast::get_lowest_layer(stream_).expires_never();
    stream_.set_option(websocket::stream_base::timeout{kHttpTimeout, kSilence, true});
    stream_.read_message_max(kTextMax);
    stream_.auto_fragment(false);
    if (!subprotocol_.empty()) {
      stream_.set_option(websocket::stream_base::decorator(
          [name = subprotocol_](websocket::response_type& response) {
            response.set(http::field::sec_websocket_protocol, std::string{name});
          }));
    }
    stream_.async_accept(request, [self = shared_from_this()](error_code failed) {
      if (failed) return self->gone();
      self->engine_.publish(
          self->car_, self->who_.role,
          {.kind = ClientEvent::Kind::kJoined, .client = self->client_, .who = self->who_});
      // After the hand-over, as for texts.
      self->engine_.count([](WebCounters& c) { ++c.joined; });
      self->joined_ = true;
      self->read();
    });
  }

  void send(const SharedMessage& message) {
    if (!joined_ || closing_) return;
    const std::uint32_t before = queue_.dropped();
    const bool room = queue_.push(message);
    const std::uint32_t dropped = queue_.dropped() - before;
    if (dropped > 0) {
      engine_.count([&](WebCounters& c) {
        c.pictures_dropped += dropped;
        for (const std::uint32_t tag : queue_.take_lost_tags()) ++engine_.drops[{client_, tag}];
      });
    }
    if (!room) {
      engine_.count([](WebCounters& c) { ++c.closed_unread; });
      return close(websocket::close_code::try_again_later);
    }
    if (!writing_) write();
  }

  void handled() {
    if (unhandled_ > 0) --unhandled_;
    if (!reading_ && joined_ && !closing_) read();
  }

  void close(websocket::close_code code) {
    if (closing_) return;
    closing_ = true;
    timer_.expires_after(kClosing);
    timer_.async_wait([self = shared_from_this()](error_code cancelled) {
      if (!cancelled) self->cut();
    });
    stream_.async_close(code, [self = shared_from_this()](error_code) { self->cut(); });
  }

  const Identity& who() const { return who_; }
  std::size_t unread_bytes() const { return queue_.bytes(); }

  void cut() {
    error_code ignored;
    beast::get_lowest_layer(stream_).socket().close(ignored);
    timer_.cancel();
    gone();
  }

 private:
  void read() {
    if (unhandled_ >= kUnhandled || reading_) return;  // handled() continues reading
    reading_ = true;
    const Duration rest = pace_.rest(transport::wall_now());
    if (rest > Duration{}) {
      rest_.expires_after(std::chrono::nanoseconds{rest.ns});
      return rest_.async_wait([self = shared_from_this()](error_code) { self->read_next(); });
    }
    read_next();
  }

  void read_next() {
    stream_.async_read(received_, [self = shared_from_this()](error_code failed, std::size_t) {
      self->reading_ = false;
      if (failed) return self->gone();
      self->take();
      self->read();
    });
  }

  void take() {
    ++unhandled_;
    pace_.receive(transport::wall_now());
    ClientEvent news{
        .kind = stream_.got_text() ? ClientEvent::Kind::kText : ClientEvent::Kind::kBinary,
        .client = client_};
    news.text = beast::buffers_to_string(received_.data());
    received_.consume(received_.size());
    engine_.publish(car_, who_.role, std::move(news));
    // After the hand-over: whoever waits for the count finds the text in the queue.
    engine_.count([](WebCounters& c) { ++c.texts_received; });
  }

  void write() {
    current_ = queue_.pop();
    writing_ = current_ != nullptr;
    if (!writing_ || closing_) return;
    auto done = [self = shared_from_this()](error_code failed, std::size_t bytes) {
      self->writing_ = false;
      if (failed) return self->gone();
      self->engine_.count([&](WebCounters& c) {
        ++c.messages_sent;
        c.bytes_sent += bytes;
      });
      self->write();
    };
    stream_.text(!current_->frame && !current_->binary);
    stream_.async_write(parts_of_current(), std::move(done));
  }

  // Always two buffers, so that one kind of write serves all messages; an empty one writes nothing.
  std::array<asio::const_buffer, 2> parts_of_current() {
    if (const auto& bytes = current_->binary) {
      return {asio::buffer(bytes->head.data(), bytes->head_bytes),
              bytes->body ? asio::buffer(*bytes->body) : asio::const_buffer{}};
    }
    if (!current_->frame) return {asio::buffer(current_->text), asio::const_buffer{}};
    header_ = header_of(*current_->frame, queue_.dropped());
    return {asio::buffer(header_), asio::buffer(current_->frame->entries)};
  }

  void gone() {
    closing_ = true;
    rest_.cancel();
    if (engine_.sockets[client_].get() != this) return;
    const auto self = shared_from_this();
    engine_.sockets[client_].reset();
    if (!joined_) return;
    engine_.count([](WebCounters& c) { ++c.left; });
    engine_.publish(car_, who_.role, {.kind = ClientEvent::Kind::kLeft, .client = client_});
  }

  Engine& engine_;
  websocket::stream<Wire, kCompressed> stream_;
  asio::steady_timer timer_, rest_;
  Pace pace_;
  ClientId client_;
  Identity who_;
  std::size_t car_;  // that the client has selected
  std::string_view subprotocol_;
  beast::flat_buffer received_;
  ClientQueue queue_;
  SharedMessage current_;
  std::array<std::uint8_t, kFrameHeader> header_{};
  std::size_t unhandled_ = 0;
  bool joined_ = false, reading_ = false, writing_ = false, closing_ = false;
};

}  // namespace pitwall::publishers::web
