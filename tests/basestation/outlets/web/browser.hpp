// The other end of a WebSocket for tests: Beast's client, and a bare socket for what no client
// would say.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pitwall::outlets::web {

class Browser {
 public:
  using Fields = std::vector<std::pair<std::string, std::string>>;

  // Whether the socket was opened; else the status of the refusal.
  unsigned open(std::uint16_t port, const std::string& target = "/ws", const Fields& fields = {},
                int receive_buffer = 0) {
    namespace websocket = boost::beast::websocket;
    auto& socket = stream_.next_layer();
    socket.open(boost::asio::ip::tcp::v4());
    if (receive_buffer > 0) {
      socket.set_option(boost::asio::socket_base::receive_buffer_size(receive_buffer));
    }
    socket.connect({boost::asio::ip::address_v4::loopback(), port});
    stream_.set_option(websocket::stream_base::decorator([fields](websocket::request_type& r) {
      for (const auto& [name, value] : fields) r.set(name, value);
    }));
    websocket::response_type response;
    boost::system::error_code failed;
    stream_.handshake(response, "127.0.0.1:" + std::to_string(port), target, failed);
    return response.result_int();
  }
  void say(const std::string& text) {
    boost::system::error_code failed;
    stream_.text(true);
    stream_.write(boost::asio::buffer(text), failed);
  }
  void say_bytes(const std::string& bytes) {
    boost::system::error_code failed;
    stream_.binary(true);
    stream_.write(boost::asio::buffer(bytes), failed);
  }
  struct Heard {
    bool text = false;
    std::string bytes;
  };
  // None: closed; close_code() says why.
  std::optional<Heard> hear() {
    boost::beast::flat_buffer buffer;
    boost::system::error_code failed;
    stream_.read(buffer, failed);
    if (failed) return std::nullopt;
    return Heard{stream_.got_text(), boost::beast::buffers_to_string(buffer.data())};
  }
  unsigned close_code() const { return stream_.reason().code; }

 private:
  boost::asio::io_context io_;
  boost::beast::websocket::stream<boost::asio::ip::tcp::socket> stream_{io_};
};

// What a browser says to open a WebSocket.
inline std::string opening(const std::string& target = "/ws", const std::string& host = "127.0.0.1",
                           const std::string& fields = {}) {
  return "GET " + target + " HTTP/1.1\r\nHost: " + host + "\r\n" + fields +
         "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
}

// Says these bytes and gives what comes back until the end.
inline std::string bare(std::uint16_t port, const std::string& bytes, bool hang_up = true) {
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

}  // namespace pitwall::outlets::web
