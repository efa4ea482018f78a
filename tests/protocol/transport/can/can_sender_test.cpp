// What needs no CAN in the kernel; that frames arrive is tested in tests/system/vcan.
// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/can/can_sender.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/unix_bus_bench.hpp"

namespace pitwall::transport {
namespace {

TEST(PreparedFrames, AFrameThatNoBusCanCarryIsNamed) {
  std::vector<can::Frame> frames(3);
  frames[0].fd = true;
  frames[0].length = 64;
  EXPECT_EQ(PreparedFrames::make(frames)->size(), 3U);
  frames[2].length = 9;
  const auto prepared = PreparedFrames::make(frames);
  ASSERT_FALSE(prepared.has_value());
  EXPECT_EQ(prepared.error().place, "frame 3");
}

TEST(PreparedFrames, NoFramesAreNoProblem) { EXPECT_EQ(PreparedFrames::make({})->size(), 0U); }

TEST(CanSender, AnInterfaceThatIsNotThereIsNamed) {
  const auto sender = CanSender::open("nosuchcan0");
  ASSERT_FALSE(sender.has_value());
  EXPECT_EQ(sender.error().place, "nosuchcan0");
}

TEST(SendOutcome, OnlyAFullQueueIsWorthARetry) {
  EXPECT_TRUE((SendOutcome{.taken = 0, .error = ENOBUFS}.full()));
  EXPECT_TRUE((SendOutcome{.taken = 0, .error = EAGAIN}.full()));
  EXPECT_FALSE((SendOutcome{.taken = 0, .error = ENETDOWN}.full()));
  EXPECT_FALSE((SendOutcome{.taken = 3, .error = 0}.full()));
}

class CanSenderOnUnixBus : public testing::UnixBusBench {};

TEST_F(CanSenderOnUnixBus, ARangeArrivesInOrderAndTheSenderHearsNothing) {
  testing::RawClient reader(bus_);
  auto sender = CanSender::open(bus_);
  ASSERT_TRUE(sender) << to_string(sender.error());
  std::vector<can::Frame> frames(100);
  for (std::uint32_t i = 0; i < frames.size(); ++i) frames[i] = {.id = i, .length = 8};
  auto prepared = PreparedFrames::make(frames);
  ASSERT_TRUE(prepared);
  EXPECT_EQ(sender->send(*prepared, 10, 70).taken, 70u);
  serve();
  const auto received = reader.read();
  ASSERT_EQ(received.size(), 70u);
  for (std::uint32_t i = 0; i < received.size(); ++i)
    EXPECT_EQ(testing::wire_of(received[i]).can_id, i + 10);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(reader.send(testing::numbered(1, 1)));
  serve();
  EXPECT_EQ(hub_->counters().dropped, 0u);
  while (sender->send(*prepared, 0, 100).taken == 100) {
  }
  EXPECT_TRUE(sender->send(*prepared, 0, 1).full());
  hub_.reset();
  const SendOutcome none = sender->send(*prepared, 0, 1);
  EXPECT_EQ(none.taken, 0u);
  EXPECT_FALSE(none.full());
  const auto refused = CanSender::open(bus_);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().place, bus_);
}

TEST_F(CanSenderOnUnixBus, OtherDataOfAPreparedFrameGoOutInItsPlace) {
  testing::RawClient reader(bus_);
  auto sender = CanSender::open(bus_);
  ASSERT_TRUE(sender) << to_string(sender.error());
  std::vector<can::Frame> frames(3);
  frames[0] = {.id = 1, .length = 2, .data = {1, 1}};
  frames[1] = {.id = 2, .fd = true, .length = 64, .data = {2}};
  frames[2] = {.id = 3, .length = 1, .data = {3}};
  auto prepared = PreparedFrames::make(frames);
  ASSERT_TRUE(prepared);
  frames[0].data = {7, 8};
  frames[1].data.fill(9);
  prepared->set_data(0, frames[0].payload());
  prepared->set_data(1, frames[1].payload());
  EXPECT_EQ(sender->send(*prepared, 0, 3).taken, 3u);
  serve();
  const auto packets = reader.read();
  ASSERT_EQ(packets.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    can::Frame got;
    ASSERT_TRUE(from_wire(testing::wire_of(packets[i]), packets[i].size(), got));
    EXPECT_EQ(got, frames[i]);
  }
}

}  // namespace
}  // namespace pitwall::transport
