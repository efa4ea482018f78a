// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/perception/frame_outbox.hpp"

#include <gtest/gtest.h>

#include "protocol/yaml/strict_map.hpp"

namespace pitwall::io {
namespace {

Instant at_ms(std::int64_t ms) { return Instant{} + milliseconds(ms); }

TEST(FrameOutbox, GivesFramesInTheirOrderAndCountsThoseWithoutRoom) {
  FrameOutbox outbox;
  for (std::size_t i = 0; i < FrameQueue::kRoom + 2; ++i) {
    world::DetectionFrame frame;
    frame.unit = static_cast<std::uint8_t>(i);
    outbox.put(frame, at_ms(100 * static_cast<std::int64_t>(i)), milliseconds(30));
  }
  EXPECT_EQ(outbox.counts().frames, FrameQueue::kRoom + 2);
  EXPECT_EQ(outbox.counts().no_room, 2U);
  for (std::size_t i = 0; i < FrameQueue::kRoom; ++i) {
    ASSERT_NE(outbox.front(), nullptr);
    EXPECT_EQ(outbox.front()->unit, i);
    outbox.pop(milliseconds(40));
  }
  EXPECT_EQ(outbox.front(), nullptr);
}

TEST(FrameOutbox, TellsTheLargestGapAndTheAgesAtTheLoop) {
  FrameOutbox outbox;
  for (const std::int64_t ms : {0, 100, 350, 450}) {
    outbox.put({}, at_ms(ms), milliseconds(30));
    outbox.pop(milliseconds(ms == 350 ? 90 : 40));
  }
  EXPECT_NEAR(outbox.counts().largest_gap_ms, 250.0, 1e-9);
  EXPECT_NEAR(outbox.arrivals().newest(at_ms(450)).latency_ms, 30.0, 1e-9);
  json::Object row;
  outbox.add_to(row, at_ms(450));
  const auto text = yaml::load_text(row.str(), "row.json");
  ASSERT_TRUE(text) << to_string(text.error());
  const auto ages = yaml::read(*text, [](yaml::StrictMap& map) {
    const std::pair read{map.number("to_loop_p50_ms", 0, 1e6),
                         map.number("to_loop_p99_ms", 0, 1e6)};
    for (const std::string& name : map.keys())
      if (!name.starts_with("to_loop")) map.number(name, 0.0, 1e12);
    return read;
  });
  ASSERT_TRUE(ages) << to_string(ages.error());
  EXPECT_NEAR(ages->first, 40.0, 0.2);
  EXPECT_NEAR(ages->second, 90.0, 0.2);
}

}  // namespace
}  // namespace pitwall::io
