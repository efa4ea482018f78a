// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/replay/match_report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "protocol/yaml/strict_map.hpp"

namespace pitwall::benchmarks {
namespace {

replay::Comparison run_of(double late_us, double gap_us) {
  const replay::Quantiles late{late_us, 2 * late_us, 3 * late_us, 4 * late_us};
  const replay::Quantiles gap{gap_us, 2 * gap_us, 3 * gap_us, 4 * gap_us};
  return {.wanted = 10, .arrived = 10, .in_order = true, .timing = {{late, gap}}};
}

SensorArrival sensor_run_of(double late_us) {
  SensorArrival out{.frames = run_of(late_us, late_us), .receivers = {}, .order = {}};
  for (DatagramCount& count : out.receivers) count = {.wanted = 4, .arrived = 4, .in_order = true};
  out.order = {.changes = 9, .shown = 8};
  return out;
}

MatchReport report_of(double ours_us, double canplayer_us, double python_us) {
  MatchReport report{.frames = 10, .length_s = 1.0, .host_load = "0.1 0.2 0.3", .figures = {}};
  report.figures.runs = {std::vector{run_of(ours_us, ours_us), run_of(ours_us, ours_us)},
                         std::vector{run_of(ours_us, ours_us)},
                         std::vector{run_of(canplayer_us, canplayer_us)},
                         std::vector{run_of(python_us, python_us)}};
  report.figures.sensors = {sensor_run_of(ours_us)};
  report.figures.reading = {ReadingSpeed{"candump", 1'100.0, 100.0},
                            ReadingSpeed{"ASC", 1'100.0, 100.0}};
  return report;
}

bool all_held(const MatchReport& report) {
  const auto gates = gates_of(report.figures);
  return std::all_of(gates.begin(), gates.end(), [](const MatchGate& g) { return g.held(); });
}

TEST(MatchReport, GatesAreRatiosToThePeers) {
  EXPECT_TRUE(all_held(report_of(10.0, 101.0, 51.0)));
  EXPECT_FALSE(all_held(report_of(10.0, 99.0, 51.0)));
  EXPECT_FALSE(all_held(report_of(10.0, 101.0, 49.0)));
}

TEST(MatchReport, TheRatiosHoldWithSensorsToo) {
  MatchReport report = report_of(10.0, 101.0, 51.0);
  report.figures.runs[kWithSensors] = {run_of(11.0, 11.0)};
  EXPECT_FALSE(all_held(report));
  report.figures.runs[kWithSensors].clear();
  EXPECT_FALSE(all_held(report)) << "not measured";
}

TEST(MatchReport, ADatagramThatIsLostOrOutOfOrderMissesAGate) {
  MatchReport report = report_of(10.0, 101.0, 51.0);
  report.figures.sensors[0].receivers[1].lost = 1;
  EXPECT_FALSE(all_held(report));
  report = report_of(10.0, 101.0, 51.0);
  report.figures.sensors[0].receivers[0].in_order = false;
  EXPECT_FALSE(all_held(report));
  EXPECT_NE(to_text(report).find("ORDER of datagrams LOST"), std::string::npos);
  report = report_of(10.0, 101.0, 51.0);
  report.figures.sensors[0].order->broken = 1;
  EXPECT_FALSE(all_held(report));
  report.figures.sensors[0].order.reset();
  EXPECT_FALSE(all_held(report));
  report.figures.sensors.clear();
  EXPECT_FALSE(all_held(report));
}

TEST(MatchReport, ReadingHasItsOwnGates) {
  MatchReport report = report_of(10.0, 101.0, 51.0);
  report.figures.reading[1].ours_per_s = 900.0;
  EXPECT_FALSE(all_held(report));
  report.figures.reading[1] = {};
  EXPECT_FALSE(all_held(report)) << "not measured";
}

TEST(MatchReport, SpeedDoesNotExcuseALostFrame) {
  MatchReport report = report_of(1.0, 100.0, 100.0);
  ASSERT_TRUE(all_held(report));
  report.figures.runs[kOurs][1].lost = 1;
  EXPECT_FALSE(all_held(report));
  report = report_of(1.0, 100.0, 100.0);
  report.figures.runs[kOurs][0].in_order = false;
  EXPECT_FALSE(all_held(report));
  EXPECT_NE(to_text(report).find("LOST"), std::string::npos);
}

TEST(MatchReport, WhatCannotBeFormedIsMissed) {
  MatchReport report = report_of(1.0, 100.0, 100.0);
  report.figures.runs[kCanplayer][0].timing.reset();
  EXPECT_FALSE(all_held(report));
  report.figures.runs[kCanplayer].clear();
  EXPECT_FALSE(all_held(report));
  EXPECT_FALSE(all_held(report_of(0.0, 100.0, 100.0)));  // nothing is that good
}

TEST(MatchReport, TextAndJsonSayTheSame) {
  const MatchReport report = report_of(10.0, 120.0, 60.0);
  EXPECT_EQ(to_text(report).find("MISSED"), std::string::npos);
  const auto json = yaml::load_text(to_json(report), "json");
  ASSERT_TRUE(json) << to_string(json.error());
  yaml::StrictMap map = json->root();
  EXPECT_TRUE(map.flag("held"));
  EXPECT_EQ(map.integer("frames", 0, 99), 10);
  EXPECT_EQ(map.text("host_load"), "0.1 0.2 0.3");
  yaml::StrictMap sensors = map.map("sensors");
  EXPECT_EQ(sensors.integer("passes", 0, 99), kSensorPasses);
  std::vector<yaml::StrictMap> runs = sensors.maps("runs");
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_EQ(runs[0].maps("receivers").size(), kReceivers);
  EXPECT_EQ(runs[0].map("order").integer("shown", 0, 99), 8);
  EXPECT_NE(to_text(report).find("10 frames, 8 datagrams of 2 receivers; lost 0 and 0"),
            std::string::npos);
}

}  // namespace
}  // namespace pitwall::benchmarks
