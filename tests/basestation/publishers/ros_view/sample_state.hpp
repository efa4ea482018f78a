// Example of a received vehicle state: a car on its lap.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "basestation/state/course.hpp"
#include "protocol/telemetry/registry/registry.hpp"

namespace pitwall::publishers::ros_view::testing {

using telemetry::field;
using telemetry::Group;

inline constexpr Instant kNow{seconds(100).ns};
inline constexpr Duration kUtc = seconds(1'700'000'000);

inline telemetry::Snapshot sample_state() {
  telemetry::Snapshot s;
  for (const telemetry::GroupRow& row : telemetry::kGroupTable)
    if (row.direction == telemetry::Direction::kDown) s.at(row.group) = kNow - milliseconds(40);
  for (telemetry::FieldIndex i = 0; i < telemetry::kFieldCount; ++i)
    s.values[i] = telemetry::kFields[i].min;
  const auto set = [&s](telemetry::FieldIndex f, double value) { s.values[f] = value; };
  set(field("ego.x"), 120.0), set(field("ego.y"), -45.0), set(field("ego.yaw"), 0.5);
  set(field("ego.vx"), 66.0), set(field("ego.vy"), 0.25), set(field("ego.yaw_rate"), 0.125);
  set(field("ego.validity"), 1), set(field("ego.position_sigma"), 0.25);
  set(field("localization.sigma_x"), 0.1), set(field("localization.sigma_y"), 0.2);
  set(field("localization.sigma_yaw"), 0.01), set(field("localization.height"), 3.0);
  set(field("localization.sigma_height"), 0.5), set(field("localization.sigma_vx"), 0.05);
  set(field("dynamics.roll"), -0.1), set(field("dynamics.pitch"), 0.02);
  set(field("dynamics.forward"), 1.5), set(field("dynamics.left"), 12.0);
  set(field("dynamics.up"), 9.5);
  set(field("gnss0.status"), 0), set(field("gnss0.type"), 50), set(field("gnss0.sigma"), 0.02);
  set(field("gnss1.status"), 1), set(field("gnss1.type"), 0), set(field("gnss1.sigma"), kUnset);
  set(field("opponent_1.station"), 200.0), set(field("opponent_1.offset"), 2.0);
  set(field("opponent_1.identity"), 9), set(field("opponent_1.speed"), 60.0);
  for (const auto f : {field("opponent_2.station"), field("opponent_3.station"),
                       field("opponent_4.station"), field("sensors.radar_rate")})
    set(f, kUnset);
  for (const auto& span = telemetry::fields_of(Group::kStreams);
       const auto i : {span.first, span.first + 1, span.first + 2})
    set(i, 2);  // the stream is received
  return s;
}

// Course on a circle around the origin, driven counterclockwise.
inline state::Course circle() {
  constexpr double kRadius_m = 300.0, kTurn = 6.283185307179586;
  constexpr int kPoints = 720;
  std::vector<state::CoursePoint> points;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = kTurn * i / kPoints;
    points.push_back({.s_m = angle * kRadius_m,
                      .x_m = kRadius_m * std::cos(angle),
                      .y_m = kRadius_m * std::sin(angle),
                      .yaw_rad = angle + kTurn / 4,
                      .curvature_per_m = 1.0 / kRadius_m});
  }
  return *state::Course::make(std::move(points), kTurn * kRadius_m);
}

}  // namespace pitwall::publishers::ros_view::testing
