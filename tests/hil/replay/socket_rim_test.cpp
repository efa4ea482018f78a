// What needs no CAN in the kernel; playing is tested in tests/system/vcan.
// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/socket_rim.hpp"

#include <gtest/gtest.h>

namespace pitwall::replay {
namespace {

TEST(SocketRim, AnInterfaceThatIsNotThereIsNamed) {
  Timeline timeline;
  timeline.tracks.push_back({.target = "nosuchcan0"});
  const auto rim = SocketRim::open(timeline);
  ASSERT_FALSE(rim.has_value());
  EXPECT_EQ(rim.error().place, "nosuchcan0");
}

TEST(SocketRim, TheLeadIsWhatSleepsAreLateHereWithinItsBound) {
  const Duration lead = SocketRim::measured_lead();
  EXPECT_GT(lead, Duration{});  // no sleep ends before its deadline
  EXPECT_LE(lead, kMaxLead);
}

// A rim without buses still waits: never shorter than to the look that is nearest to the deadline.
TEST(SocketRim, WaitsEndAtTheDeadlineWithAndWithoutALead) {
  auto rim = SocketRim::open(Timeline{});
  ASSERT_TRUE(rim.has_value()) << to_string(rim.error());
  for (const Duration lead : {Duration{}, microseconds(50), kMaxLead}) {
    rim->set_lead(lead);
    for (const Duration wait : {microseconds(30), microseconds(900), milliseconds(12)}) {
      const Instant deadline = rim->now() + wait;
      rim->wait_until(deadline);
      EXPECT_GE(rim->now(), deadline - kGroup / 2);
    }
  }
  EXPECT_FALSE(rim->stopped());
  EXPECT_EQ(rim->last_error(), "");
}

}  // namespace
}  // namespace pitwall::replay
