// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/admission/waiting_room.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace pitwall::publishers::web {
namespace {

TEST(WaitingRoom, WhoWasSilentLongestOfAnAddressGoesForTheNextOfIt) {
  WaitingRoom room;
  EXPECT_FALSE(room.enter(1, 7)) << "of another address";
  for (std::size_t i = 0; i < WaitingRoom::kPerAddress; ++i) EXPECT_FALSE(room.enter(100 + i, 8));
  room.receive(100);
  EXPECT_EQ(room.enter(999, 8), 101u);
  EXPECT_EQ(room.enter(1000, 8), 102u);
  EXPECT_EQ(room.size(), WaitingRoom::kPerAddress + 1);
}

TEST(WaitingRoom, OneThatLeftMakesRoom) {
  WaitingRoom room;
  for (std::size_t i = 0; i < WaitingRoom::kPerAddress; ++i) EXPECT_FALSE(room.enter(i, 8));
  room.leave(3);
  room.leave(3);
  EXPECT_FALSE(room.enter(999, 8));
}

// Whatever comes, hears and goes: the bounds hold, and nobody goes who is not there.
TEST(WaitingRoom, TheBoundsHold) {
  WaitingRoom room;
  std::set<WaitingRoom::Connection> there;
  std::mt19937 random(5);
  for (WaitingRoom::Connection next = 0; next < 5'000; ++next) {
    const auto goes = room.enter(next, random() % 4);
    if (goes) {
      EXPECT_EQ(there.erase(*goes), 1u);
    }
    there.insert(next);
    const WaitingRoom::Connection any = random() % (next + 1);
    if (random() % 3 == 0) {
      room.leave(any);
      there.erase(any);
    } else {
      room.receive(any);
    }
    ASSERT_EQ(room.size(), there.size());
    ASSERT_LE(room.size(), WaitingRoom::kInAll);
  }
}

}  // namespace
}  // namespace pitwall::publishers::web
