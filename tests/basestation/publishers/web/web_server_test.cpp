// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/web_server.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>
#include <vector>

#include "tests/basestation/publishers/web/server_fixture.hpp"

namespace pitwall::publishers::web {
namespace {

TEST_F(WebServerTest, TextsAndFramesGoBothWays) {
  WebClient web_client;
  const ClientId client = join(web_client);
  EXPECT_GE(client, kFirstClient);
  web_client.send_text("{\"type\": \"x\"}");
  EXPECT_EQ(wait_for(ClientEvent::Kind::kText)->text, "{\"type\": \"x\"}");
  server_->send(only(client), text("hello"));
  server_->send(only(client), vehicle(7, 8));
  EXPECT_EQ(web_client.receive()->bytes, "hello");
  const auto frame = web_client.receive();
  ASSERT_TRUE(frame);
  EXPECT_FALSE(frame->text);
  EXPECT_EQ(frame->bytes.size(), kFrameHeader + 8);
  EXPECT_EQ(frame->bytes[8], 7);
}

TEST_F(WebServerTest, OneThatLeavesIsToldAndItsNumberIsNotSoonAnothers) {
  ClientId first = 0;
  {
    WebClient web_client;
    first = join(web_client);
  }
  EXPECT_EQ(wait_for(ClientEvent::Kind::kLeft)->client, first);
  WebClient next;
  EXPECT_NE(join(next), first);
}

TEST_F(WebServerTest, AConsoleIsOfTheCarItCameTo) {
  auto started = WebServer::start({}, {.cars = {{.number = 7}, {.number = 8}}});
  ASSERT_TRUE(started);
  WebServer& server = **started;
  const std::uint16_t port = server.local().port;
  WebClient first, second, nobody;
  EXPECT_EQ(second.open(port, "/ws?car=8"), 101u);
  EXPECT_EQ(first.open(port, "/ws"), 101u);
  EXPECT_NE(nobody.open(port, "/ws?car=9"), 101u);
  second.send_text("{\"type\": \"stop\"}");
  std::array<std::vector<ClientEvent>, 2> received;
  const Instant end = transport::monotonic_now() + seconds(20);
  while ((received[0].empty() || received[1].size() < 2) && transport::monotonic_now() < end) {
    const std::array<int, 2> fds{server.fd(0), server.fd(1)};
    transport::wait_readable(fds, end);
    for (std::size_t car = 0; car < received.size(); ++car) {
      while (auto news = server.next_event(car)) received[car].push_back(*std::move(news));
    }
  }
  ASSERT_EQ(received[0].size(), 1u);
  ASSERT_EQ(received[1].size(), 2u);
  EXPECT_NE(received[0][0].client, received[1][0].client) << "one numbering for all";
  EXPECT_EQ(received[1][1].kind, ClientEvent::Kind::kText);
  EXPECT_EQ(received[1][1].client, received[1][0].client);
}

TEST_F(WebServerTest, MoreCarsThanItHasPlacesForAreRefused) {
  HttpConfig config;
  for (int number = 0; number <= static_cast<int>(WebServer::kCars); ++number) {
    config.cars.push_back({.number = number});
  }
  EXPECT_FALSE(WebServer::start({}, std::move(config)));
}

TEST_F(WebServerTest, ADocumentOfTheMomentIsThereSoon) {
  server_->show("/api/cars", {"[7]", kJsonType});
  const std::string own = "127.0.0.1:" + std::to_string(port_);
  const std::string asking =
      "GET /api/cars HTTP/1.1\r\nHost: " + own + "\r\nConnection: close\r\n\r\n";
  const Instant end = transport::monotonic_now() + seconds(20);
  while (!bare(port_, asking).ends_with("[7]")) ASSERT_LT(transport::monotonic_now(), end);
}

TEST_F(WebServerTest, ATextThatIsTooLongClosesItsSocketOnly) {
  WebClient good, bad;
  const ClientId kept = join(good);
  join(bad);
  bad.send_text(std::string(kTextMax + 1, 'x'));
  while (bad.receive()) {
  }
  EXPECT_EQ(bad.close_code(), 1009u);
  server_->send(only(kept), text("still here"));
  EXPECT_EQ(good.receive()->bytes, "still here");
}

TEST_F(WebServerTest, ATextThatIsNoUtf8ClosesItsSocket) {
  WebClient web_client;
  join(web_client);
  web_client.send_text("\xFF\xFE");
  EXPECT_FALSE(web_client.receive());
  EXPECT_EQ(web_client.close_code(), 1007u);
}

TEST_F(WebServerTest, BytesAreToldAsSuch) {
  WebClient web_client;
  join(web_client);
  web_client.send_bytes("abc");
  EXPECT_EQ(wait_for(ClientEvent::Kind::kBinary)->text, "abc");
}

SharedMessage headed_bytes(std::uint32_t tag, std::size_t size) {
  Bytes bytes{.head = {1, 2}, .head_bytes = 2, .tag = tag};
  bytes.body = std::make_shared<const std::vector<std::uint8_t>>(size, std::uint8_t{7});
  return std::make_shared<const Message>(Message{.binary = std::move(bytes)});
}

TEST_F(WebServerTest, BytesGoOutBehindTheirHeadAndWhatIsLostIsKnownByItsTag) {
  WebClient slow;
  ASSERT_EQ(slow.open(port_, "/ws", {}, 4'096), 101u);
  const ClientId client = wait_for(ClientEvent::Kind::kJoined)->client;
  constexpr std::uint64_t kSent = 400;
  for (std::uint64_t i = 0; i < kSent; ++i) server_->send(only(client), headed_bytes(5, 10'000));
  server_->send(only(client), text("end"));
  std::uint64_t received = 0;
  while (const auto message = slow.receive()) {
    if (message->text) break;
    EXPECT_EQ(message->bytes.substr(0, 3), std::string("\1\2\7"));
    ++received;
  }
  const auto drops = server_->take_drops();
  ASSERT_EQ(drops.size(), 1U);
  EXPECT_EQ(drops[0].client, client);
  EXPECT_EQ(drops[0].tag, 5U);
  EXPECT_EQ(drops[0].count + received, kSent);
  EXPECT_TRUE(server_->take_drops().empty());
}

TEST(WebServerOfAnotherProtocol, TheSubprotocolIsNegotiated) {
  HttpConfig config;
  config.subprotocols = {"a.v1", "b.v1"};
  const auto server = WebServer::start({}, std::move(config));
  ASSERT_TRUE(server);
  const std::uint16_t port = (*server)->local().port;
  const std::string answer =
      bare(port, opening("/", "127.0.0.1", "Sec-WebSocket-Protocol: x, b.v1\r\n"));
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 101")) << answer;
  EXPECT_NE(answer.find("Sec-WebSocket-Protocol: b.v1\r\n"), std::string::npos) << answer;
  EXPECT_TRUE(bare(port, opening("/")).starts_with("HTTP/1.1 400"));
  EXPECT_TRUE(bare(port, opening("/", "127.0.0.1", "Sec-WebSocket-Protocol: c\r\n"))
                  .starts_with("HTTP/1.1 400"));
}

TEST_F(WebServerTest, AClientThatDoesNotReadLosesItsOwnOldestAndSeesHowMuch) {
  WebClient slow, quick;
  ASSERT_EQ(slow.open(port_, "/ws", {}, 4'096), 101u);
  const ClientId stopped = wait_for(ClientEvent::Kind::kJoined)->client;
  const ClientId reading = join(quick);
  constexpr std::uint32_t kFrames = 2'000;
  for (std::uint32_t i = 1; i <= kFrames; ++i) {
    server_->send(only(stopped).set(reading), vehicle(i));
    const auto received = quick.receive();
    ASSERT_TRUE(received);
    ASSERT_EQ(received->bytes[12], 0) << "the one that reads loses nothing";
  }
  server_->send(only(stopped), text("end"));
  std::uint32_t frames = 0, dropped = 0;
  while (const auto received = slow.receive()) {
    if (received->text) break;
    ++frames;
    dropped = static_cast<std::uint8_t>(received->bytes[12]) +
              256U * static_cast<std::uint8_t>(received->bytes[13]);
  }
  EXPECT_GT(dropped, 0u);
  EXPECT_EQ(frames + dropped, kFrames);
  EXPECT_EQ(server_->counters().pictures_dropped, dropped);
}

TEST_F(WebServerTest, AClientThatLeavesTooMuchUnreadIsClosed) {
  WebClient slow;
  ASSERT_EQ(slow.open(port_, "/ws", {}, 4'096), 101u);
  const ClientId stopped = wait_for(ClientEvent::Kind::kJoined)->client;
  const auto long_text = text(std::string(256 * 1'024, 'x'));
  for (int i = 0; i < 40; ++i) server_->send(only(stopped), long_text);
  EXPECT_TRUE(wait_for(ClientEvent::Kind::kLeft));
  EXPECT_EQ(server_->counters().closed_unread, 1u);
}

TEST_F(WebServerTest, WhoSaysMoreThanIsHandledIsReadNoFurther) {
  WebClient web_client;
  join(web_client);
  for (int i = 0; i < 100; ++i) web_client.send_text(std::to_string(i));
  int texts = 0;
  while (texts < 100 && wait_for(ClientEvent::Kind::kText)) ++texts;
  EXPECT_EQ(texts, 100) << "nothing is lost";
}

TEST_F(WebServerTest, RandomBytesDoNoHarm) {
  std::mt19937 random(3);
  WebClient web_client;
  const ClientId client = join(web_client);
  for (int round = 0; round < 60; ++round) {
    std::string bytes(random() % 600, ' ');
    for (char& c : bytes) c = static_cast<char>(random() % 256);
    bare(port_, bytes);
    bare(port_, opening() + bytes);
  }
  server_->send(only(client), text("still here"));
  EXPECT_EQ(web_client.receive()->bytes, "still here");
  EXPECT_EQ(server_->counters().faults, 0u);
}

TEST(WebServerStart, AnAddressThatIsTakenIsAProblem) {
  auto first = WebServer::start({}, {});
  ASSERT_TRUE(first);
  const auto second = WebServer::start((*first)->local(), {});
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().what, "another program serves this port; end it or take another one");
  EXPECT_EQ(second.error().place, "--web " + to_string((*first)->local()));
}

TEST(WebServerStart, EndsWithConsolesConnected) {
  auto server = WebServer::start({}, {});
  ASSERT_TRUE(server);
  WebClient web_client;
  EXPECT_EQ(web_client.open((*server)->local().port), 101u);
  server->reset();
  EXPECT_FALSE(web_client.receive());
}

}  // namespace
}  // namespace pitwall::publishers::web
