// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <thread>
#include <vector>

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

// The client's end of a request waits for the answer in a thread of its own.
class PageRequest {
 public:
  PageRequest(std::uint16_t port, const std::string& method)
      : thread_([this, port, method] {
          answer_ = bare(port,
                         method + " /bench/7/runs/1/report.html HTTP/1.1\r\n" +
                             "Host: 127.0.0.1\r\nConnection: close\r\n\r\n",
                         false);
        }) {}
  std::string answer() {
    thread_.join();
    return answer_;
  }

 private:
  std::string answer_;
  std::thread thread_;
};

TEST_F(HttpSession, APageOfABenchIsAnsweredWhenItIsThere) {
  PageRequest get{port_, "GET"};
  const auto asked = wait_for(ClientEvent::Kind::kPage);
  ASSERT_TRUE(asked);
  EXPECT_EQ(asked->text, "runs/1/report.html");
  EXPECT_TRUE(
      bare(port_, "GET /api/track HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n").starts_with("HTTP/1.1 200"))
      << "meanwhile others are served";
  server_->answer(asked->request + 1, refusal(404, "nobody waits for this"));
  server_->answer(asked->request, page_of_bench("<p>run</p>"));
  const std::string page = get.answer();
  EXPECT_TRUE(page.starts_with("HTTP/1.1 200")) << page;
  EXPECT_TRUE(page.ends_with("\r\n\r\n<p>run</p>"));
  EXPECT_NE(page.find("Content-Security-Policy: sandbox allow-scripts; default-src 'none'"),
            std::string::npos);
  PageRequest head{port_, "HEAD"};
  server_->answer(wait_for(ClientEvent::Kind::kPage)->request, page_of_bench("<p>run</p>"));
  EXPECT_TRUE(head.answer().ends_with("\r\n\r\n"));
  const std::uint64_t before = server_->counters().refused_http;
  PageRequest gone{port_, "GET"};
  server_->answer(wait_for(ClientEvent::Kind::kPage)->request, refusal(404, "no such page"));
  const std::string refused = gone.answer();
  EXPECT_TRUE(refused.starts_with("HTTP/1.1 404") && refused.ends_with("no such page\n"));
  EXPECT_NE(refused.find("Content-Security-Policy: default-src 'none'"), std::string::npos);
  EXPECT_EQ(server_->counters().refused_http, before + 1);
}

TEST_F(HttpSession, SoManyPagesAreAwaitedAndTheServerEndsWithThem) {
  std::vector<std::unique_ptr<PageRequest>> requests;
  for (std::size_t i = 0; i < WebServer::kPagesMax; ++i) {
    requests.push_back(std::make_unique<PageRequest>(port_, "GET"));
    ASSERT_TRUE(wait_for(ClientEvent::Kind::kPage));
  }
  PageRequest one_more{port_, "GET"};
  EXPECT_TRUE(one_more.answer().starts_with("HTTP/1.1 503"));
  server_.reset();
  for (const auto& request : requests) EXPECT_EQ(request->answer(), "");
}

}  // namespace
}  // namespace pitwall::publishers::web
