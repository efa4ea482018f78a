// Cars in a LiDAR sweep without a trained network: what stands on the ground, in clusters that are
// as large as a car can look.
//   in     points in Body or in the sensor's frame, z up, the sensor near its origin; on a known
//          track the map's ground under them
//   out    boxes on the ground, nearest first; of a car that a LiDAR sees from one side or two the
//          box has the size of a car and reaches away from the sensor. Why other clusters are none
//   law    on a track, what is beyond the walls or as near to them as no car can be is no car, and
//          a car of which too little is seen has the direction of the track
//   errors a point that is not finite is counted and left out, as is one beside the crop
//   source the first LiDAR detector of the MIT-Pitt-RW stack: cloth filter, DBSCAN, gates of size
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/perception/lidar/car_box.hpp"
#include "vehicle/autonomy/perception/lidar/clusters/cloth.hpp"
#include "vehicle/autonomy/perception/lidar/point_cloud.hpp"
#include "vehicle/autonomy/perception/lidar/track_ground.hpp"

namespace pitwall::perception {

// The part of a sweep that is looked at: 200 m x 40 m about the sensor, as in the paper.
struct Crop {
  double ahead_m = 100.0, behind_m = 100.0, side_m = 20.0;
};

// On a known track, along it: the paper's box loses a car at 100 m in a turn.
struct TrackCrop {
  double ahead_m = 200.0, behind_m = 100.0;
  double wall_m = 0.3;  // so near to a wall, what is seen is the wall
};

struct ClusterParams {
  Crop crop;
  TrackCrop track_crop;
  ClothParams cloth;
  double above_m = 0.25, below_m = 2.5;  // over the ground: what belongs to a car
  // Over the map's ground; from `far_m` on the road itself sends nothing back.
  double road_above_m = 0.15, far_above_m = 0.05, far_m = 55.0;
  double reach_m = 0.6;   // between points of one cluster
  double bundle_m = 0.1;  // in which one point stands for all: many are on a car that is near
  double cell_m = 0.4;
  double stretch = 2.5;  // of the cell along a road: parts of one car are further apart than cars
  double ray_rad = 0.0024, ring_rad = 0.0094;  // between rays, between rings
  double full_least = 0.05;     // of what a wall of 1 m would fill a cell with: less is dust
  double cells_least = 0.6;     // of such cells, in a car; its rear fills four
  double joined_wider_m = 0.2;  // than a car: of clusters that are its parts
  std::size_t points_least = 4;
  double length_m = 4.92, width_m = 1.89;  // of a car (Dallara AV-21)
  double longer_m = 1.5, wider_m = 0.8;    // beyond either, a cluster is no car
  double side_seen_m = 3.0;                // longer than this, it is the side of a car
  double turned_most_rad = 0.5;            // of a car to the road
  double extent_least_m = 0.6;             // of the longer side
  double height_least_m = 0.3, height_most_m = 1.4;
  double higher_share = 0.1;  // of the points, above that: dust; with more it is no car
};

struct ClusterResult {
  std::vector<CarBox> cars;
  std::size_t ground = 0;                  // points of the ground
  std::size_t dust = 0;                    // points without a surface
  std::size_t not_finite = 0, beside = 0;  // points; beside: out of the crop
  std::size_t too_thin = 0, too_large = 0, too_small = 0, too_high = 0;  // clusters
  std::size_t parts = 0;  // clusters in the place of a car
};

ClusterResult detect_clusters(std::span<const LidarPoint> sweep, const ClusterParams& params);
// `others_mps`: the speed along the road at which the others are taken to go while a sweep lasts.
ClusterResult detect_clusters(std::span<const LidarPoint> sweep, const TrackGround& ground,
                              double others_mps, const ClusterParams& params);

}  // namespace pitwall::perception
