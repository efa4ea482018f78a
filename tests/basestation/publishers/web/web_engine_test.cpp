// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <vector>

#include "tests/basestation/publishers/web/server_fixture.hpp"

namespace pitwall::publishers::web {
namespace {

constexpr std::size_t kPlaces = kLastClient - kFirstClient + 1;

using WebEngine = WebServerTest;

// A number that was a console's a moment ago is no other console's yet: what is late for the one
// does not reach the other.
TEST_F(WebEngine, EveryNumberIsGivenOnceBeforeOneComesAgain) {
  Browser stays;
  std::set<ClientId> given{join(stays)};
  for (std::size_t i = 1; i < kPlaces; ++i) {
    Browser comes;
    EXPECT_TRUE(given.insert(join(comes)).second) << "after " << i;
  }
  EXPECT_EQ(*given.begin(), kFirstClient);
  EXPECT_EQ(*given.rbegin(), kLastClient);
  Browser first_again;
  EXPECT_TRUE(given.contains(join(first_again)));
}

TEST_F(WebEngine, WhenAllPlacesAreTakenTheNextIsRefusedUntilOneIsFree) {
  std::vector<std::unique_ptr<Browser>> consoles;
  for (std::size_t i = 0; i < kPlaces; ++i) {
    join(*consoles.emplace_back(std::make_unique<Browser>()));
  }
  EXPECT_TRUE(bare(port_, opening()).starts_with("HTTP/1.1 503"));
  consoles.erase(consoles.begin() + 7);
  const auto left = wait_for(ClientNews::Kind::kLeft);
  ASSERT_TRUE(left);
  Browser next;
  EXPECT_EQ(join(next), left->client) << "the only number that is free";
}

// The caller never waits; what it says faster than the sockets take it is dropped and counted, by
// the hand-over or by the client's queue, and never in silence.
TEST_F(WebEngine, WhatWasSentArrivesOrIsCounted) {
  Browser browser;
  const ClientId client = join(browser);
  constexpr std::uint32_t kFrames = 20 * WebServer::kPostsMax;
  for (std::uint32_t i = 1; i <= kFrames; ++i) server_->send(only(client), vehicle(i, 8));
  std::uint64_t heard = 0;
  const auto accounted = [&] {
    const WebCounters counters = server_->counters();
    return counters.posts_dropped + counters.pictures_dropped + heard;
  };
  while (accounted() < kFrames) {
    ASSERT_TRUE(browser.hear());
    ++heard;
  }
  EXPECT_EQ(accounted(), kFrames);
  EXPECT_GT(heard, 0u);
}

}  // namespace
}  // namespace pitwall::publishers::web
