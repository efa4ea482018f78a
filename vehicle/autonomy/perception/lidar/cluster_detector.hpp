// Cars in a LiDAR sweep without a trained network: what stands on the ground, in clusters that are
// as large as a car can look.
//   in     points in Body or in the sensor's frame, z up, the sensor at its origin
//   out    boxes on the ground, nearest first; of a car that a LiDAR sees from one side or two the
//          box has the size of a car and reaches away from the sensor. Why other clusters are none
//   errors a point that is not finite is counted and left out, as is one beside the crop
//   source the first LiDAR detector of the MIT-Pitt-RW stack: cloth filter, DBSCAN, gates of size
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/perception/lidar/cloth.hpp"
#include "vehicle/autonomy/perception/lidar/point_cloud.hpp"

namespace pitwall::perception {

// The part of a sweep that is looked at: 200 m x 40 m about the sensor, as in the paper.
struct Crop {
  double ahead_m = 100.0, behind_m = 100.0, side_m = 20.0;
};

struct ClusterParams {
  Crop crop;
  ClothParams cloth;
  double above_m = 0.25, below_m = 2.5;  // over the ground: what belongs to a car
  double cell_m = 0.4;
  std::size_t points_least = 5;
  double length_m = 4.92, width_m = 1.89;  // of a car (Dallara AV-21)
  double larger_m = 0.8;                   // beyond both, a cluster is no car
  double extent_least_m = 0.6;             // of the longer side
  double height_least_m = 0.3, height_most_m = 1.8;
};

struct CarBox {
  double x_m = kUnset, y_m = kUnset;  // centre
  double yaw_rad = kUnset;            // front and back may be exchanged
  double length_m = kUnset, width_m = kUnset;
  double ground_m = kUnset, height_m = kUnset;  // of the ground; of the car over it
  std::size_t points = 0;
};

struct ClusterResult {
  std::vector<CarBox> cars;
  std::size_t ground = 0;                                  // points of the ground
  std::size_t not_finite = 0, beside = 0;                  // points; beside: out of the crop
  std::size_t too_large = 0, too_small = 0, too_high = 0;  // clusters
  std::size_t parts = 0;                                   // clusters in the place of a car
};

ClusterResult detect_clusters(std::span<const LidarPoint> sweep, const ClusterParams& params);

}  // namespace pitwall::perception
