// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/web_server.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/serializer.hpp>
#include <exception>
#include <optional>

#include "basestation/publishers/web/web_engine.hpp"
#include "protocol/transport/posix_call.hpp"

namespace pitwall::publishers::web {

// One connection while it speaks HTTP.
class WebServer::Engine::HttpSession : public std::enable_shared_from_this<HttpSession> {
 public:
  HttpSession(Engine& engine, Tcp::socket&& socket) : engine_(engine), stream_(std::move(socket)) {}
  ~HttpSession() {
    if (!handed_on_) --engine_.connections;
  }

  void read() {
    parser_.emplace();
    parser_->body_limit(HttpResponder::kLayoutBytes);
    parser_->header_limit(kHeaderMax);
    stream_.expires_after(kHttpPatience);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](error_code failed, std::size_t) {
                       if (failed) return self->malformed(failed);
                       self->answer();
                     });
  }

 private:
  void malformed(const error_code& failed) {
    unsigned status = 400;
    if (failed == http::error::end_of_stream || failed == beast::error::timeout ||
        failed.category() == boost::system::system_category()) {
      return shut();
    }
    if (failed == http::error::body_limit) status = 413;
    if (failed == http::error::header_limit) status = 431;
    engine_.count([](WebCounters& c) { ++c.bad_http; });
    write(refusal(status, "malformed request: " + failed.message()), false, 11, false);
  }

  void answer() {
    const auto& request = parser_->get();
    const std::string host{view(request[http::field::host])};
    const HttpQuestion question{.method = view(request.method_string()),
                                .target = view(request.target()),
                                .host = host,
                                .origin = view(request[http::field::origin]),
                                .authorization = view(request[http::field::authorization]),
                                .accept_encoding = view(request[http::field::accept_encoding]),
                                .subprotocols = view(request[http::field::sec_websocket_protocol]),
                                .upgrade = websocket::is_upgrade(request),
                                .body = request.body()};
    HttpAnswer answer = engine_.desk.answer(question);
    if (answer.visitor) {
      if (const ClientId client = engine_.free_number(); client != 0) {
        return upgrade(client, std::move(answer));
      }
      answer = refusal(503, "all places for consoles are taken");
    }
    if (answer.status >= 400) engine_.count([](WebCounters& c) { ++c.refused_http; });
    write(std::move(answer), request.keep_alive(), request.version(),
          request.method() == http::verb::head);
  }

  void upgrade(ClientId client, HttpAnswer answer) {
    handed_on_ = true;
    auto socket = std::make_shared<Socket>(engine_, std::move(stream_), client, std::move(answer));
    engine_.sockets[client] = socket;
    socket->accept(parser_->get());
  }

  void write(HttpAnswer answer, bool keep_alive, unsigned version, bool only_head) {
    response_ = {};
    response_.version(version);
    response_.result(answer.status);
    response_.set(http::field::server, "pitwall-base");
    response_.set(http::field::cache_control, std::string{answer.cache});
    response_.set(http::field::content_type, std::string{answer.type});
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("Referrer-Policy", "no-referrer");
    response_.set("Cross-Origin-Resource-Policy", "same-origin");
    if (!answer.policy.empty()) response_.set("Content-Security-Policy", answer.policy);
    if (!answer.allow.empty()) response_.set(http::field::allow, std::string{answer.allow});
    if (answer.gzipped) response_.set(http::field::content_encoding, "gzip");
    response_.set(http::field::vary, "Accept-Encoding");
    response_.keep_alive(keep_alive);
    response_.content_length(answer.body ? answer.body->size() : 0);
    if (answer.body && !only_head) response_.body() = *answer.body;
    stream_.expires_after(kHttpPatience);
    head_ = head_of(response_);
    const std::array<asio::const_buffer, 2> parts{asio::buffer(head_),
                                                  asio::buffer(response_.body())};
    asio::async_write(stream_, parts,
                      [self = shared_from_this(), keep_alive](error_code failed, std::size_t) {
                        if (failed || !keep_alive) return self->shut();
                        self->read();
                      });
  }

  // As text, so that one kind of write serves all answers.
  static std::string head_of(http::response<http::string_body>& response) {
    http::response_serializer<http::string_body> serializer{response};
    serializer.split(true);
    std::string head;
    error_code never;
    serializer.next(
        never, [&head](error_code&, const auto& parts) { head = beast::buffers_to_string(parts); });
    return head;
  }

  void shut() {
    error_code ignored;
    stream_.socket().shutdown(Tcp::socket::shutdown_send, ignored);
  }

  Engine& engine_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  http::response<http::string_body> response_;
  std::string head_;
  bool handed_on_ = false;
};

void WebServer::Engine::run() {
  while (true) {
    try {
      io.run();
      return;
    } catch (const std::exception&) {
      count([](WebCounters& c) { ++c.faults; });
    }
  }
}

void WebServer::Engine::accept() {
  acceptor.async_accept([this](error_code failed, Tcp::socket socket) {
    if (failed == asio::error::operation_aborted) return;
    error_code ignored;
    if (failed) {
      // No descriptor is left, for example: another one comes free by itself.
    } else if (connections >= kConnections) {
      count([](WebCounters& c) { ++c.refused_room; });
    } else {
      ++connections;
      count([](WebCounters& c) { ++c.connections; });
      socket.set_option(Tcp::no_delay(true), ignored);
      socket.set_option(asio::socket_base::send_buffer_size(kSendBuffer), ignored);
      std::make_shared<HttpSession>(*this, std::move(socket))->read();
    }
    accept();
  });
}

void WebServer::Engine::tell(std::size_t car, ClientNews item) {
  Door& door = doors[car];
  {
    const std::lock_guard hold(lock);
    // kUnhandled bounds what is said; joining and leaving is bounded by kConnections.
    if (door.news.size() < kNewsMax || item.kind == ClientNews::Kind::kLeft) {
      door.news.push_back(std::move(item));
    }
  }
  const std::uint64_t one = 1;
  (void)transport::posix_call([&] { return ::write(door.bell.get(), &one, sizeof one); });
}

// Under the lock: the web thread takes what waits for it.
void WebServer::Engine::call() {
  if (std::exchange(post_under_way, true)) return;
  asio::post(io, [this] { deliver(); });
}

void WebServer::Engine::deliver() {
  std::vector<Post> due;
  std::map<std::string, Shown> fresh;
  {
    const std::lock_guard hold(lock);
    due.swap(posts);
    fresh.swap(shown);
    post_under_way = false;
  }
  for (auto& [path, document] : fresh) desk.show(path, std::move(document));
  for (const Post& post : due) {
    for (std::size_t client = kFirstClient; client <= kLastClient; ++client) {
      if (!post.to.test(client)) continue;
      const auto socket = sockets[client];
      if (socket == nullptr) continue;
      if (post.message) {
        socket->send(post.message);
      } else {
        socket->handled();
      }
    }
  }
}

// The next after the newest that is free, so that a number is not soon another console's.
ClientId WebServer::Engine::free_number() {
  for (int tried = 0; tried <= kLastClient - kFirstClient; ++tried) {
    newest = newest >= kLastClient ? kFirstClient : static_cast<ClientId>(newest + 1);
    if (sockets[newest] == nullptr) return newest;
  }
  return 0;
}

Result<std::unique_ptr<WebServer>, Problem> WebServer::start(transport::UdpAddress listen,
                                                             HttpConfig config) {
  const Tcp::endpoint endpoint{asio::ip::address_v4{listen.ip}, listen.port};
  if (config.cars.size() > kCars) {
    return Unexpected{Problem{"--web", "at most " + std::to_string(kCars) + " cars"}};
  }
  std::unique_ptr<Engine> engine;
  try {
    engine = std::make_unique<Engine>(endpoint, std::move(config));
  } catch (const boost::system::system_error& failed) {
    const bool taken = failed.code() == boost::system::errc::address_in_use;
    return Unexpected{Problem{"--web " + to_string(listen),
                              taken ? "another program serves this port; end it or take another one"
                                    : failed.code().message()}};
  } catch (const std::exception& failed) {
    return Unexpected{Problem{"--web " + to_string(listen), failed.what()}};
  }
  for (Engine::Door& door : engine->doors) {
    door.bell = transport::FileDescriptor{
        transport::posix_call([] { return ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK); })};
  }
  engine->accept();
  engine->thread = std::thread([raw = engine.get()] { raw->run(); });
  return std::unique_ptr<WebServer>{new WebServer(std::move(engine))};
}

WebServer::WebServer(std::unique_ptr<Engine> engine) : engine_(std::move(engine)) {}

WebServer::~WebServer() {
  engine_->io.stop();
  engine_->thread.join();
  engine_->sockets = {};
}

transport::UdpAddress WebServer::local() const {
  const Tcp::endpoint at = engine_->acceptor.local_endpoint();
  return {.ip = at.address().to_v4().to_uint(), .port = at.port()};
}

int WebServer::fd(std::size_t car) const { return engine_->doors[car].bell.get(); }

std::optional<ClientNews> WebServer::next_news(std::size_t car) {
  Engine::Door& door = engine_->doors[car];
  std::optional<ClientNews> item;
  {
    const std::lock_guard hold(engine_->lock);
    if (door.news.empty()) {
      // Under the lock: what is told from now on rings again.
      std::uint64_t rung = 0;
      (void)transport::posix_call([&] { return ::read(door.bell.get(), &rung, sizeof rung); });
      return item;
    }
    item = std::move(door.news.front());
    door.news.pop_front();
  }
  if (item->kind == ClientNews::Kind::kSaid || item->kind == ClientNews::Kind::kBinary) {
    send(ClientSet{}.set(item->client), nullptr);
  }
  return item;
}

void WebServer::send(const ClientSet& to, SharedMessage message) {
  if (to.none()) return;
  const std::lock_guard hold(engine_->lock);
  if (engine_->posts.size() >= kPostsMax && message != nullptr) {
    ++engine_->counters.posts_dropped;
    return;
  }
  engine_->posts.push_back({to, std::move(message)});
  engine_->call();
}

void WebServer::show(const std::string& path, Shown document) {
  const std::lock_guard hold(engine_->lock);
  engine_->shown.insert_or_assign(path, std::move(document));
  engine_->call();
}

std::vector<Drop> WebServer::take_drops() {
  const std::lock_guard hold(engine_->lock);
  std::vector<Drop> taken;
  for (const auto& [key, count] : std::exchange(engine_->drops, {})) {
    taken.push_back({.client = key.first, .tag = key.second, .count = count});
  }
  return taken;
}

WebCounters WebServer::counters() const {
  const std::lock_guard hold(engine_->lock);
  return engine_->counters;
}

}  // namespace pitwall::publishers::web
