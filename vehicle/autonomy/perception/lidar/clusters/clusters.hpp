// Groups of points that belong together, seen from above: those whose cells touch, as DBSCAN with
// cells for neighbourhoods finds them.
//   in     points, the side of a cell, how much is in a cell of a core
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

#include "vehicle/autonomy/perception/lidar/clusters/box_fit.hpp"

namespace pitwall::perception {

using Indices = std::vector<std::uint32_t>;

struct ClusterRule {
  double cell_m = 0.4;
  std::size_t points_least = 5;  // of a cluster
  double weight_least = 0.0;  // of a cell: a thinner one is left out, its points are in no cluster
};

// `weights`: of the points; empty: 1 each.
std::vector<Indices> clusters_of(std::span<const PlanePoint> points, const ClusterRule& rule,
                                 std::span<const float> weights = {});

}  // namespace pitwall::perception
