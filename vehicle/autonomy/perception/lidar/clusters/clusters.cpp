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

using Point = pcl::PointXYZ;
using Cell = std::pair<std::int32_t, std::int32_t>;

Cell cell_of(const PlanePoint& p, double side_m) {
  return {static_cast<std::int32_t>(std::floor(p.x_m / side_m)),
          static_cast<std::int32_t>(std::floor(p.y_m / side_m))};
}

// Points whose cell is full enough.
Indices points_of_full_cells(std::span<const PlanePoint> points, const ClusterRule& rule,
                             std::span<const float> weights) {
  std::map<Cell, double> weight_in;
  for (std::size_t i = 0; i < points.size(); ++i)
    weight_in[cell_of(points[i], rule.cell_m)] +=
        weights.empty() ? 1.0 : static_cast<double>(weights[i]);
  Indices kept;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (weight_in[cell_of(points[i], rule.cell_m)] >= rule.weight_least)
      kept.push_back(static_cast<std::uint32_t>(i));
  return kept;
}

// Points for which their first one stands: those of a small cell.
std::vector<Indices> bundles_of(std::span<const PlanePoint> points, const Indices& kept,
                                double side_m) {
  std::vector<Indices> bundles;
  std::map<Cell, std::size_t> bundle_in;
  for (const std::uint32_t i : kept) {
    const std::size_t next = bundles.size();
    const std::size_t at =
        side_m > 0.0 ? bundle_in.try_emplace(cell_of(points[i], side_m), next).first->second : next;
    if (at == next) bundles.emplace_back();
    bundles[at].push_back(i);
  }
  return bundles;
}

std::vector<pcl::PointIndices> euclidean_clusters(const pcl::PointCloud<Point>::Ptr& cloud,
                                                  double reach_m) {
  constexpr bool kSorted = false;  // neighbours by their distance: not needed
  pcl::EuclideanClusterExtraction<Point> extraction;
  extraction.setClusterTolerance(reach_m);
  extraction.setMinClusterSize(1);
  extraction.setMaxClusterSize(std::numeric_limits<pcl::uindex_t>::max());
  extraction.setSearchMethod(std::make_shared<pcl::search::KdTree<Point>>(kSorted));
  extraction.setInputCloud(cloud);
  std::vector<pcl::PointIndices> found;
  extraction.extract(found);
  return found;
}

}  // namespace

std::vector<Indices> clusters_of(std::span<const PlanePoint> points, const ClusterRule& rule,
                                 std::span<const float> weights) {
  const std::vector<Indices> bundles =
      bundles_of(points, points_of_full_cells(points, rule, weights), rule.bundle_m);
  if (bundles.empty()) return {};
  const auto cloud = std::make_shared<pcl::PointCloud<Point>>();
  for (const Indices& bundle : bundles) {
    const PlanePoint& first = points[bundle.front()];
    cloud->push_back({static_cast<float>(first.x_m), static_cast<float>(first.y_m), 0.0F});
  }
  std::vector<Indices> clusters;
  for (const pcl::PointIndices& one : euclidean_clusters(cloud, rule.reach_m)) {
    Indices& cluster = clusters.emplace_back();
    for (const int i : one.indices) {
      const Indices& bundle = bundles[static_cast<std::size_t>(i)];
      cluster.insert(cluster.end(), bundle.begin(), bundle.end());
    }
    std::ranges::sort(cluster);
  }
  std::erase_if(clusters, [&](const Indices& one) { return one.size() < rule.points_least; });
  std::ranges::sort(clusters, {}, [](const Indices& cluster) { return cluster.front(); });
  return clusters;
}

}  // namespace pitwall::perception
