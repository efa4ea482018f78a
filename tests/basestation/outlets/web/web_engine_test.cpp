// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/web/web_engine.hpp"

#include <gtest/gtest.h>

#include <bitset>

namespace pitwall::outlets::web {
namespace {

// What a client may leave unread stands in its queue, not in the kernel, so that it can be dropped;
// what the posts may grow to is more than one full round of all consoles.
TEST(WebEngine, WhatWaitsIsBounded) {
  EXPECT_LE(static_cast<std::size_t>(kSendBuffer), kTextMax);
  EXPECT_GE(kPostsMax, ClientSet{}.size());
  EXPECT_GE(kNewsMax, ClientSet{}.size() * 2);
  EXPECT_GT(kSilence, kHttpPatience);
}

}  // namespace
}  // namespace pitwall::outlets::web
