// WebSocket client for tests: Beast's client, and a bare socket for input that no client sends. The
// Beast headers are not included here, so that including this file stays cheap.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pitwall::publishers::web {

class WebClient {
 public:
  using Fields = std::vector<std::pair<std::string, std::string>>;

  WebClient();
  ~WebClient();
  WebClient(WebClient&&) noexcept;
  WebClient& operator=(WebClient&&) noexcept;

  // HTTP status of the handshake: 101 if the socket is open, otherwise that of the refusal.
  unsigned open(std::uint16_t port, const std::string& target = "/ws", const Fields& fields = {},
                int receive_buffer = 0);
  void send_text(const std::string& text);
  void send_bytes(const std::string& bytes);
  struct Received {
    bool text = false;
    std::string bytes;
  };
  // nullopt if the connection is closed; close_code() has the reason.
  std::optional<Received> receive();
  unsigned close_code() const;

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

// A TCP connection that sends nothing.
class Silent {
 public:
  explicit Silent(std::uint16_t port);
  ~Silent();
  // Waits until the other end has closed it.
  bool is_closed();

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

// HTTP request with which a client opens a WebSocket.
std::string opening(const std::string& target = "/ws", const std::string& host = "127.0.0.1",
                    const std::string& fields = {});

// Sends these bytes and returns everything received until the connection ends. `hang_up` closes the
// sending side after the bytes.
std::string bare(std::uint16_t port, const std::string& bytes, bool hang_up = true);

}  // namespace pitwall::publishers::web
