// On the loopback interface, which every kernel has and which no watch may harm. Controllers are
// restarted and queues emptied in tests/system/slcan.
// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/bus_watch.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/comes_true.hpp"
#include "tests/support/unix_bus_bench.hpp"

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

class BusWatchOnUnixBus : public testing::UnixBusBench {};

TEST_F(BusWatchOnUnixBus, SeesTheHubGoAndComeAndRefusesWhatABusWithoutControllerCannot) {
  const auto watch = BusWatch::start(bus_);
  ASSERT_TRUE(watch) << to_string(watch.error());
  EXPECT_TRUE((*watch)->newest().interface.up);
  hub_.reset();
  EXPECT_TRUE(comes_true([&] { return !(*watch)->newest().interface.up; }));
  (*watch)->restart();
  EXPECT_TRUE(comes_true([&] { return (*watch)->newest().restarts_refused == 1; }));
  start();
  EXPECT_TRUE(comes_true([&] { return (*watch)->newest().interface.up; }));
  EXPECT_EQ((*watch)->newest().restarts, 0u);
}

TEST(BusWatch, AMissingInterfaceIsNamed) {
  const auto watch = BusWatch::start("pwnone0");
  ASSERT_FALSE(watch);
  EXPECT_EQ(watch.error().place, "pwnone0");
}

}  // namespace
}  // namespace pitwall::io
