// What needs no CAN in the kernel; that frames arrive is tested in tests/system/vcan.
// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/can_sender.hpp"

#include <gtest/gtest.h>

#include <vector>

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
  for (const std::string name : {"", "nosuchcan0", "an_interface_name_too_long"}) {
    const auto sender = CanSender::open(name);
    ASSERT_FALSE(sender.has_value());
    EXPECT_EQ(sender.error().place, name);
  }
}

TEST(SendOutcome, OnlyAFullQueueIsWorthARetry) {
  EXPECT_TRUE((SendOutcome{.taken = 0, .error = ENOBUFS}.full()));
  EXPECT_TRUE((SendOutcome{.taken = 0, .error = EAGAIN}.full()));
  EXPECT_FALSE((SendOutcome{.taken = 0, .error = ENETDOWN}.full()));
  EXPECT_FALSE((SendOutcome{.taken = 3, .error = 0}.full()));
}

}  // namespace
}  // namespace pitwall::transport
