// SPDX-License-Identifier: Apache-2.0
#include "hil/nodes/protected_messages.hpp"

#include <gtest/gtest.h>

#include <map>

#include "protocol/can/message_monitor.hpp"

namespace pitwall::can_variant {
namespace {

TEST(ProtectedMessages, EveryFrameIsWholeAliveAndInTime) {
  ProtectedMessages sender;
  std::map<std::uint32_t, can::MessageMonitor> monitors;
  can::LossLog losses;
  std::map<std::uint32_t, int> received;
  for (int ms = 0; ms < 1000; ++ms) {
    const Instant now = Instant{} + milliseconds(ms);
    for (const can::Frame& frame : sender.due(now)) {
      const can::MessageRow* row = protected_row(frame.id);
      ASSERT_NE(row, nullptr);
      ASSERT_EQ(frame.length, row->length);
      EXPECT_EQ(can::judge(*row, {}, monitors[frame.id], {frame, now}, losses),
                can::FrameVerdict::kGood);
      ++received[frame.id];
    }
  }
  ASSERT_EQ(received.size(), kProtectedMessages);
  for (const auto& [id, frames] : received) EXPECT_EQ(frames, 100) << id;
  EXPECT_EQ(losses.count, 0u);
}

TEST(ProtectedMessages, TheFlagsOfRaceControlHaveAChecksumThatFindsAnotherFlag) {
  can::Frame flags;
  flags.id = 1200;
  flags.length = 8;
  flags.data[0] = 0x41;
  const can::Frame stated = with_checksum(flags);
  can::Frame other = flags;
  other.id = 1250;
  EXPECT_EQ(with_checksum(other), other);
  for (const can::MessageRow& row : judged_rows()) {
    if (row.id != flags.id) continue;
    EXPECT_EQ(can::check(row.protection, stated), can::FrameCheck::kOk);
    can::Frame red = stated;
    red.data[0] = 0x11;
    EXPECT_EQ(can::check(row.protection, red), can::FrameCheck::kWrongCrc);
    return;
  }
  ADD_FAILURE() << "the flags are not judged";
}

TEST(ProtectedMessages, AreInOrderAndNoMessagesOfTheCar) {
  const auto rows = protected_rows();
  ASSERT_EQ(rows.size(), kProtectedMessages);
  for (std::size_t i = 1; i < rows.size(); ++i) EXPECT_LT(rows[i - 1].id, rows[i].id);
  EXPECT_EQ(protected_row(1303), nullptr);
}

}  // namespace
}  // namespace pitwall::can_variant
