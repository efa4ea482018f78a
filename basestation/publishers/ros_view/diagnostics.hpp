// Diagnostics messages for rqt_robot_monitor and Foxglove's diagnostics panel.
//   in     the state as the radio has it, what the base itself finds, time
//   out    one status for each watchdog of the car, each sensor that ever came, each receiver, the
//          car's faults, its computer, the radio, each alarm that stands, each publisher
//   level  OK 0, WARN 1, ERROR 2; STALE 3 for whatever the car has not told of for too long
//   invariants
//          a sensor that never came is not listed: this car does not have it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "basestation/state/station_field.hpp"
#include "protocol/ros/messages/diagnostic.hpp"
#include "protocol/telemetry/registry/snapshot.hpp"

namespace pitwall::publishers::ros_view {

enum class Level : std::uint8_t { kOk, kWarn, kError, kStale };

struct AlarmStatus {
  std::string key, text, response, state;
  bool high = false;
};

// What the base finds besides what the car tells.
struct BaseStatus {
  Instant at{};
  // kUnset where nobody makes it.
  std::array<double, state::kBaseFields> values = [] {
    std::array<double, state::kBaseFields> unset{};
    unset.fill(kUnset);
    return unset;
  }();
  std::vector<AlarmStatus> alarms{};
  // Of publishers: what they dropped, whom they refused.
  std::vector<std::pair<std::string, std::uint64_t>> publishers{};
};

// `loses`: a publisher has lost something lately; its counts only ever grow.
std::vector<ros::DiagnosticStatus> diagnostics(const telemetry::Snapshot& state,
                                               const BaseStatus& base, const std::string& hardware,
                                               bool loses = false);

}  // namespace pitwall::publishers::ros_view
