// SPDX-License-Identifier: Apache-2.0
#include "tests/support/web_client.hpp"

#include <array>
#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/stream.hpp>

namespace pitwall::publishers::web {

struct WebClient::Stream {
  static constexpr bool kCompressed = false;  // no permessage-deflate
  boost::asio::io_context io;
  boost::beast::websocket::stream<boost::asio::ip::tcp::socket, kCompressed> socket{io};
};

WebClient::WebClient() : stream_(std::make_unique<Stream>()) {}
WebClient::~WebClient() = default;
WebClient::WebClient(WebClient&&) noexcept = default;
WebClient& WebClient::operator=(WebClient&&) noexcept = default;

unsigned WebClient::open(std::uint16_t port, const std::string& target, const Fields& fields,
                         int receive_buffer) {
  namespace websocket = boost::beast::websocket;
  auto& socket = stream_->socket.next_layer();
  socket.open(boost::asio::ip::tcp::v4());
  if (receive_buffer > 0) {
    socket.set_option(boost::asio::socket_base::receive_buffer_size(receive_buffer));
  }
  socket.connect({boost::asio::ip::address_v4::loopback(), port});
  stream_->socket.set_option(
      websocket::stream_base::decorator([fields](websocket::request_type& request) {
        for (const auto& [name, value] : fields) request.set(name, value);
      }));
  websocket::response_type response;
  boost::system::error_code failed;
  stream_->socket.handshake(response, "127.0.0.1:" + std::to_string(port), target, failed);
  return response.result_int();
}

void WebClient::send_text(const std::string& text) {
  boost::system::error_code failed;
  stream_->socket.text(true);
  stream_->socket.write(boost::asio::buffer(text), failed);
}

void WebClient::send_bytes(const std::string& bytes) {
  boost::system::error_code failed;
  stream_->socket.binary(true);
  stream_->socket.write(boost::asio::buffer(bytes), failed);
}

std::optional<WebClient::Received> WebClient::receive() {
  boost::beast::flat_buffer buffer;
  boost::system::error_code failed;
  stream_->socket.read(buffer, failed);
  if (failed) return std::nullopt;
  return Received{stream_->socket.got_text(), boost::beast::buffers_to_string(buffer.data())};
}

unsigned WebClient::close_code() const { return stream_->socket.reason().code; }

struct Silent::Connection {
  boost::asio::io_context io;
  boost::asio::ip::tcp::socket socket{io};
};

Silent::Silent(std::uint16_t port) : connection_(std::make_unique<Connection>()) {
  connection_->socket.connect({boost::asio::ip::address_v4::loopback(), port});
}
Silent::~Silent() = default;

bool Silent::is_closed() {
  char byte = 0;
  boost::system::error_code failed;
  connection_->socket.read_some(boost::asio::buffer(&byte, 1), failed);
  return failed == boost::asio::error::eof || failed == boost::asio::error::connection_reset;
}

std::string opening(const std::string& target, const std::string& host, const std::string& fields) {
  return "GET " + target + " HTTP/1.1\r\nHost: " + host + "\r\n" + fields +
         "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
}

std::string bare(std::uint16_t port, const std::string& bytes, bool hang_up) {
  boost::asio::io_context io;
  boost::asio::ip::tcp::socket socket(io);
  boost::system::error_code failed;
  socket.connect({boost::asio::ip::address_v4::loopback(), port});
  boost::asio::write(socket, boost::asio::buffer(bytes), failed);
  if (hang_up) socket.shutdown(boost::asio::ip::tcp::socket::shutdown_send, failed);
  std::string answer;
  std::array<char, 4'096> part{};
  while (true) {
    const std::size_t n = socket.read_some(boost::asio::buffer(part), failed);
    answer.append(part.data(), n);
    if (failed) return answer;
  }
}

}  // namespace pitwall::publishers::web
