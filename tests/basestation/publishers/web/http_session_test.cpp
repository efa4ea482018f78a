// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "tests/basestation/publishers/web/server_fixture.hpp"

namespace pitwall::publishers::web {
namespace {

using HttpSession = WebServerTest;

TEST_F(HttpSession, AForeignPageOrAWrongTokenGetsNoSocket) {
  const auto asked = [&](const std::string& target, const std::string& host,
                         const std::string& fields) {
    return bare(port_, opening(target, host, fields))
        .substr(0, std::string_view{"HTTP/1.1 403"}.size());
  };
  const std::string own = "127.0.0.1:" + std::to_string(port_);
  EXPECT_EQ(asked("/ws", own, "Origin: http://evil.com\r\n"), "HTTP/1.1 403");
  EXPECT_EQ(asked("/ws", "evil.com", "Origin: http://evil.com\r\n"), "HTTP/1.1 403");
  EXPECT_EQ(asked("/ws", own, "Authorization: Bearer 0123456789abcdef\r\n"), "HTTP/1.1 401");
  EXPECT_EQ(asked("/socket", own, ""), "HTTP/1.1 404");
  EXPECT_EQ(asked("/ws", own, "Origin: http://" + own + "\r\n"), "HTTP/1.1 101");
  WebClient foreign;
  EXPECT_NE(foreign.open(port_, "/ws", {{"Origin", "http://evil.com"}}), 101u);
}

TEST_F(HttpSession, MalformedHttpIsRefusedWithALine) {
  EXPECT_TRUE(bare(port_, "NONSENSE\r\n\r\n").starts_with("HTTP/1.1 400"));
  EXPECT_TRUE(bare(port_, "GET / HTTP/9.9\r\n\r\n").starts_with("HTTP/1.1 400"));
  const std::string host = "Host: 127.0.0.1\r\n";
  EXPECT_TRUE(
      bare(port_, "GET / HTTP/1.1\r\n" + host + "X: " + std::string(20'000, 'x') + "\r\n\r\n")
          .starts_with("HTTP/1.1 431"));
  EXPECT_TRUE(
      bare(port_, "PUT /api/layouts/a HTTP/1.1\r\n" + host + "Content-Length: 999999999\r\n\r\n")
          .starts_with("HTTP/1.1 413"));
  EXPECT_TRUE(bare(port_, "GET /../../etc/passwd HTTP/1.1\r\n" + host + "\r\n")
                  .starts_with("HTTP/1.1 404"));
  EXPECT_TRUE(
      bare(port_, "DELETE /api/track HTTP/1.1\r\n" + host + "\r\n").starts_with("HTTP/1.1 405"));
  const std::string good = bare(port_, "GET /api/track HTTP/1.1\r\n" + host + "\r\n");
  EXPECT_TRUE(good.starts_with("HTTP/1.1 200"));
  EXPECT_TRUE(good.ends_with("{\"name\": \"X\"}"));
  const std::string head = bare(port_, "HEAD /api/track HTTP/1.1\r\n" + host + "\r\n");
  EXPECT_TRUE(head.ends_with("\r\n\r\n"));
  EXPECT_NE(head.find("Content-Length: 13"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::publishers::web
