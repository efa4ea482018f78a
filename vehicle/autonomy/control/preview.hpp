// Look-up in a trajectory by distance: projection of the car, and trajectory point at a station.
//   frames Map; stations as in TrajectoryPoint::s_m
//   cost   project O(points), at O(log points); no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "vehicle/world/trajectory.hpp"

namespace pitwall::control {

// Station of the nearest point of the polyline, which is extended along the tangents of its ends.
// Returns nullopt for fewer than two points or a position that is not finite.
std::optional<double> project(const world::Trajectory& trajectory, double x_m, double y_m);

// Linear interpolation between points, yaw along the shorter arc; beyond the end the last point.
// Requires at least one point.
world::TrajectoryPoint at(const world::Trajectory& trajectory, double s_m);

}  // namespace pitwall::control
