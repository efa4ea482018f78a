// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/health_mapper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/vehicle/pipeline/mapped_car.hpp"
#include "vehicle/safety/watchdog.hpp"

namespace pitwall::pipeline {
namespace {

using namespace testing;  // NOLINT: the fixture of this test
using telemetry::Group;

const std::vector<Row> kHealthRows{
    {field("bus.frames_applied"), 1001},
    {field("bus.frames_refused"), 37},
    {field("bus.frames_sent"), 2002},
    {field("bus.tx_drops"), 3},
    {field("bus.gate_refusals"), 77},
    {field("bus.frames_lost"), 12},
    {field("bus.queue_losses"), 9},  // of socket and interface
    {field("bus.controller"), 3},
    {field("bus.identity"), 2},
    {field("bus.differing_id"), 1312},
    {field("bus.database"), 0x12345678},
    {field("computer.step_time_max"), 66},
    {field("computer.steps"), 4004},
    {field("computer.missed_deadlines"), 5},
    {field("radio.base"), 3},
    {field("radio.silence"), 1.25},
    {field("radio.round_trip"), 12.5},
    {field("radio.heartbeats"), 88},
    {field("radio.heartbeats_refused"), 9},
    {field("radio.base_runs"), 2},
    {field("radio.rung"), 3},
    {field("radio.slots_skipped"), 6},
    {field("radio.threats"), 34},
    {field("radio.loss_0"), 0.25},
    {field("radio.loss_1"), 0.125},
    {field("radio.delay_0"), 40},
    {field("radio.delay_1"), 44},
    {field("radio.budget_use_0"), 0.5},
    {field("radio.budget_use_1"), 0.75},
    {field("localization.sigma_x"), 0.01},
    {field("localization.sigma_y"), 0.02},
    {field("localization.sigma_yaw"), 0.03},
    {field("localization.sigma_vx"), 0.04},
    {field("localization.sigma_vy"), 0.05},
    {field("localization.gyro_bias"), 0.01},
    {field("localization.position_age"), 0.06},
    {field("localization.position_units"), 2},
    {field("localization.heading_units"), 3},
    {field("localization.imu_units"), 1},
    {field("localization.accepted"), 500},
    {field("localization.outliers"), 41},
    {field("localization.unsolved"), 42},
    {field("localization.uncertain"), 43},
    {field("localization.late"), 44},
    {field("localization.implausible"), 45},
    {field("localization.restarts"), 3},
    {field("localization.excluded"), 10},
    {field("localization.velocity_units"), 0},
    {field("localization.imu0_verdict"), 1},
    {field("localization.imu1_verdict"), 23},
    {field("localization.wheel_verdict"), 22},
    {field("localization.contradicted"), 46},
    {field("localization.bad_stamps"), 47},
    {field("localization.height"), -3.5},
    {field("localization.sigma_height"), 0.06},
    {field("sensors.gnss1_rate"), 20},
    {field("sensors.gnss1_gap"), 50},
    {field("sensors.gnss1_latency"), 30},
    {field("sensors.imu0_rate"), 100},
    {field("sensors.imu0_gap"), 10},
    {field("sensors.imu0_latency"), 4},
    {field("sensors.lidar_rate"), 19},
    {field("sensors.lidar_gap"), 61},
    {field("sensors.lidar_latency"), 42},
    {field("sensors.lidar_drops"), 3},
    {field("sensors.lidar0_rate"), 20},
    {field("sensors.lidar0_gap"), 51},
    {field("sensors.lidar0_latency"), 40},
    {field("sensors.lidar0_drops"), 4},
    {field("sensors.lidar1_rate"), 17},
    {field("sensors.lidar1_gap"), 52},
    {field("sensors.lidar1_latency"), 41},
    {field("sensors.lidar1_drops"), 5},
    {field("sensors.lidar2_rate"), 16},
    {field("sensors.lidar2_gap"), 53},
    {field("sensors.lidar2_latency"), 43},
    {field("sensors.lidar2_drops"), 6},
    {field("sensors.camera0_rate"), 18},
    {field("sensors.camera0_gap"), 71},
    {field("sensors.camera0_latency"), 52},
    {field("sensors.camera0_drops"), 7},
    {field("sensors.camera0_bearing_bias"), 0.02},
    {field("sensors.camera0_distance_ratio"), 1.25},
    {field("sensors.camera1_rate"), 14},
    {field("sensors.camera1_gap"), 72},
    {field("sensors.camera1_latency"), 53},
    {field("sensors.camera1_drops"), 8},
    {field("sensors.camera1_bearing_bias"), -0.03},
    {field("sensors.camera1_distance_ratio"), 0.8},
    {field("sensors.radar_rate"), 15},
    {field("sensors.radar_gap"), 81},
    {field("sensors.radar_latency"), 62},
    {field("sensors.radar_drops"), 9},
    {field("receivers.bytes_0"), 601},
    {field("receivers.logs_0"), 602},
    {field("receivers.bad_checksum_0"), 603},
    {field("receivers.bad_frame_0"), 604},
    {field("receivers.resyncs_0"), 605},
    {field("receivers.refused_0"), 606},
    {field("receivers.lost_0"), 607},
    {field("receivers.bytes_1"), 701},
    {field("receivers.lost_1"), 707},
    {field("gnss1.status"), 0},
    {field("gnss1.type"), 50},
    {field("gnss1.satellites"), 17},
    {field("gnss1.sigma"), 0.03},
    {field("gnss1.height_sigma"), 0.04},
    {field("gnss1.heading_status"), 6},
    {field("gnss1.heading_type"), 34},
    {field("gnss1.heading_sigma"), 0.004},
    {field("gnss1.speed"), 61.5},
    {field("gnss1.position_age"), 0.03},
    {field("gnss1.differential_age"), 1.5},
    {field("gnss1.position_verdict"), 19},
    {field("gnss1.velocity_verdict"), 1},
    {field("gnss1.heading_verdict"), 15},
    {field("gnss1.attitude_verdict"), 10},
    {field("computer.step_time_p50"), 40},
    {field("computer.processor"), 0.4},
    {field("computer.memory"), 512},
    {field("computer.temperature"), 61.5},
    {field("faults.now"), 1.0 + 1073741824.0},  // first and last of them
    {field("faults.now_more"), 1.0 + 2097152.0},
    {field("faults.recorded"), 2},
    {field("faults.last_cause"), 28},
    {field("faults.last_age"), 4},
};

TEST(HealthTap, EachFieldSaysWhatTheTickSays) { expect(kHealthRows); }

TEST(HealthTap, EveryStreamOfTheWatchdogIsInItsPlace) {
  const Outputs out = full();
  const auto snapshot = mapped(out);
  const auto [first, count] = telemetry::fields_of(Group::kStreams);
  ASSERT_EQ(count, safety::kStreams);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(snapshot.values[first + i], static_cast<double>(out.watchdog.rows[i].health));
    std::string name{telemetry::kFields[first + i].name};
    std::replace(name.begin(), name.end(), '_', ' ');
    if (name == "misc") name = "drive-by-wire state";
    EXPECT_EQ(name, safety::WatchdogParams{}.limits[i].name);
  }
}

// A receiver that is silent says nothing, and its group is never sent.
TEST(HealthTap, OfASilentReceiverNothingIsKnown) {
  const auto snapshot = mapped(full());
  EXPECT_FALSE(snapshot.ever(Group::kGnss0));
  const auto [first, count] = telemetry::fields_of(Group::kGnss0);
  for (std::size_t i = first; i < first + count; ++i)
    EXPECT_TRUE(std::isnan(snapshot.values[i])) << name_of(i);
}

TEST(HealthTap, APositionFromTheFutureIsShownAsOfNow) {
  const auto car = std::make_unique<Car>();
  TickLog log;
  world::SensorInput sensors;
  (void)sensors.positions.push({.unit = 0, .at = kNow + seconds(2)});
  log.note({.now = kNow, .can = {}, .sensors = sensors, .requests = {}}, {}, 1200.0);
  const auto snapshot =
      map_telemetry({.setup = setup(), .car = *car, .out = {}, .log = log, .io = {}, .now = kNow});
  EXPECT_EQ(snapshot.at(Group::kGnss0), kNow);
  EXPECT_EQ(snapshot.values[field("gnss0.position_age")], 0.0);
}

// Else the last verdict before the silence would stay at the pit wall.
TEST(HealthTap, OfAReceiverThatFellSilentTheVerdictIsOfNow) {
  const auto car = full_car();
  TickLog log = full_log();
  const Instant later = kNow + seconds(10);
  log.note({.now = later, .can = {}, .sensors = {}, .requests = {}}, {}, 1200.0);
  using localization::Source;
  car->localization.streams[static_cast<std::size_t>(Source::kPosition)][1].verdict =
      localization::Gate::kSilent;
  const auto snapshot =
      map_telemetry({.setup = setup(), .car = *car, .out = {}, .log = log, .io = {}, .now = later});
  EXPECT_EQ(snapshot.at(Group::kGnss1), later);
  EXPECT_EQ(snapshot.values[field("gnss1.position_verdict")],
            static_cast<double>(localization::Gate::kSilent));
  EXPECT_NEAR(snapshot.values[field("gnss1.position_age")], 10.03, 1e-9);
}

}  // namespace
}  // namespace pitwall::pipeline
