// Fixture of the web server, with its client events and messages for its clients.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "basestation/publishers/web/web_server.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "tests/support/web_client.hpp"

namespace pitwall::publishers::web {

inline SharedMessage text(std::string text) {
  return std::make_shared<const Message>(Message{.text = std::move(text)});
}
inline SharedMessage vehicle(std::uint32_t sequence, std::size_t bytes = 3'000) {
  Frame frame{.sequence = sequence};
  frame.entries.resize(bytes);
  return std::make_shared<const Message>(Message{.frame = std::move(frame)});
}

inline constexpr const char* kOperatorToken = "8f2c41d09b7a4d51";

class WebServerTest : public testing::Test {
 protected:
  void SetUp() override {
    HttpConfig config;
    config.documents.emplace("/api/track", "{\"name\": \"X\"}");
    config.console = "/nowhere";
    config.cars.push_back({.number = 7});
    config.access.tokens = std::make_shared<TokenStore>(
        *Tokens::parse(std::string{"operator "} + kOperatorToken + " Anna\n", "tokens"));
    auto started = WebServer::start({}, std::move(config));
    ASSERT_TRUE(started) << to_string(started.error());
    server_ = *std::move(started);
    port_ = server_->local().port;
  }
  // Waits for the next event of this kind; other events before it are dropped.
  std::optional<ClientEvent> wait_for(ClientEvent::Kind kind) {
    constexpr Duration kTimeout = seconds(20);
    const Instant end = transport::monotonic_now() + kTimeout;
    while (transport::monotonic_now() < end) {
      while (auto news = server_->next_event()) {
        if (news->kind == kind) return news;
      }
      const int fd = server_->fd();
      transport::wait_readable({&fd, 1}, end);
    }
    return std::nullopt;
  }
  ClientId join(WebClient& web_client, const WebClient::Fields& fields = {}) {
    EXPECT_EQ(web_client.open(port_, "/ws", fields), 101u);
    const auto news = wait_for(ClientEvent::Kind::kJoined);
    EXPECT_TRUE(news);
    return news ? news->client : ClientId{0};
  }
  ClientId join_as_operator(WebClient& web_client) {
    return join(web_client, {{"Authorization", std::string{"Bearer "} + kOperatorToken}});
  }
  static ClientSet only(ClientId client) { return ClientSet{}.set(client); }

  std::unique_ptr<WebServer> server_;
  std::uint16_t port_ = 0;
};

}  // namespace pitwall::publishers::web
