// HTTP session of one connection, until it ends or becomes the WebSocket of a console. Only for
// web_server.cpp, because it includes Boost.Beast.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <openssl/err.h>
#include <openssl/ssl.h>

#include <array>
#include <boost/asio/write.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/serializer.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "basestation/publishers/web/web_engine.hpp"

namespace pitwall::publishers::web {

class WebServer::Engine::HttpSession : public std::enable_shared_from_this<HttpSession> {
 public:
  HttpSession(Engine& engine, Wire&& wire, PendingConnections::Connection number)
      : engine_(engine), stream_(std::move(wire)), number_(number) {}
  ~HttpSession() {
    engine_.waiting.leave(number_);
    engine_.sessions.erase(number_);
    if (!handed_on_) --engine_.connections;
  }

  void begin() {
    if (stream_.tls() == nullptr) return read();
    stream_.next_layer().expires_after(kHttpTimeout);
    stream_.tls()->async_handshake(asio::ssl::stream_base::server,
                                   [self = shared_from_this()](error_code failed) {
                                     if (failed) return self->no_tls(failed);
                                     self->read();
                                   });
  }

  void cut() {
    error_code ignored;
    stream_.next_layer().socket().close(ignored);
  }

  // Answers the request that has been read.
  void finish(HttpAnswer answer) {
    const auto& request = parser_->get();
    if (answer.status >= 400) engine_.count([](WebCounters& c) { ++c.refused_http; });
    write(std::move(answer), request.keep_alive(), request.version(),
          request.method() == http::verb::head);
  }

  void read() {
    parser_.emplace();
    parser_->body_limit(HttpResponder::kLayoutBytes);
    parser_->header_limit(kHeaderMax);
    stream_.next_layer().expires_after(kHttpTimeout);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](error_code failed, std::size_t) {
                       if (failed) return self->malformed(failed);
                       self->engine_.waiting.receive(self->number_);
                       self->answer();
                     });
  }

 private:
  // A client that sends plain HTTP to a TLS port gets the reason in plain HTTP.
  void no_tls(const error_code& failed) {
    engine_.count([](WebCounters& c) { ++c.refused_tls; });
    if (failed.category() != asio::error::get_ssl_category() ||
        ERR_GET_REASON(static_cast<unsigned long>(failed.value())) != SSL_R_HTTP_REQUEST)
      return;
    head_ =
        "HTTP/1.1 400 Bad Request\r\nContent-Type: text/plain; charset=utf-8\r\n"
        "Connection: close\r\n\r\nthis port speaks HTTPS and WSS only\n";
    asio::async_write(stream_.next_layer(), asio::buffer(head_),
                      [self = shared_from_this()](error_code, std::size_t) { self->shut(); });
  }

  void malformed(const error_code& failed) {
    unsigned status = 400;
    if (failed == http::error::end_of_stream || failed == beast::error::timeout ||
        failed.category() == boost::system::system_category() ||
        failed.category() == asio::error::get_ssl_category() ||
        failed == asio::ssl::error::stream_truncated) {
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
                                .cookie = view(request[http::field::cookie]),
                                .forwarded_proto = view(request["X-Forwarded-Proto"]),
                                .upgrade = websocket::is_upgrade(request),
                                .body = request.body()};
    HttpAnswer answer = engine_.responder.answer(question);
    if (answer.visitor) {
      if (const ClientId client = engine_.free_number(answer.visitor->role); client != 0) {
        return upgrade(client, std::move(answer));
      }
      engine_.count([](WebCounters& c) { ++c.refused_places; });
      answer =
          refusal(503, "no connection is free: the base serves its largest number of consoles");
    }
    if (answer.page.empty()) return finish(std::move(answer));
    if (engine_.awaiting.size() >= kPagesMax)
      return finish(refusal(503, "too many pages are asked for at once; try again"));
    const std::uint64_t number = ++engine_.newest_request;
    engine_.awaiting[number] = shared_from_this();
    engine_.publish(answer.car, Role::kViewer,
                    {.kind = ClientEvent::Kind::kPage, .text = answer.page, .request = number});
  }

  void upgrade(ClientId client, HttpAnswer answer) {
    handed_on_ = true;
    engine_.waiting.leave(number_);
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
    for (const std::string& cookie : answer.set_cookies)
      response_.insert(http::field::set_cookie, cookie);
    if (!answer.allow.empty()) response_.set(http::field::allow, std::string{answer.allow});
    if (answer.gzipped) response_.set(http::field::content_encoding, "gzip");
    response_.set(http::field::vary, "Accept-Encoding");
    response_.keep_alive(keep_alive);
    response_.content_length(answer.body ? answer.body->size() : 0);
    if (answer.body && !only_head) response_.body() = *answer.body;
    stream_.next_layer().expires_after(kHttpTimeout);
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
    if (stream_.tls() != nullptr) {
      stream_.next_layer().expires_after(kClosing);
      return stream_.tls()->async_shutdown([self = shared_from_this()](error_code) {});
    }
    error_code ignored;
    stream_.next_layer().socket().shutdown(Tcp::socket::shutdown_send, ignored);
  }

  Engine& engine_;
  Wire stream_;
  PendingConnections::Connection number_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  http::response<http::string_body> response_;
  std::string head_;
  bool handed_on_ = false;
};

}  // namespace pitwall::publishers::web
