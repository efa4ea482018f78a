// Stream of one connection of the web server: TCP, or TLS over TCP. It is one type, so that HTTP
// and WebSocket are compiled once for both.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/ssl/ssl_stream.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <memory>
#include <utility>

namespace pitwall::publishers::web {

class Wire {
 public:
  using Tcp = boost::beast::tcp_stream;
  using Tls = boost::beast::ssl_stream<Tcp>;
  using next_layer_type = Tcp;
  using executor_type = Tcp::executor_type;

  explicit Wire(boost::asio::ip::tcp::socket&& socket)
      : plain_(std::make_unique<Tcp>(std::move(socket))) {}
  Wire(boost::asio::ip::tcp::socket&& socket, boost::asio::ssl::context& context)
      : tls_(std::make_unique<Tls>(std::move(socket), context)) {}

  executor_type get_executor() { return next_layer().get_executor(); }
  Tcp& next_layer() { return tls_ ? tls_->next_layer() : *plain_; }
  const Tcp& next_layer() const { return tls_ ? std::as_const(*tls_).next_layer() : *plain_; }
  Tls* tls() { return tls_.get(); }

  template <class Buffers, class Done>
  void async_read_some(const Buffers& into, Done&& done) {
    if (tls_) return tls_->async_read_some(into, std::forward<Done>(done));
    plain_->async_read_some(into, std::forward<Done>(done));
  }
  template <class Buffers, class Done>
  void async_write_some(const Buffers& from, Done&& done) {
    if (tls_) return tls_->async_write_some(from, std::forward<Done>(done));
    plain_->async_write_some(from, std::forward<Done>(done));
  }

 private:
  std::unique_ptr<Tcp> plain_;
  std::unique_ptr<Tls> tls_;
};

// End of a WebSocket over a Wire; Boost.Beast finds these by argument-dependent lookup.
template <class Done>
void async_teardown(boost::beast::role_type role, Wire& wire, Done&& done) {
  if (wire.tls() != nullptr) return wire.tls()->async_shutdown(std::forward<Done>(done));
  boost::beast::async_teardown(role, wire.next_layer(), std::forward<Done>(done));
}
inline void teardown(boost::beast::role_type role, Wire& wire, boost::system::error_code& failed) {
  boost::beast::websocket::teardown(role, wire.next_layer().socket(), failed);
}

}  // namespace pitwall::publishers::web
