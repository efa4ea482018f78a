// Diagnostics messages for rqt_robot_monitor and Foxglove's diagnostics panel.
//   in     the state as received by radio, values and alarms of the base, time
//   out    one status for each watchdog of the car, each sensor that was ever received, each
//          receiver, the car's faults, its computer, the radio, each active alarm, the publishers
//   level  OK 0, WARN 1, ERROR 2; STALE 3 for a group that was not received for too long
//   invariants
//          a sensor that was never received is not listed: this car does not have it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "basestation/state/station_field.hpp"
#include "protocol/ros/messages/diagnostic.hpp"
#include "protocol/telemetry/registry/registry.hpp"

namespace pitwall::publishers::ros_view {

enum class Level : std::uint8_t { kOk, kWarn, kError, kStale };

struct AlarmStatus {
  std::string key, text, response, state;
  bool high = false;
};

// Values of the base itself, beside those of the car.
struct BaseStatus {
  Instant at{};
  // kUnset for a field that nothing computes.
  std::array<double, state::kBaseFields> values = [] {
    std::array<double, state::kBaseFields> unset{};
    unset.fill(kUnset);
    return unset;
  }();
  std::vector<AlarmStatus> alarms{};
  // Per publisher: what it dropped and what it refused.
  std::vector<std::pair<std::string, std::uint64_t>> publishers{};
};

// `loses`: a publisher has lost messages lately; its counters alone do not show when.
std::vector<ros::DiagnosticStatus> diagnostics(const telemetry::Snapshot& state,
                                               const BaseStatus& base, const std::string& hardware,
                                               bool loses = false);

}  // namespace pitwall::publishers::ros_view
