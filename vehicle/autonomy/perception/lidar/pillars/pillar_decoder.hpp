// Cars in the output of the pillar network.
//   in     planes of PillarOutput
//   out    boxes on the road, the surest first
//   law    a car is where its figure is the greatest of its cell and the eight around it; where two
//          boxes overlap, the surer one is kept
//   source X. Zhou, D. Wang, P. Kraehenbuehl: Objects as points, 2019, section 4
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/perception/lidar/car_box.hpp"
#include "vehicle/autonomy/perception/lidar/track_ground.hpp"

namespace pitwall::perception {

struct RoadBox {
  double ahead_m = kUnset, n_m = kUnset;  // centre, along the track from us; offset
  double yaw_rad = kUnset;                // to the road; front and back may be exchanged
  double length_m = kUnset, width_m = kUnset;
  double confidence = kUnset;
};

std::vector<RoadBox> decode(std::span<const float> planes, double confidence_least);

CarBox in_body(const RoadBox& box, const TrackGround& ground);

}  // namespace pitwall::perception
