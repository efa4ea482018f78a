// Registry rows of health: watchdogs, sensors, receivers, computer, faults, bus, radio.
//   source NovAtel OEM7: solution status below 23, position types below 81; the watchdogs of
//          vehicle/safety/watchdog.hpp in its order, which the telemetry mapper checks
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "protocol/telemetry/registry/rows.hpp"

namespace pitwall::telemetry::rows {

constexpr FieldRow stream(std::string_view name) {
  return choice(Group::kStreams, name, kBaseStates, 6);
}
constexpr FieldRow rate(std::string_view name) { return {Group::kSensors, name, "Hz", 0, 250, 1}; }
constexpr FieldRow gap(std::string_view name) {  // maximum of the last second
  return {Group::kSensors, name, "ms", 0, 1'016, 4};
}
constexpr FieldRow latency(std::string_view name) {  // from measurement to reception; likewise
  return {Group::kSensors, name, "ms", 0, 508, 2};
}
constexpr FieldRow drops(std::string_view name) {  // messages since the start that were not used
  return count(Group::kSensors, name, 65'533);
}

// What a camera sees off, on the mean of many cars, against the LiDARs.
constexpr FieldRow bearing_bias(std::string_view name) {
  return {Group::kSensors, name, "rad", -0.1, 0.1, 0.0005};
}
constexpr FieldRow distance_ratio(std::string_view name) {
  return {Group::kSensors, name, "", 0.5, 2, 0.01};
}

constexpr std::size_t kReceiverFields = 15;
constexpr std::array<FieldRow, kReceiverFields> receiver(Group group) {
  return {{{group, "status", "", 0, 62, 1},
           {group, "type", "", 0, 126, 1},
           {group, "satellites", "", 0, 62, 1},
           {group, "sigma", "m", 0, 20, 0.01},  // horizontal, the larger of both
           {group, "height_sigma", "m", 0, 20, 0.02},
           {group, "differential_age", "s", 0, 100, 0.5},
           {group, "heading_status", "", 0, 62, 1},
           {group, "heading_type", "", 0, 126, 1},
           {group, "heading_sigma", "rad", 0, 0.5, 0.001},
           {group, "speed", "m/s", 0, 102, 0.1},
           {group, "position_age", "s", 0, 10, 0.02},
           choice(group, "position_verdict", kSampleVerdicts, 62),  // on the newest sample
           choice(group, "velocity_verdict", kSampleVerdicts, 62),
           choice(group, "heading_verdict", kSampleVerdicts, 62),
           choice(group, "attitude_verdict", kSampleVerdicts, 62)}};
}
inline constexpr auto kGnss0 = receiver(Group::kGnss0);
inline constexpr auto kGnss1 = receiver(Group::kGnss1);

// Decoder statistics of each receiver: counts since the start of the car's process.
inline constexpr auto kReceiverRows = std::to_array<FieldRow>({
    large_count(Group::kReceivers, "bytes_0"),
    large_count(Group::kReceivers, "logs_0"),
    count(Group::kReceivers, "bad_checksum_0"),
    count(Group::kReceivers, "bad_frame_0"),
    count(Group::kReceivers, "resyncs_0"),
    count(Group::kReceivers, "refused_0"),
    count(Group::kReceivers, "lost_0"),
    large_count(Group::kReceivers, "bytes_1"),
    large_count(Group::kReceivers, "logs_1"),
    count(Group::kReceivers, "bad_checksum_1"),
    count(Group::kReceivers, "bad_frame_1"),
    count(Group::kReceivers, "resyncs_1"),
    count(Group::kReceivers, "refused_1"),
    count(Group::kReceivers, "lost_1"),
});

inline constexpr auto kStreamRows = std::to_array<FieldRow>({
    stream("gnss0_link"),     stream("gnss1_link"),     stream("gnss0_position"),
    stream("gnss1_position"), stream("gnss0_solution"), stream("gnss1_solution"),
    stream("gnss0_velocity"), stream("gnss1_velocity"), stream("gnss0_heading"),
    stream("gnss1_heading"),  stream("imu0"),           stream("imu1"),
    stream("wheel_speed"),    stream("brake"),          stream("throttle"),
    stream("steering"),       stream("misc"),           stream("powertrain"),
    stream("diagnostics"),    stream("race_control"),   stream("planner"),
    stream("radio"),
});

// lidar: frames of detections, however they are made; lidar0 to lidar2: clouds of points.
inline constexpr auto kSensorRows = std::to_array<FieldRow>({
    rate("gnss0_rate"),
    gap("gnss0_gap"),
    latency("gnss0_latency"),
    rate("gnss1_rate"),
    gap("gnss1_gap"),
    latency("gnss1_latency"),
    rate("imu0_rate"),
    gap("imu0_gap"),
    latency("imu0_latency"),
    rate("imu1_rate"),
    gap("imu1_gap"),
    latency("imu1_latency"),
    rate("lidar_rate"),
    gap("lidar_gap"),
    latency("lidar_latency"),
    drops("lidar_drops"),
    rate("lidar0_rate"),
    gap("lidar0_gap"),
    latency("lidar0_latency"),
    drops("lidar0_drops"),
    rate("lidar1_rate"),
    gap("lidar1_gap"),
    latency("lidar1_latency"),
    drops("lidar1_drops"),
    rate("lidar2_rate"),
    gap("lidar2_gap"),
    latency("lidar2_latency"),
    drops("lidar2_drops"),
    rate("camera0_rate"),
    gap("camera0_gap"),
    latency("camera0_latency"),
    drops("camera0_drops"),
    bearing_bias("camera0_bearing_bias"),
    distance_ratio("camera0_distance_ratio"),
    rate("camera1_rate"),
    gap("camera1_gap"),
    latency("camera1_latency"),
    drops("camera1_drops"),
    bearing_bias("camera1_bearing_bias"),
    distance_ratio("camera1_distance_ratio"),
    rate("radar_rate"),
    gap("radar_gap"),
    latency("radar_latency"),
    drops("radar_drops"),
});

inline constexpr auto kHealthRows = [] {
  using enum Group;
  return std::to_array<FieldRow>({
      {kComputer, "step_time_max", "us", 0, 131'000, 2},
      {kComputer, "step_time_p50", "us", 0, 10'200, 10},
      count(kComputer, "steps"),
      count(kComputer, "missed_deadlines"),
      share(kComputer, "processor"),
      {kComputer, "memory", "MiB", 0, 32'000, 32},
      {kComputer, "temperature", "degC", 0, 127, 0.5},

      {kFaults, "now", FieldRow::kBitSet, 0, 2'147'483'646, 1, kFaultNames},
      {kFaults, "now_more", FieldRow::kBitSet, 0, 16'777'213, 1, kFaultNamesMore},
      count(kFaults, "recorded"),
      choice(kFaults, "last_cause", kStopCauses, 126),
      {kFaults, "last_age", "s", 0, 1'000, 1},

      large_count(kBus, "frames_applied"),
      count(kBus, "frames_refused"),
      large_count(kBus, "frames_sent"),
      count(kBus, "tx_drops"),
      count(kBus, "gate_refusals"),
      count(kBus, "frames_lost"),
      count(kBus, "queue_losses"),
      choice(kBus, "controller", kControllerStates, 6),
      choice(kBus, "identity", kIdentities, 6),
      {kBus, "differing_id", "", 0, 536'870'911, 1},
      large_count(kBus, "database"),  // upper half of its fingerprint

      choice(kRadio, "base", kBaseStates, 6),
      choice(kRadio, "rung", kLinkLossLevels, 6),
      {kRadio, "silence", "s", 0, 50, 0.05},
      {kRadio, "round_trip", "ms", 0, 2'000, 0.5},
      count(kRadio, "heartbeats"),          // packets of the base that were accepted
      count(kRadio, "heartbeats_refused"),  // packets of the base that were refused
      count(kRadio, "base_runs"),           // sessions
      share(kRadio, "loss_0"),              // of the packets received on path 0
      share(kRadio, "loss_1"),
      {kRadio, "delay_0", "ms", 0, 2'000, 2},  // one way, 99th percentile
      {kRadio, "delay_1", "ms", 0, 2'000, 2},
      share(kRadio, "budget_use_0"),  // of the packets sent on path 0
      share(kRadio, "budget_use_1"),
      count(kRadio, "slots_skipped"),
      {kRadio, "threats", FieldRow::kBitSet, 0, 126, 1, kThreatNames},  // as the car detects them
  });
}();

}  // namespace pitwall::telemetry::rows
