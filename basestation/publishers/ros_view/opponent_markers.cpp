// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/ros_view/opponent_markers.hpp"

#include <cmath>

#include "basestation/state/vehicle_state.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::publishers::ros_view {
namespace {

using telemetry::field;
using telemetry::FieldIndex;
using telemetry::Group;

constexpr std::int32_t kArrow = 0, kCube = 1, kCylinder = 3, kText = 9;
constexpr std::int32_t kAdd = 0, kDelete = 2;
constexpr double kLength_m = 4.9, kWidth_m = 1.9, kHeight_m = 1.2;  // Dallara IL-15
constexpr double kDisk_m = 0.05;
constexpr double kLeastArrow_m = 0.1;
constexpr float kSeen = 0.9F, kCoasting = 0.35F, kDoubt = 0.3F;  // opacity

struct Seen {
  bool is_known = false;
  Instant at{};
  double station_m = kUnset, offset_m = kUnset, speed_mps = kUnset, sigma_m = kUnset;
  double age_s = kUnset, identity = kUnset;

  bool coasts() const { return age_s > kCoastsAfter_s; }
};

Seen opponent_of(const telemetry::Snapshot& state, std::size_t i, Instant now) {
  const auto group = static_cast<Group>(telemetry::index_of(Group::kOpponent1) + i);
  const auto value = [&](FieldIndex of_first) {
    return state.values[of_first + i * telemetry::fields_of(Group::kOpponent1).count];
  };
  Seen seen{.at = now,
            .station_m = value(field("opponent_1.station")),
            .offset_m = value(field("opponent_1.offset")),
            .speed_mps = value(field("opponent_1.speed")),
            .sigma_m = value(field("opponent_1.position_sigma")),
            .age_s = value(field("opponent_1.age")),
            .identity = value(field("opponent_1.identity"))};
  seen.is_known = state.ever(group) && now - state.at(group) <= state::kStaleAfter &&
                  std::isfinite(seen.station_m) && std::isfinite(seen.offset_m);
  if (seen.is_known) seen.at = state.at(group);
  return seen;
}

std::string text_of(const Seen& seen) {
  const std::string text = formatted("%.0f: %.1f m/s", seen.identity, seen.speed_mps);
  return seen.coasts() ? text + formatted(", seen %.1f s ago", seen.age_s) : text;
}

}  // namespace

ros::MarkerArray opponent_markers(const CarMessages& messages, const telemetry::Snapshot& state,
                                  const state::Course& course, Instant now) {
  ros::MarkerArray all;
  for (std::size_t i = 0; i < kOpponents; ++i) {
    const Seen seen = opponent_of(state, i, now);
    ros::Marker base;
    base.header = messages.header(seen.at, messages.frames().map);
    base.id = static_cast<std::int32_t>(i);
    base.color = {0.9F, 0.3F, 0.1F, seen.coasts() ? kCoasting : kSeen};
    if (seen.is_known) {
      const state::CoursePose at = course.at(seen.station_m, seen.offset_m);
      base.pose = {.position = {at.x_m, at.y_m, 0.5 * kHeight_m},
                   .orientation = quaternion_of(0.0, 0.0, at.yaw_rad)};
    }
    const auto add = [&](const char* name, std::int32_t type, bool known) -> ros::Marker& {
      ros::Marker& marker = all.markers.emplace_back(base);
      marker.ns = name;
      marker.type = type;
      marker.action = known ? kAdd : kDelete;
      return marker;
    };
    add("opponents", kCube, seen.is_known).scale = {kLength_m, kWidth_m, kHeight_m};
    add("opponents_velocity", kArrow, seen.is_known && seen.speed_mps > kLeastArrow_m).scale = {
        seen.speed_mps, 0.25 * kWidth_m, 0.25 * kWidth_m};
    ros::Marker& doubt =
        add("opponents_sigma", kCylinder, seen.is_known && std::isfinite(seen.sigma_m));
    doubt.scale = {2.0 * kSigmas * seen.sigma_m, 2.0 * kSigmas * seen.sigma_m, kDisk_m};
    doubt.pose.position.z = 0.5 * kDisk_m;
    doubt.color.a = kDoubt;
    ros::Marker& text = add("opponents_text", kText, seen.is_known);
    text.scale = {0.0, 0.0, kHeight_m};
    text.pose.position.z = 2.0 * kHeight_m;
    if (seen.is_known) text.text = text_of(seen);
  }
  return all;
}

}  // namespace pitwall::publishers::ros_view
