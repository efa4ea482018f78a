// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/web_server.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include <boost/asio/post.hpp>
#include <exception>

#include "basestation/publishers/web/admission/memory_reserve.hpp"
#include "basestation/publishers/web/admission/room_left.hpp"
#include "basestation/publishers/web/http_session.hpp"
#include "basestation/publishers/web/web_engine.hpp"
#include "protocol/transport/posix_call.hpp"

namespace pitwall::publishers::web {

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
    if (!failed) {
      accepted(std::move(socket));
      return accept();
    }
    refuse(&WebCounters::refused_short, "connections: " + failed.message());
    accepting.expires_after(kAcceptPause);
    accepting.async_wait([this](error_code cancelled) {
      if (!cancelled) accept();
    });
  });
}

void WebServer::Engine::accepted(Tcp::socket socket) {
  if (const std::string why = no_room_for(socket); !why.empty())
    return refuse(&WebCounters::refused_short, why);
  if (connections >= kConnections)
    return refuse(&WebCounters::refused_room,
                  "connections: all of " + std::to_string(kConnections) + " are taken");
  ++connections;
  ++new_clients;
  count([](WebCounters& c) { ++c.connections; });
  error_code ignored;
  socket.set_option(Tcp::no_delay(true), ignored);
  socket.set_option(asio::socket_base::send_buffer_size(kSendBuffer), ignored);
  const auto from = socket.remote_endpoint(ignored).address();
  const std::uint32_t address = from.is_v4() ? from.to_v4().to_uint() : 0;
  Wire wire = context ? Wire{std::move(socket), *context} : Wire{std::move(socket)};
  const auto number = ++newest_connection;
  const auto session = std::make_shared<HttpSession>(*this, std::move(wire), number);
  sessions[number] = session;
  if (const auto goes = waiting.add(number, address)) {
    count([](WebCounters& c) { ++c.closed_waiting; });
    if (const auto silent = sessions[*goes].lock()) silent->cut();
  }
  session->begin();
}

std::string WebServer::Engine::no_room_for(const Tcp::socket& socket) const {
  // native_handle() is not const for an asio socket; the number is all that is asked for.
  const int descriptor = const_cast<Tcp::socket&>(socket).native_handle();
  std::string why = short_of_descriptors(descriptor);
  if (!why.empty()) return why;
  if (!reserve_is_held()) return "memory: an allocation failed, the reserve is in use";
  return short_of_memory(memory_use(),
                         kMemoryToAccept + (new_clients + earlier_clients) * kMemoryPerClient);
}

void WebServer::Engine::refuse(std::uint64_t WebCounters::*counter, const std::string& why) {
  count([counter](WebCounters& c) { ++(c.*counter); });
  const Instant now = transport::wall_now();
  const std::string what = why.substr(0, why.find(':'));
  if (what == last_refusal && last_refusal_at && now - *last_refusal_at < kLogRepeatPeriod) return;
  last_refusal = what;
  last_refusal_at = now;
  responder.config().log("console refused: " + why);
}

void WebServer::Engine::run_housekeeping() {
  housekeeping_timer.expires_after(kHousekeepingPeriod);
  housekeeping_timer.async_wait([this](error_code cancelled) {
    if (cancelled) return;
    const auto changed = responder.config().access.tokens->refresh();
    if (!changed) responder.config().log("tokens unchanged: " + to_string(changed.error()));
    if (changed && *changed) drop_revoked();
    earlier_clients = std::exchange(new_clients, 0);
    make_room();
    run_housekeeping();
  });
}

void WebServer::Engine::drop_revoked() {
  for (const auto& socket : sockets) {
    if (socket == nullptr || responder.config().access.tokens->may_stay(socket->who())) continue;
    count([](WebCounters& c) { ++c.closed_revoked; });
    responder.config().log("token of " + socket->who().name + " no longer holds: console closed");
    socket->close(websocket::close_code::policy_error);
  }
}

void WebServer::Engine::make_room() {
  if (!short_of_memory(memory_use(), kMemoryToKeep).empty()) return drop_largest();
  if (!reserve_is_held()) hold_reserve();
}

void WebServer::Engine::drop_largest() {
  std::shared_ptr<Socket> largest;
  for (const auto& socket : sockets) {
    if (socket == nullptr || socket->who().role == Role::kOperator) continue;
    if (socket->unread_bytes() == 0) continue;
    if (largest == nullptr || socket->unread_bytes() > largest->unread_bytes()) largest = socket;
  }
  if (largest == nullptr) return;
  count([](WebCounters& c) { ++c.closed_short; });
  largest->cut();
}

void WebServer::Engine::drop_newest() {
  for (std::size_t back = 0; back < sockets.size(); ++back) {
    const auto socket = sockets[(newest + sockets.size() - back) % sockets.size()];
    if (socket == nullptr || socket->who().role == Role::kOperator) continue;
    count([](WebCounters& c) { ++c.closed_short; });
    return socket->cut();
  }
}

void WebServer::Engine::publish(std::size_t car, Role by, ClientEvent item) {
  EventQueues& queue = queues[car];
  {
    const std::lock_guard hold(lock);
    auto& news = by == Role::kOperator ? queue.operators : queue.viewers;
    // kUnhandled bounds what is said; kConnections bounds joining and leaving, kPagesMax pages.
    using enum ClientEvent::Kind;
    if (item.kind == kLeft) queue.leaving.set(item.client);
    if (news.size() < kNewsMax || item.kind == kLeft || item.kind == kPage)
      news.push_back(std::move(item));
  }
  const std::uint64_t one = 1;
  (void)transport::posix_call([&] { return ::write(queue.event_fd.get(), &one, sizeof one); });
}

// Under the lock: the web thread takes what waits for it.
void WebServer::Engine::call() {
  if (std::exchange(post_under_way, true)) return;
  asio::post(io, [this] { deliver(); });
}

void WebServer::Engine::deliver() {
  if (!reserve_is_held()) drop_newest();
  std::vector<Post> due;
  std::map<std::string, Shown> fresh;
  std::map<std::uint64_t, HttpAnswer> answered;
  {
    const std::lock_guard hold(lock);
    due.swap(posts);
    fresh.swap(shown);
    answered.swap(answers);
    post_under_way = false;
  }
  for (auto& [path, document] : fresh) responder.show(path, std::move(document));
  for (auto& [request, answer] : answered) {
    if (const auto session = awaiting.extract(request)) session.mapped()->finish(std::move(answer));
  }
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
ClientId WebServer::Engine::free_number(Role role) {
  ClientSet leaving;
  {
    const std::lock_guard hold(lock);
    for (const EventQueues& queue : queues) leaving |= queue.leaving;
  }
  const auto is_free = [&](ClientId client) {
    return sockets[client] == nullptr && !leaving.test(client);
  };
  std::size_t free = 0;
  for (std::size_t client = kFirstClient; client <= kLastClient; ++client) {
    if (is_free(static_cast<ClientId>(client))) ++free;
  }
  if (free <= (role == Role::kOperator ? 0 : kReserved)) return 0;
  do {
    newest = newest >= kLastClient ? kFirstClient : static_cast<ClientId>(newest + 1);
  } while (!is_free(newest));
  return newest;
}

Result<std::unique_ptr<WebServer>, Problem> WebServer::start(UdpAddress listen, HttpConfig config) {
  const Tcp::endpoint endpoint{asio::ip::address_v4{listen.ip}, listen.port};
  if (config.cars.size() > kCars) {
    return Unexpected{Problem{"--web", "expected at most " + std::to_string(kCars) + " cars"}};
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
  for (Engine::EventQueues& queue : engine->queues) {
    queue.event_fd = transport::FileDescriptor{
        transport::posix_call([] { return ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK); })};
  }
  if (!hold_reserve()) {
    return Unexpected{
        Problem{"--web " + to_string(listen), "no memory for the reserve of the server"}};
  }
  engine->accept();
  engine->run_housekeeping();
  engine->thread = std::thread([raw = engine.get()] { raw->run(); });
  return std::unique_ptr<WebServer>{new WebServer(std::move(engine))};
}

WebServer::WebServer(std::unique_ptr<Engine> engine) : engine_(std::move(engine)) {}

WebServer::~WebServer() {
  engine_->io.stop();
  engine_->thread.join();
  engine_->sockets = {};
  engine_->awaiting = {};
}

UdpAddress WebServer::local() const {
  const Tcp::endpoint at = engine_->acceptor.local_endpoint();
  return {.ip = at.address().to_v4().to_uint(), .port = at.port()};
}

int WebServer::fd(std::size_t car) const { return engine_->queues[car].event_fd.get(); }

std::optional<ClientEvent> WebServer::next_event(std::size_t car) {
  Engine::EventQueues& queue = engine_->queues[car];
  std::optional<ClientEvent> item;
  {
    const std::lock_guard hold(engine_->lock);
    auto& news = queue.operators.empty() ? queue.viewers : queue.operators;
    if (news.empty()) {
      // Under the lock: what is told from now on rings again.
      std::uint64_t count = 0;
      (void)transport::posix_call(
          [&] { return ::read(queue.event_fd.get(), &count, sizeof count); });
      return item;
    }
    item = std::move(news.front());
    news.pop_front();
    if (item->kind == ClientEvent::Kind::kLeft) queue.leaving.reset(item->client);
  }
  if (item->kind == ClientEvent::Kind::kText || item->kind == ClientEvent::Kind::kBinary) {
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

void WebServer::answer(std::uint64_t request, HttpAnswer answer) {
  const std::lock_guard hold(engine_->lock);
  engine_->answers.insert_or_assign(request, std::move(answer));
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
