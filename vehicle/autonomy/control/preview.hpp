// Reading a trajectory by distance: the car's projection on it and what is promised further ahead.
//   frames Map; stations as in TrajectoryPoint::s_m
//   cost   project O(points), at O(log points); no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "vehicle/world/trajectory.hpp"

namespace pitwall::control {

// Station of the nearest point of the polyline; before the first or beyond the last point it goes
// on along the end's tangent. Nothing for fewer than two points or a place that is not finite.
std::optional<double> project(const world::Trajectory& trajectory, double x_m, double y_m);

// Linear between points, yaw along the shorter arc; the last point holds beyond the end. Needs at
// least one point.
world::TrajectoryPoint at(const world::Trajectory& trajectory, double s_m);

}  // namespace pitwall::control
