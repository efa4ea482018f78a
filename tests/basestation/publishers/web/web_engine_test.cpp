// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <vector>

#include "basestation/publishers/web/admission/pace.hpp"
#include "basestation/publishers/web/admission/pending_connections.hpp"
#include "tests/basestation/publishers/web/server_fixture.hpp"

namespace pitwall::publishers::web {
namespace {

constexpr std::size_t kPlaces = kLastClient - kFirstClient + 1;

using WebEngine = WebServerTest;

// A number that was a console's a moment ago is no other console's yet: what is late for the one
// does not reach the other.
TEST_F(WebEngine, EveryNumberIsGivenOnceBeforeOneComesAgain) {
  WebClient stays;
  std::set<ClientId> given{join(stays)};
  for (std::size_t i = 1; i < kPlaces; ++i) {
    WebClient comes;
    EXPECT_TRUE(given.insert(join(comes)).second) << "after " << i;
  }
  EXPECT_EQ(*given.begin(), kFirstClient);
  EXPECT_EQ(*given.rbegin(), kLastClient);
  WebClient first_again;
  EXPECT_TRUE(given.contains(join(first_again)));
}

// Viewers leave places for operators.
TEST_F(WebEngine, WhenAllPlacesAreTakenTheNextIsRefusedUntilOneIsFree) {
  std::vector<std::unique_ptr<WebClient>> consoles;
  const auto next = [&]() -> WebClient& {
    return *consoles.emplace_back(std::make_unique<WebClient>());
  };
  while (consoles.size() < kPlaces - WebServer::kReserved) join(next());
  EXPECT_TRUE(bare(port_, opening()).starts_with("HTTP/1.1 503"));
  while (consoles.size() < kPlaces) join_as_operator(next());
  const std::string as_operator = std::string{"Authorization: Bearer "} + kOperatorToken + "\r\n";
  EXPECT_TRUE(bare(port_, opening("/ws", "127.0.0.1", as_operator)).starts_with("HTTP/1.1 503"));
  EXPECT_EQ(server_->counters().refused_places, 2u);
  consoles.erase(consoles.begin() + 7);
  const auto left = wait_for(ClientEvent::Kind::kLeft);
  ASSERT_TRUE(left);
  EXPECT_EQ(join_as_operator(next()), left->client) << "the only number that is free";
}

// Nobody needs a token to open connections and say nothing.
TEST_F(WebEngine, WhoSaysNothingCostsNoPlaceToWhoHasAToken) {
  std::vector<std::unique_ptr<Silent>> silent;
  for (std::size_t i = 0; i < PendingConnections::kPerAddress + 20; ++i)
    silent.push_back(std::make_unique<Silent>(port_));
  WebClient comes;
  EXPECT_GE(join_as_operator(comes), kFirstClient);
  EXPECT_TRUE(silent.front()->is_closed()) << "the first that came";
  EXPECT_GE(server_->counters().closed_waiting, 20u);
}

// What comes faster waits in the client's own socket, and is heard later.
TEST_F(WebEngine, OneThatSpeaksTooFastIsHeardAtItsPace) {
  WebClient fast;
  join(fast);
  constexpr std::int64_t kMore = 10;
  for (std::int64_t i = 0; i < Pace::kAtOnce + kMore; ++i) fast.send_text(std::to_string(i));
  const Instant begun = transport::monotonic_now();
  for (std::int64_t i = 0; i < Pace::kAtOnce + kMore; ++i) {
    const auto received = wait_for(ClientEvent::Kind::kText);
    ASSERT_TRUE(received);
    EXPECT_EQ(received->text, std::to_string(i)) << "in order, and nothing is lost";
  }
  EXPECT_GE(transport::monotonic_now() - begun, Pace::kEach * (kMore - 1));
}

TEST_F(WebEngine, AnOperatorIsHeardBeforeACrowdThatSpokeEarlier) {
  WebClient viewer, operates;
  const ClientId other = join(viewer);
  const ClientId stops = join_as_operator(operates);
  const auto wait_for_texts = [this](std::uint64_t count) {
    const Instant end = transport::monotonic_now() + seconds(20);
    while (server_->counters().texts_received < count && transport::monotonic_now() < end)
      transport::wait_readable({}, transport::monotonic_now() + milliseconds(1));
    ASSERT_EQ(server_->counters().texts_received, count);
  };
  for (int i = 0; i < 5; ++i) viewer.send_text(std::to_string(i));
  wait_for_texts(5);
  operates.send_text("stop");
  wait_for_texts(6);
  const auto first = server_->next_event();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->client, stops);
  EXPECT_EQ(first->text, "stop");
  for (int i = 0; i < 5; ++i) {
    const auto next = server_->next_event();
    ASSERT_TRUE(next);
    EXPECT_EQ(next->client, other);
    EXPECT_EQ(next->text, std::to_string(i)) << "of one client in order";
  }
}

// The caller never waits; what it says faster than the sockets take it is dropped and counted, by
// the hand-over or by the client's queue, and never in silence.
TEST_F(WebEngine, WhatWasSentArrivesOrIsCounted) {
  WebClient web_client;
  const ClientId client = join(web_client);
  constexpr std::uint32_t kFrames = 20 * WebServer::kPostsMax;
  for (std::uint32_t i = 1; i <= kFrames; ++i) server_->send(only(client), vehicle(i, 8));
  std::uint64_t received = 0;
  const auto accounted = [&] {
    const WebCounters counters = server_->counters();
    return counters.posts_dropped + counters.pictures_dropped + received;
  };
  while (accounted() < kFrames) {
    ASSERT_TRUE(web_client.receive());
    ++received;
  }
  EXPECT_EQ(accounted(), kFrames);
  EXPECT_GT(received, 0u);
}

}  // namespace
}  // namespace pitwall::publishers::web
