// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/stream/line_socket.hpp"

#include <gtest/gtest.h>

#include <string>

#include "protocol/transport/file.hpp"

namespace pitwall::transport {
namespace {

using Lines = std::vector<std::string>;

class LineSockets : public ::testing::Test {
 protected:
  TemporaryFolder folder_ = *TemporaryFolder::create("lines");
  std::string path_ = folder_.path() + "/server";
};

TEST_F(LineSockets, LinesGoBothWaysWholeAndInOrder) {
  auto listener = LineListener::open(path_);
  ASSERT_TRUE(listener) << to_string(listener.error());
  EXPECT_FALSE(listener->accept());
  auto client = LineSocket::connect(path_);
  ASSERT_TRUE(client);
  auto server = listener->accept();
  ASSERT_TRUE(server);
  client->send("one");
  client->send("");
  client->send("three");
  EXPECT_EQ(server->receive(), (Lines{"one", "", "three"}));
  server->send("answer");
  EXPECT_EQ(client->receive(), Lines{"answer"});
  EXPECT_EQ(server->counters().received, 3U);
}

TEST_F(LineSockets, APathServesOneListenerAndGoesWithIt) {
  {
    const auto listener = LineListener::open(path_);
    ASSERT_TRUE(listener);
    const auto second = LineListener::open(path_);
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().place, path_);
    EXPECT_EQ(second.error().what, "in use");
  }
  EXPECT_FALSE(LineSocket::connect(path_));
  EXPECT_FALSE(LineListener::open(""));
}

TEST_F(LineSockets, ALineThatIsTooLongIsSkippedAndCounted) {
  auto listener = LineListener::open(path_);
  auto client = LineSocket::connect(path_);
  auto server = listener->accept();
  ASSERT_TRUE(client && server);
  Lines incoming;
  const auto listen = [&] {
    for (std::string& line : server->receive()) incoming.push_back(std::move(line));
    client->flush();
  };
  client->send("before");
  client->send(std::string(LineSocket::kLineMax_bytes + 1, 'x'));
  client->send(std::string(LineSocket::kLineMax_bytes, 'y'));
  client->send("after");
  for (int i = 0; i < 200 && incoming.size() < 3; ++i) listen();
  ASSERT_EQ(incoming.size(), 3U);
  EXPECT_EQ(incoming[0], "before");
  EXPECT_EQ(incoming[1].size(), LineSocket::kLineMax_bytes);
  EXPECT_EQ(incoming[2], "after");
  EXPECT_EQ(server->counters().too_long, 1U);
  EXPECT_EQ(server->counters().received, 3U);
}

TEST_F(LineSockets, WhatWasSaidBeforeTheEndIsHeard) {
  auto listener = LineListener::open(path_);
  std::optional<LineSocket> server;
  {
    auto client = LineSocket::connect(path_);
    server = listener->accept();
    client->send("last words");
  }
  EXPECT_EQ(server->receive(), Lines{"last words"});
  EXPECT_TRUE(server->closed());
  server->send("nobody hears this");  // and nothing happens
  EXPECT_TRUE(server->receive().empty());
}

TEST_F(LineSockets, WhoReadsNothingIsHungUpOn) {
  auto listener = LineListener::open(path_);
  auto client = LineSocket::connect(path_);
  auto server = listener->accept();
  const std::string line(100'000, 'x');
  for (int i = 0; i < 100 && !server->closed(); ++i) server->send(line);
  EXPECT_TRUE(server->closed());
  EXPECT_LT(server->counters().sent, 60U);
}

TEST_F(LineSockets, TheRestOfAnUnfinishedLineIsNoLine) {
  auto listener = LineListener::open(path_);
  auto client = LineSocket::connect(path_);
  auto server = listener->accept();
  const std::string part = "half a";
  ASSERT_EQ(::write(client->fd(), part.data(), part.size()), static_cast<ssize_t>(part.size()));
  EXPECT_TRUE(server->receive().empty());
  client->send(" line");
  EXPECT_EQ(server->receive(), Lines{"half a line"});
}

}  // namespace
}  // namespace pitwall::transport
