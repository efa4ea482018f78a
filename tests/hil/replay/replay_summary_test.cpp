// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/replay_summary.hpp"

#include <gtest/gtest.h>

#include "protocol/yaml/strict_map.hpp"

namespace pitwall::replay {
namespace {

Timeline one_bus() {
  Timeline t;
  t.tracks.push_back({.target = "vcan3"});
  can::Frame frame;
  frame.id = 0x1A0;
  t.tracks[0].frames = {frame, frame};
  t.tracks[0].due = {Duration{}, milliseconds(1'500)};
  t.frames = 2;
  return t;
}

PlayReport report_with_drops() {
  PlayReport report;
  report.frames.sent = 1;
  report.calls = 3;
  report.frames.dropped_late = 1;
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
      to_json(report_with_drops(), one_bus(), {}, {.memory_locked = true, .fifo = false}), "json");
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

TEST(ReplaySummary, DatagramsAndWhatIsNotPlayedStandApart) {
  Timeline t = one_bus();
  t.tracks.push_back({.target = "127.0.0.1:3001",
                      .due = {milliseconds(2)},
                      .to = UdpAddress{.port = 3'001},
                      .datagrams = {.bytes = {1, 2, 3}, .ends = {3}}});
  t.datagrams = 1;
  t.filtered = 6;
  t.restamped = 8;
  t.unfit = 9;
  t.left_out = {{"/imu", "neither", 70}, {"/gnss/1", "no address", 5}};
  PlayReport report = report_with_drops();
  report.datagrams = {.sent = 4, .dropped_full = 2};
  EXPECT_TRUE(report.dropped_list.push({1, 1, 0, milliseconds(7)}));
  const std::string text = to_text(report, t);
  for (const char* expected :
       {"sent 1 frames and 4 datagrams in", "dropped 1 frames: 1 too late",
        "dropped 2 datagrams: 0 too late, 2 queue full", "not played: 75 records of 2 sources",
        "not played: 6 frames of a pass", "127.0.0.1:3001 3 bytes due at 0.002000 s of pass 2"})
    EXPECT_NE(text.find(expected), std::string::npos) << expected << "\n" << text;
  const auto json = yaml::load_text(to_json(report, t, {}, {}), "json");
  ASSERT_TRUE(json) << to_string(json.error());
  yaml::StrictMap map = json->root();
  EXPECT_EQ(map.integer("sent", 0, 9), 1);
  yaml::StrictMap datagrams = map.map("datagrams");
  EXPECT_EQ(datagrams.integer("per_pass", 0, 9), 1);
  EXPECT_EQ(datagrams.integer("sent", 0, 9), 4);
  EXPECT_EQ(datagrams.integer("dropped_full", 0, 9), 2);
  EXPECT_EQ(map.integer("filtered_per_pass", 0, 9), 6);
  EXPECT_EQ(map.integer("restamped_per_pass", 0, 9), 8);
  EXPECT_EQ(map.integer("not_restamped_per_pass", 0, 9), 9);
  EXPECT_NE(to_json(report, t, {}, {}).find("/gnss/1"), std::string::npos);
}

TEST(ReplaySummary, WhatAStreamDidNotTakeIsCounted) {
  const std::vector<StreamReport> streams{
      {"tcp:127.0.0.1:3001",
       {.opened = 2, .sent_bytes = 70, .dropped_absent = 3, .dropped_full = 4, .lost_bytes = 5}},
      {"serial:/dev/ttyS0:9600", {.opened = 1, .ignored_bytes = 8}}};
  EXPECT_EQ(to_text(streams),
            "tcp:127.0.0.1:3001: opened 2 times, 70 bytes sent; dropped 3 records without a "
            "reader, 4 while it did not read; 5 bytes lost when it ended\n"
            "serial:/dev/ttyS0:9600: opened 1 times, 0 bytes sent; dropped 0 records without a "
            "reader, 0 while it did not read; 8 bytes of its own ignored\n");
  const std::string text = to_json(report_with_drops(), one_bus(), streams, {});
  const auto json = yaml::load_text(text, "json");
  ASSERT_TRUE(json) << to_string(json.error());
  yaml::StrictMap map = json->root();
  auto reports = map.maps("streams");
  ASSERT_EQ(reports.size(), 2U);
  EXPECT_EQ(reports[0].integer("dropped_full", 0, 9), 4);
  EXPECT_EQ(reports[0].integer("lost_bytes", 0, 9), 5);
  EXPECT_EQ(reports[1].integer("ignored_bytes", 0, 9), 8);
}

}  // namespace
}  // namespace pitwall::replay
