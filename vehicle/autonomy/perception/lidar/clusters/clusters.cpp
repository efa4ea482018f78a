// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/clusters/clusters.hpp"

// Of PCL's templates what is used here is made here: its library of segmentation brings nine others
// along, which cost each start of a program 0.1 s.
#define PCL_NO_PRECOMPILE
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>
#undef PCL_NO_PRECOMPILE

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>

namespace pitwall::perception {
namespace {

using Cell = std::pair<std::int32_t, std::int32_t>;

// Points whose cell is full enough.
Indices points_of_full_cells(std::span<const PlanePoint> points, const ClusterRule& rule,
                             std::span<const float> weights) {
  const auto cell_of = [&](const PlanePoint& p) {
    return Cell{static_cast<std::int32_t>(std::floor(p.x_m / rule.cell_m)),
                static_cast<std::int32_t>(std::floor(p.y_m / rule.cell_m))};
  };
  std::map<Cell, double> weight_in;
  for (std::size_t i = 0; i < points.size(); ++i)
    weight_in[cell_of(points[i])] += weights.empty() ? 1.0 : static_cast<double>(weights[i]);
  Indices kept;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (weight_in[cell_of(points[i])] >= rule.weight_least)
      kept.push_back(static_cast<std::uint32_t>(i));
  return kept;
}

}  // namespace

std::vector<Indices> clusters_of(std::span<const PlanePoint> points, const ClusterRule& rule,
                                 std::span<const float> weights) {
  using Point = pcl::PointXYZ;
  const Indices kept = points_of_full_cells(points, rule, weights);
  if (kept.empty()) return {};
  const auto cloud = std::make_shared<pcl::PointCloud<Point>>();
  for (const std::uint32_t i : kept)
    cloud->push_back({static_cast<float>(points[i].x_m), static_cast<float>(points[i].y_m), 0.0F});
  pcl::EuclideanClusterExtraction<Point> extraction;
  extraction.setClusterTolerance(rule.reach_m);
  extraction.setMinClusterSize(static_cast<pcl::uindex_t>(rule.points_least));
  extraction.setMaxClusterSize(std::numeric_limits<pcl::uindex_t>::max());
  extraction.setSearchMethod(std::make_shared<pcl::search::KdTree<Point>>());
  extraction.setInputCloud(cloud);
  std::vector<pcl::PointIndices> found;
  extraction.extract(found);
  std::vector<Indices> clusters;
  for (const pcl::PointIndices& one : found) {
    Indices& cluster = clusters.emplace_back();
    for (const int i : one.indices) cluster.push_back(kept[static_cast<std::size_t>(i)]);
    std::ranges::sort(cluster);
  }
  std::ranges::sort(clusters, {}, [](const Indices& cluster) { return cluster.front(); });
  return clusters;
}

}  // namespace pitwall::perception
