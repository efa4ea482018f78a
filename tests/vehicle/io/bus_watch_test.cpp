// On the loopback interface, which every kernel has and which no watch may harm. Controllers are
// restarted and queues emptied in tests/system/slcan.
// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/bus_watch.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/comes_true.hpp"

namespace pitwall::io {
namespace {

using testing::comes_true;

TEST(BusWatch, KnowsTheInterfaceFromTheStartAndAsksAgain) {
  const auto watch = BusWatch::start("lo");
  ASSERT_TRUE(watch);
  const BusReport first = (*watch)->newest();
  EXPECT_TRUE(first.interface.exists);
  EXPECT_FALSE(first.interface.has_controller);
  EXPECT_TRUE(comes_true([&] { return (*watch)->newest().interface.at > first.interface.at; }));
}

TEST(BusWatch, ARefusalIsCountedAndSaysWhy) {
  const auto watch = BusWatch::start("lo");
  ASSERT_TRUE(watch);
  (*watch)->restart();
  ASSERT_TRUE(comes_true([&] { return (*watch)->newest().restarts_refused == 1; }));
  EXPECT_EQ(std::string((*watch)->newest().refusal.data()), "lo: error: has no CAN controller");
  (*watch)->flush();
  ASSERT_TRUE(comes_true([&] { return !(*watch)->flushing(); }));
  EXPECT_TRUE(comes_true([&] { return (*watch)->newest().flushes_refused == 1; }));
  EXPECT_EQ((*watch)->newest().restarts, 0u);
  EXPECT_EQ((*watch)->newest().flushes, 0u);
}

TEST(BusWatch, AMissingInterfaceIsNamed) {
  const auto watch = BusWatch::start("pwnone0");
  ASSERT_FALSE(watch);
  EXPECT_EQ(watch.error().place, "pwnone0");
}

}  // namespace
}  // namespace pitwall::io
