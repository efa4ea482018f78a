// Foxglove client for tests: reads the server's messages by type.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>

#include "protocol/json/json_value.hpp"
#include "tests/support/web_client.hpp"

namespace pitwall::publishers::foxglove {

class Viewer {
 public:
  // Returns the HTTP status; 101 if the socket is open.
  unsigned open(std::uint16_t port, const std::string& protocol = "foxglove.sdk.v1",
                const std::string& origin = {}) {
    web::WebClient::Fields fields{{"Sec-WebSocket-Protocol", protocol}};
    if (!origin.empty()) fields.emplace_back("Origin", origin);
    return web_client_.open(port, "/", fields);
  }
  // The channel ids of the advertisement, by topic. Reads the serverInfo message before it.
  std::map<std::string, int> channels() {
    info_ = text("serverInfo");
    std::map<std::string, int> ids;
    const json::JsonValue reported = text("advertise");
    for (const auto& row : reported.items("channels")) {
      ids[row.text("topic")] = static_cast<int>(row.number("id"));
    }
    return ids;
  }
  const json::JsonValue& info() const { return info_; }
  void subscribe(int id, int channel) {
    web_client_.send_text(R"({"op":"subscribe","subscriptions":[{"id":)" + std::to_string(id) +
                          R"(,"channelId":)" + std::to_string(channel) + "}]}");
  }
  // The next text message with this op; other texts and binary messages before it are skipped.
  json::JsonValue text(const std::string& op) {
    while (const auto received = web_client_.receive()) {
      if (!received->text) continue;
      const auto value = json::JsonValue::parse(received->bytes, "text");
      if (value && value->text("op") == op) return *value;
    }
    ADD_FAILURE() << "closed before a " << op;
    return {};
  }
  // The next binary message that begins with this op.
  std::string bytes(char op) {
    while (const auto received = web_client_.receive()) {
      if (!received->text && received->bytes.at(0) == op) return received->bytes;
    }
    ADD_FAILURE() << "closed before a binary message";
    return {};
  }
  web::WebClient& web_client() { return web_client_; }

 private:
  web::WebClient web_client_;
  json::JsonValue info_;
};

}  // namespace pitwall::publishers::foxglove
