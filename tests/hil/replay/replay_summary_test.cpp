// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/replay_summary.hpp"

#include <gtest/gtest.h>

#include "protocol/yaml/strict_map.hpp"

namespace pitwall::replay {
namespace {

Timeline one_bus() {
  Timeline t;
  t.buses.push_back({.interface = "vcan3", .frames = {}, .fd_flags = {}, .due = {}});
  can::Frame frame;
  frame.id = 0x1A0;
  t.buses[0].frames = {frame, frame};
  t.buses[0].due = {Duration{}, milliseconds(1'500)};
  t.frames = 2;
  return t;
}

PlayReport report_with_drops() {
  PlayReport report;
  report.sent = 1;
  report.calls = 3;
  report.dropped_late = 1;
  report.seam_error = microseconds(12);
  report.lateness.add(microseconds(40));
  EXPECT_TRUE(report.dropped_list.push({0, 0, 1, milliseconds(7)}));
  return report;
}

TEST(ReplaySummary, ADroppedFrameIsNamed) {
  const std::string text = to_text(report_with_drops(), one_bus());
  EXPECT_NE(text.find("sent 1 frames"), std::string::npos) << text;
  EXPECT_NE(text.find("dropped 1 frames: 1 too late"), std::string::npos) << text;
  EXPECT_NE(text.find("vcan3 1A0 due at 1.500000 s of pass 1, late by 7000 us"), std::string::npos)
      << text;
  EXPECT_NE(text.find("wrong by 12 us"), std::string::npos) << text;
  EXPECT_EQ(text.find("and more"), std::string::npos) << text;
}

TEST(ReplaySummary, ProgramsGetTheSameFigures) {
  const auto json = yaml::load_text(
      to_json(report_with_drops(), one_bus(), {.memory_locked = true, .fifo = false}), "json");
  ASSERT_TRUE(json) << to_string(json.error());
  yaml::StrictMap map = json->root();
  EXPECT_EQ(map.integer("sent", 0, 9), 1);
  EXPECT_EQ(map.integer("frames_per_pass", 0, 9), 2);
  EXPECT_EQ(map.integer("dropped_late", 0, 9), 1);
  EXPECT_EQ(map.map("late_us").integer("p50", 0, 99), 41);  // upper edge of its cell
  EXPECT_EQ(map.integer("seam_error_us", 0, 99), 12);
  EXPECT_TRUE(map.flag("memory_locked"));
  EXPECT_FALSE(map.flag("fifo"));
}

}  // namespace
}  // namespace pitwall::replay
