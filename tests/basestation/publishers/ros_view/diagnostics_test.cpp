// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/ros_view/diagnostics.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/basestation/publishers/ros_view/sample_state.hpp"

namespace pitwall::publishers::ros_view {
namespace {

using telemetry::field;
using telemetry::Group;
using telemetry::Snapshot;
using testing::kNow;
using testing::sample_state;

BaseStatus base_status() { return {.at = kNow}; }

const ros::DiagnosticStatus* find(const std::vector<ros::DiagnosticStatus>& all,
                                  const std::string& name) {
  const auto found = std::ranges::find(all, name, &ros::DiagnosticStatus::name);
  return found == all.end() ? nullptr : &*found;
}
Level level_of(const Snapshot& state, const std::string& name,
               const BaseStatus& base = base_status()) {
  const auto all = diagnostics(state, base, "");
  const auto* status = find(all, name);
  EXPECT_NE(status, nullptr) << name;
  return status == nullptr ? Level::kOk : static_cast<Level>(status->level);
}

TEST(RosDiagnostics, AWatchdogsStateIsItsLevel) {
  Snapshot state = sample_state();
  const auto dog = field("streams.gnss0_link");
  for (const auto& [health, level] : {std::pair{0.0, Level::kOk},
                                      {1.0, Level::kStale},
                                      {2.0, Level::kOk},
                                      {3.0, Level::kWarn},
                                      {4.0, Level::kError},
                                      {kUnset, Level::kStale}}) {
    state.values[dog] = health;
    EXPECT_EQ(level_of(state, "watchdogs/gnss0_link"), level) << health;
  }
}

TEST(RosDiagnostics, WhatIsNotHeardOfIsStaleAtOnce) {
  Snapshot state = sample_state();
  EXPECT_EQ(level_of(state, "mode"), Level::kOk);
  state.at(Group::kMode) = kNow - seconds(3);
  EXPECT_EQ(level_of(state, "mode"), Level::kStale);
  EXPECT_EQ(level_of(Snapshot{}, "mode"), Level::kStale);
}

TEST(RosDiagnostics, ASensorIsJudgedByItsRateItsGapAndItsLatency) {
  Snapshot state = sample_state();
  const auto set = [&](double rate, double gap, double latency) {
    state.values[field("sensors.lidar_rate")] = rate;
    state.values[field("sensors.lidar_gap")] = gap;
    state.values[field("sensors.lidar_latency")] = latency;
    return level_of(state, "sensors/lidar");
  };
  EXPECT_EQ(set(20, 60, 40), Level::kOk);
  EXPECT_EQ(set(15, 60, 40), Level::kWarn);
  EXPECT_EQ(set(5, 60, 40), Level::kError);
  EXPECT_EQ(set(20, 600, 40), Level::kError);
  EXPECT_EQ(set(20, 60, 200), Level::kWarn);
  EXPECT_EQ(find(diagnostics(state, base_status(), ""), "sensors/radar"), nullptr)
      << "it never came";
}

TEST(RosDiagnostics, AlarmsFaultsLinkAndDropsAreInIt) {
  Snapshot state = sample_state();
  BaseStatus base = base_status();
  EXPECT_EQ(level_of(state, "faults", base), Level::kOk);
  state.values[field("faults.now_more")] = 1;
  EXPECT_EQ(level_of(state, "faults", base), Level::kError);
  base.alarms.push_back({"slip", "slip above 8 %", "lift", "unack", true});
  EXPECT_EQ(level_of(state, "alarms/slip", base), Level::kError);
  EXPECT_EQ(find(diagnostics(state, base, ""), "radio"), nullptr) << "nobody judges the link here";
  base.values[state::index_of(state::BaseField::kLinkState)] = 2;
  EXPECT_EQ(level_of(state, "radio", base), Level::kWarn);
  base.publishers.emplace_back("ros: /tf dropped", 3);
  EXPECT_EQ(level_of(state, "publishers", base), Level::kOk) << "long ago";
  const auto losing = diagnostics(state, base, "", true);
  const auto* const publishers = find(losing, "publishers");
  ASSERT_NE(publishers, nullptr);
  EXPECT_EQ(static_cast<Level>(publishers->level), Level::kWarn);
  EXPECT_EQ(publishers->values.at(0).value, "3");
}

TEST(RosDiagnostics, NamesBearTheCar) {
  for (const auto& status : diagnostics(sample_state(), base_status(), "car 7")) {
    EXPECT_TRUE(status.name.starts_with("car 7/")) << status.name;
    EXPECT_EQ(status.hardware_id, "car 7");
  }
}

}  // namespace
}  // namespace pitwall::publishers::ros_view
