// Groups of points that belong together, seen from above: those whose cells touch, as DBSCAN with
// one point to a core finds them.
//   in     points, the side of a cell
//   out    indices of the points, cluster after cluster; clusters by their first point, points in
//          their order: the same input gives the same output
//   law    points in cells that touch, corners included, are in one cluster; two that are more than
//          2.83 cells apart, with nothing between them, are not
//   cost   O(points log points): 2 ms for 10,000
//   source M. Ester et al.: A density-based algorithm for discovering clusters, KDD 1996
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vehicle/autonomy/perception/lidar/box_fit.hpp"

namespace pitwall::perception {

using Indices = std::vector<std::uint32_t>;

// Clusters of at least `points_least` points.
std::vector<Indices> clusters_of(std::span<const PlanePoint> points, double cell_m,
                                 std::size_t points_least);

}  // namespace pitwall::perception
