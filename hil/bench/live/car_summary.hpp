// Summary that the car process writes when it stops: its --summary file, a JSON object.
//   errors Problem with the place in the file
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/health.hpp"

namespace pitwall::bench {

// Final state of one message.
struct CarMessage {
  std::uint32_t id = 0;
  std::string liveness{};
  std::uint64_t debt = 0, lost = 0, bad = 0;
  std::uint64_t late = 0;  // reported missing, but arrived later
  Duration mean_interval{};
  Instant last{};
};

// One of its receivers, as vehicle/io/receiver_port.hpp writes it.
struct CarReceiver {
  std::string link, kind;
  std::vector<std::pair<std::string, std::uint64_t>> counts;
};

// One of its sensors on ROS 2 topics: samples, and counts of refused or overwritten ones.
struct CarSensor {
  std::string name;
  std::vector<std::pair<std::string, std::uint64_t>> counts;
};

// Another car that it knew at the end.
struct CarOpponent {
  double x_m = kUnset, y_m = kUnset, speed_mps = kUnset;
};

struct CarSummary {
  using Counts = std::vector<std::pair<std::string, std::uint64_t>>;

  std::uint64_t ticks = 0, missed_deadlines = 0;
  std::uint64_t frames_received = 0, frames_sent = 0, frames_refused = 0, tx_drops = 0;
  std::uint64_t rx_dropped = 0, gate_refusals = 0, missed_shifts = 0;
  std::uint64_t frames_applied = 0, frames_lost = 0, loss_reports = 0;
  Counts refused_by_kind, gate_verdicts;
  std::string controller;
  std::string database, identity, identity_sentence;  // of the bus
  Counts link;
  // Of its radio, from vehicle/io/report/radio_summary.hpp; empty without a radio.
  Counts radio, radio_refused, radio_commands;
  std::vector<Counts> radio_paths;
  std::vector<CarReceiver> receivers;
  std::vector<CarSensor> sensors;
  Counts tracking;  // of other cars
  std::vector<CarOpponent> opponents;
  Counts recorder;  // of its own recording; empty without one
  std::vector<CarMessage> messages;
  std::vector<world::LossReport> losses;  // the first of loss_reports
  double step_p50_us = kUnset, step_p99_us = kUnset, step_max_us = kUnset;
  double tick_late_p50_us = kUnset, tick_late_p99_us = kUnset;
};

Result<CarSummary, Problem> read_car_summary(const std::string& path);

// Frames of detections that reached its loop, or that it refused.
std::uint64_t detections_received(const CarSummary& car);

// Frames due until then that never arrived: those reported missing, less those that arrived later.
std::uint64_t frames_that_never_came(const CarSummary& car, Instant until);

}  // namespace pitwall::bench
