// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/admission/pending_connections.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace pitwall::publishers::web {
namespace {

TEST(PendingConnections, WhoWasSilentLongestOfAnAddressGoesForTheNextOfIt) {
  PendingConnections pending;
  EXPECT_FALSE(pending.add(1, 7)) << "of another address";
  for (std::size_t i = 0; i < PendingConnections::kPerAddress; ++i)
    EXPECT_FALSE(pending.add(100 + i, 8));
  pending.receive(100);
  EXPECT_EQ(pending.add(999, 8), 101u);
  EXPECT_EQ(pending.add(1000, 8), 102u);
  EXPECT_EQ(pending.size(), PendingConnections::kPerAddress + 1);
}

TEST(PendingConnections, OneThatLeftMakesRoom) {
  PendingConnections pending;
  for (std::size_t i = 0; i < PendingConnections::kPerAddress; ++i) EXPECT_FALSE(pending.add(i, 8));
  pending.leave(3);
  pending.leave(3);
  EXPECT_FALSE(pending.add(999, 8));
}

// Whatever comes, hears and goes: the bounds hold, and nobody goes who is not there.
TEST(PendingConnections, TheBoundsHold) {
  PendingConnections pending;
  std::set<PendingConnections::Connection> there;
  std::mt19937 random(5);
  for (PendingConnections::Connection next = 0; next < 5'000; ++next) {
    const auto goes = pending.add(next, random() % 4);
    if (goes) {
      EXPECT_EQ(there.erase(*goes), 1u);
    }
    there.insert(next);
    const PendingConnections::Connection any = random() % (next + 1);
    if (random() % 3 == 0) {
      pending.leave(any);
      there.erase(any);
    } else {
      pending.receive(any);
    }
    ASSERT_EQ(pending.size(), there.size());
    ASSERT_LE(pending.size(), PendingConnections::kInAll);
  }
}

}  // namespace
}  // namespace pitwall::publishers::web
