// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/ros_view/diagnostics.hpp"

#include <algorithm>
#include <cmath>

#include "basestation/state/derived/sensors.hpp"
#include "basestation/state/vehicle_state.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/telemetry/registry/labels.hpp"

namespace pitwall::publishers::ros_view {
namespace {

using telemetry::field;
using telemetry::FieldIndex;
using telemetry::FieldRow;
using telemetry::Group;
using telemetry::Snapshot;

std::string text_of(double value) { return std::isnan(value) ? "-" : json::number(value); }

std::string text_of(FieldIndex f, double value) {
  const FieldRow& row = telemetry::kFields[f];
  if (std::isnan(value) || row.labels.empty() || row.unit == FieldRow::kBitSet)
    return text_of(value) + (row.unit.empty() ? "" : " " + std::string{row.unit});
  return std::string{telemetry::label_at(row.labels, static_cast<std::size_t>(value))};
}

class Listing {
 public:
  Listing(const Snapshot& state, const BaseStatus& base, const std::string& hardware)
      : state_(state), base_(base), hardware_(hardware) {}

  void add_watchdogs() {
    const auto [first, count] = telemetry::fields_of(Group::kStreams);
    for (FieldIndex f = first; f < first + count; ++f) {
      constexpr std::array kLevels{Level::kOk, Level::kStale, Level::kOk, Level::kWarn,
                                   Level::kError};  // of telemetry::kBaseStates
      const double health = state_.values[f];
      const bool known = health >= 0.0 && health < static_cast<double>(kLevels.size());
      add(Group::kStreams, "watchdogs/" + std::string{telemetry::kFields[f].name},
          known ? kLevels[static_cast<std::size_t>(health)] : Level::kStale,
          known ? text_of(f, health) : "not known", {});
    }
  }

  void add_sensors() {
    constexpr double kEnough = 0.8, kHalf = 0.5, kLongGap_ms = 500.0;
    for (const state::SensorRow& row : state::kSensorTable) {
      const double rate_hz = state_.values[row.rate], gap_ms = state_.values[row.gap];
      if (std::isnan(rate_hz)) continue;
      const double share = rate_hz / row.nominal_hz;
      const double latency_ms = state_.values[row.latency];
      Level level = Level::kOk;
      if (share < kEnough || latency_ms > row.latency_allowed_ms) level = Level::kWarn;
      if (share < kHalf || gap_ms > kLongGap_ms) level = Level::kError;
      add(Group::kSensors, "sensors/" + std::string{row.name}, level,
          text_of(rate_hz) + " of " + text_of(row.nominal_hz) + " Hz",
          {row.rate, row.gap, row.latency});
    }
  }

  void add_receivers() {
    constexpr double kNarrowInt = 50.0, kFixedIns = 56.0, kNone = 0.0;
    for (const Group group : {Group::kGnss0, Group::kGnss1}) {
      if (!state_.ever(group)) continue;
      const FieldIndex first = telemetry::fields_of(group).first;
      const double status = state_.values[first], type = state_.values[first + 1];
      Level level = Level::kWarn;
      if (type == kNarrowInt || type == kFixedIns) level = Level::kOk;
      if (status != 0.0 || type == kNone) level = Level::kError;
      std::vector<FieldIndex> fields;
      for (FieldIndex f = first; f < first + telemetry::fields_of(group).count; ++f)
        fields.push_back(f);
      add(group, group == Group::kGnss0 ? "gnss/top" : "gnss/bottom", level,
          level == Level::kError ? "no solution" : "position type " + text_of(type), fields);
    }
  }

  void add_car() {
    add_whole(Group::kMode, "mode", Level::kOk, text_of(field("mode.mode"), now("mode.mode")));
    const bool faulty = now("faults.now") > 0.0 || now("faults.now_more") > 0.0;
    add_whole(Group::kFaults, "faults", faulty ? Level::kError : Level::kOk,
              faulty ? text_of(field("faults.last_cause"), now("faults.last_cause")) : "none");
    add_whole(Group::kComputer, "computer", Level::kOk,
              text_of(field("computer.temperature"), now("computer.temperature")));
    add_whole(Group::kFuel, "fuel", Level::kOk, text_of(field("fuel.level"), now("fuel.level")));
    add_whole(Group::kBus, "can_bus", Level::kOk,
              text_of(field("bus.controller"), now("bus.controller")));
  }

  void add_link() {
    const double link = base_.values[state::index_of(state::BaseField::kLinkState)];
    if (std::isnan(link)) return;
    constexpr std::array kLevels{Level::kStale, Level::kOk, Level::kWarn, Level::kError};
    ros::DiagnosticStatus& status =
        push("radio", kLevels[std::min(static_cast<std::size_t>(link), kLevels.size() - 1)],
             std::string{telemetry::label_at(state::kLinkStates, static_cast<std::size_t>(link))});
    for (std::size_t i = 0; i < state::kBaseFields; ++i) {
      const state::BaseRow& row = state::kBaseTable[i];
      if (row.group == "link")
        status.values.push_back({std::string{row.name}, text_of(base_.values[i])});
    }
  }

  void add_alarms() {
    for (const AlarmStatus& alarm : base_.alarms) {
      ros::DiagnosticStatus& status =
          push("alarms/" + alarm.key, alarm.high ? Level::kError : Level::kWarn, alarm.text);
      status.values = {{"response", alarm.response}, {"state", alarm.state}};
    }
  }

  void add_publishers(bool loses) {
    ros::DiagnosticStatus& status = push("publishers", loses ? Level::kWarn : Level::kOk,
                                         loses ? "messages are lost" : "nothing lost lately");
    for (const auto& [name, count] : base_.publishers)
      status.values.push_back({name, std::to_string(count)});
  }

  std::vector<ros::DiagnosticStatus> all_;

 private:
  template <std::size_t N>
  double now(const char (&path)[N]) const {
    const auto id = state::find_field(path);
    return state_.values[*id];
  }

  ros::DiagnosticStatus& push(const std::string& name, Level level, std::string message) {
    return all_.emplace_back(
        ros::DiagnosticStatus{.level = static_cast<ros::Byte>(level),
                              .name = (hardware_.empty() ? "" : hardware_ + "/") + name,
                              .message = std::move(message),
                              .hardware_id = hardware_,
                              .values = {}});
  }

  void add(Group group, const std::string& name, Level level, std::string message,
           const std::vector<FieldIndex>& fields) {
    const Duration age = base_.at - state_.at(group);
    const bool ever = state_.ever(group);
    if (!ever) level = Level::kStale, message = "not received yet";
    if (ever && age > state::stale_after(telemetry::row_of(group).target_age)) {
      level = Level::kStale;
      message = "not heard of for " + std::to_string(age.ns / kNanosecondsPerSecond) + " s";
    }
    ros::DiagnosticStatus& status = push(name, level, std::move(message));
    for (const FieldIndex f : fields)
      status.values.push_back(
          {std::string{telemetry::kFields[f].name}, text_of(f, state_.values[f])});
  }

  void add_whole(Group group, const std::string& name, Level level, std::string message) {
    const auto [first, count] = telemetry::fields_of(group);
    std::vector<FieldIndex> fields;
    for (FieldIndex f = first; f < first + count; ++f) fields.push_back(f);
    add(group, name, level, std::move(message), fields);
  }

  const Snapshot& state_;
  const BaseStatus& base_;
  const std::string& hardware_;
};

}  // namespace

std::vector<ros::DiagnosticStatus> diagnostics(const Snapshot& state, const BaseStatus& base,
                                               const std::string& hardware, bool loses) {
  Listing listing{state, base, hardware};
  listing.add_car();
  listing.add_watchdogs();
  listing.add_sensors();
  listing.add_receivers();
  listing.add_link();
  listing.add_alarms();
  listing.add_publishers(loses);
  return std::move(listing.all_);
}

}  // namespace pitwall::publishers::ros_view
