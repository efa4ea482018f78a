// Groups of points that belong together, seen from above: Euclidean clusters of the Point Cloud
// Library, after what is too thin to be a surface is left out.
//   in     points, how near to each other they belong together, how much is in a cell of a surface
//   out    indices of the points, cluster after cluster; clusters by their first point, points in
//          their order: the same input gives the same output
//   law    points no more than `reach_m` apart are in one cluster, and so are those that such steps
//          lead to; with bundles this is so of their first points, which take the others along
//   cost   each point is compared with all within its reach: without bundles 240 ms for 10,000 on
//          four cars, with those of 0.1 m 5 ms
//   source R. B. Rusu: Semantic 3D object maps for everyday manipulation in human living
//          environments, dissertation, TU Munich 2009, algorithm 6.2; PCL 1.13
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
  double reach_m = 0.6;
  double bundle_m = 0.0;  // side of the cells of which one point stands for all; 0: each for itself
  std::size_t points_least = 5;  // of a cluster
  double cell_m = 0.4;
  double weight_least = 0.0;  // of a cell: a thinner one is left out, its points are in no cluster
};

// `weights`: of the points; empty: 1 each.
std::vector<Indices> clusters_of(std::span<const PlanePoint> points, const ClusterRule& rule,
                                 std::span<const float> weights = {});

}  // namespace pitwall::perception
