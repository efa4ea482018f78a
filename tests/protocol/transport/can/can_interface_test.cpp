// Reading the loopback interface against what the kernel says in /sys. Real controllers are in
// tests/system/slcan.
// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/can/can_interface.hpp"

#include <gtest/gtest.h>
#include <linux/can/netlink.h>
#include <linux/rtnetlink.h>
#include <net/if.h>

#include <charconv>
#include <string>
#include <vector>

#include "protocol/transport/file.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/unix_bus_bench.hpp"

namespace pitwall::transport {
namespace {

std::uint64_t from_sys(const std::string& name) {
  const auto text = read_file("/sys/class/net/lo/" + name);
  std::uint64_t value = 0;
  if (text) std::from_chars(text->data(), text->data() + text->size(), value);
  return value;
}

TEST(CanInterface, ReadsAnInterfaceAsSysfsDoes) {
  auto lo = CanInterface::open("lo");
  ASSERT_TRUE(lo) << to_string(lo.error());
  const std::uint64_t before = from_sys("statistics/rx_packets");
  ASSERT_TRUE(lo->refresh());
  const CanInterfaceStatus status = lo->status();
  const std::uint64_t after = from_sys("statistics/rx_packets");
  EXPECT_TRUE(status.exists);
  EXPECT_FALSE(status.has_controller);
  EXPECT_EQ(status.state, BusState::kUnknown);
  EXPECT_LE(before, status.rx_packets);
  EXPECT_LE(status.rx_packets, after);
  EXPECT_EQ(status.tx_queue_frames, from_sys("tx_queue_len"));
  EXPECT_FALSE(status.plain_queue);
}

TEST(CanInterface, RefreshTakesNothingFromTheHeap) {
  auto lo = CanInterface::open("lo");
  ASSERT_TRUE(lo);
  if (!testing::kAllocationsCounted) GTEST_SKIP() << "the sanitizer has a heap of its own";
  bool answered = true;
  EXPECT_EQ(testing::allocations_of([&] {
              for (int i = 0; i < 100; ++i) answered = lo->refresh() && answered;
            }),
            0u);
  EXPECT_TRUE(answered);
  EXPECT_EQ(lo->failures(), 0u);
}

TEST(CanInterface, WhatIsNoInterfaceOrHasNoControllerIsRefusedByName) {
  for (const char* name : {"", "pwnone0", "a name far too long for the kernel"}) {
    const auto none = CanInterface::open(name);
    ASSERT_FALSE(none) << name;
    EXPECT_EQ(none.error().place, name);
  }
  auto lo = CanInterface::open("lo");
  ASSERT_TRUE(lo);
  for (const auto& refused : {lo->restart(), lo->configure({.bitrate = 500'000}), lo->flush()}) {
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->place, "lo");
  }
}

class CanInterfaceOnUnixBus : public testing::UnixBusBench {};

TEST_F(CanInterfaceOnUnixBus, IsUpWhileItsHubIsThereAndDownWhileNot) {
  auto bus = CanInterface::open(bus_);
  ASSERT_TRUE(bus) << to_string(bus.error());
  for (int round = 0; round < 3; ++round) {
    for (int i = 0; i < 3; ++i) {
      serve();
      ASSERT_TRUE(bus->refresh());
      EXPECT_TRUE(bus->status().exists && bus->status().up && bus->status().running);
      EXPECT_FALSE(bus->status().has_controller);
      EXPECT_EQ(bus->status().state, BusState::kUnknown);
      EXPECT_FALSE(bus->status().listen_only);
    }
    EXPECT_EQ(hub_->counters().joined, 1u);  // it stays, and hears nothing
    hub_.reset();
    for (int i = 0; i < 3; ++i) {
      ASSERT_TRUE(bus->refresh());
      EXPECT_TRUE(bus->status().exists);
      EXPECT_FALSE(bus->status().up || bus->status().running);
    }
    start();
  }
  for (const auto& refused : {bus->restart(), bus->configure({.bitrate = 500'000}), bus->flush()}) {
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->place, bus_);
  }
  hub_.reset();
  const auto none = CanInterface::open(bus_);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().place, bus_);
}

// A controller as the kernel would describe it.
TEST(CanInterface, EveryFieldOfAControllerIsRead) {
  ifinfomsg link{};
  link.ifi_flags = IFF_UP;
  NetlinkRequest message(RTM_NEWLINK, 0, link);
  message.put(IFLA_CARRIER, std::uint8_t{1});
  message.put(IFLA_TXQLEN, std::uint32_t{10});
  message.put_text(IFLA_QDISC, "pfifo_fast");
  rtnl_link_stats64 counted{};
  counted.rx_packets = 1;
  counted.tx_packets = 2;
  counted.rx_dropped = 3;
  counted.rx_over_errors = 4;
  counted.tx_dropped = 5;
  message.put(IFLA_STATS64, counted);
  const std::size_t info = message.open_nest(IFLA_LINKINFO);
  message.put_text(IFLA_INFO_KIND, "can");
  message.put(IFLA_INFO_XSTATS, can_device_stats{.bus_error = 6,
                                                 .error_warning = 7,
                                                 .error_passive = 8,
                                                 .bus_off = 9,
                                                 .arbitration_lost = 10,
                                                 .restarts = 11});
  const std::size_t data = message.open_nest(IFLA_INFO_DATA);
  can_bittiming timing{};
  timing.bitrate = 1'000'000;
  message.put(IFLA_CAN_BITTIMING, timing);
  message.put(IFLA_CAN_STATE, std::uint32_t{CAN_STATE_ERROR_PASSIVE});
  message.put(IFLA_CAN_RESTART_MS, std::uint32_t{100});
  message.put(IFLA_CAN_CTRLMODE, can_ctrlmode{.mask = ~0U, .flags = CAN_CTRLMODE_LISTENONLY});
  message.put(IFLA_CAN_BERR_COUNTER, can_berr_counter{.txerr = 12, .rxerr = 13});
  message.close_nest(data);
  message.close_nest(info);
  const CanInterfaceStatus s = read_link(message.bytes(1).subspan(sizeof(nlmsghdr)));
  EXPECT_TRUE(s.exists && s.up && s.running && s.has_controller && s.listen_only);
  EXPECT_TRUE(s.errors_known && s.plain_queue);
  EXPECT_EQ(s.state, BusState::kPassive);
  EXPECT_EQ(s.bitrate, 1'000'000u);
  EXPECT_EQ(s.restart_ms, 100u);
  EXPECT_EQ(s.tx_queue_frames, 10u);
  const std::vector<std::uint64_t> numbers{
      s.rx_packets, s.tx_packets, s.rx_dropped, s.rx_over_errors, s.tx_dropped, s.bus_errors,
      s.warnings,   s.passives,   s.bus_offs,   s.restarts,       s.tx_errors,  s.rx_errors};
  EXPECT_EQ(numbers, (std::vector<std::uint64_t>{1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 12, 13}));
  EXPECT_EQ(s.lost(), 7u);
}

}  // namespace
}  // namespace pitwall::transport
