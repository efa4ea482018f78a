// SPDX-License-Identifier: Apache-2.0
#include "vehicle/gateway/bus_load.hpp"

#include <gtest/gtest.h>

namespace pitwall::gateway {
namespace {

can::ReceivedFrame frame_at(Instant at, std::uint8_t length = 8, bool extended = false) {
  can::Frame frame;
  frame.length = length;
  frame.extended = extended;
  return {frame, at};
}

TEST(BusLoad, IsTheBitsOfTheWindow) {
  BusLoad load;
  Instant at = Instant{} + seconds(5);
  for (int i = 0; i < 100; ++i) load.add(frame_at(at + milliseconds(1) * i));
  at += milliseconds(100);
  EXPECT_DOUBLE_EQ(load.share(at), 30 * 111.0 / 15'000.0);
  load.add(frame_at(at, 0, true));
  EXPECT_DOUBLE_EQ(load.share(at), 30 * 111.0 / 15'000.0) << "the slot of now is not full yet";
  EXPECT_DOUBLE_EQ(load.share(at + kLoadSlot), (20 * 111.0 + 67.0) / 15'000.0);
  EXPECT_EQ(load.share(at + seconds(1)), 0.0);
}

// Who slept hears a second of traffic at once: by its stamps it is no flood.
TEST(BusLoad, GoesByStampsNotByArrival) {
  BusLoad load;
  const Instant from = Instant{} + seconds(5);
  for (int i = 0; i < 1000; ++i) load.add(frame_at(from + milliseconds(1) * i));
  EXPECT_DOUBLE_EQ(load.share(from + seconds(1)), 30 * 111.0 / 15'000.0);
  load.add(frame_at(from));
  EXPECT_DOUBLE_EQ(load.share(from + seconds(1)), 30 * 111.0 / 15'000.0) << "too old to count";
}

TEST(BusLoad, IsNothingAtTheBeginningOfTime) {
  BusLoad load;
  EXPECT_EQ(load.share(Instant{}), 0.0);
  load.add(frame_at(Instant{}));
  EXPECT_DOUBLE_EQ(load.share(Instant{} + kLoadSlot), 111.0 / 15'000.0);
}

}  // namespace
}  // namespace pitwall::gateway
