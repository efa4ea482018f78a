// The other end of a WebSocket for tests: Beast's client, and a bare socket for what no client
// would say. Beast is behind this header: it costs a file that includes it nothing.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pitwall::publishers::web {

class Browser {
 public:
  using Fields = std::vector<std::pair<std::string, std::string>>;

  Browser();
  ~Browser();
  Browser(Browser&&) noexcept;
  Browser& operator=(Browser&&) noexcept;

  // Whether the socket was opened; else the status of the refusal.
  unsigned open(std::uint16_t port, const std::string& target = "/ws", const Fields& fields = {},
                int receive_buffer = 0);
  void say(const std::string& text);
  void say_bytes(const std::string& bytes);
  struct Received {
    bool text = false;
    std::string bytes;
  };
  // None: closed; close_code() says why.
  std::optional<Received> receive();
  unsigned close_code() const;

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

// A connection on which nobody says anything.
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

// What a browser says to open a WebSocket.
std::string opening(const std::string& target = "/ws", const std::string& host = "127.0.0.1",
                    const std::string& fields = {});

// Says these bytes and gives what comes back until the end.
std::string bare(std::uint16_t port, const std::string& bytes, bool hang_up = true);

}  // namespace pitwall::publishers::web
