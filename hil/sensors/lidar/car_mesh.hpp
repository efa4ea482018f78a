// Bodies of racing cars for the LiDAR model: made of blocks and wheels by published outer sizes.
//   frames Vehicle, see mesh.hpp
//   out    two meshes: bodywork and tyres
//   source length, width: Dallara AV-21 (4.92 m x 1.89 m); Super Formula SF23, the A2RL's car
//          (5.23 m x 1.91 m). Everything within them is read off photographs, to 0.1 m
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "hil/sensors/lidar/mesh.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::sensors {

// Between two upright faces, a rear and a front one; one on each side where it is off the middle.
struct Block {
  struct Face {
    double x_m = kUnset, half_width_m = kUnset, low_m = kUnset, high_m = kUnset;
  };
  Face rear, front;
  double aside_m = 0.0;  // of its middle
};

struct Wheel {
  double x_m = kUnset, aside_m = kUnset, radius_m = kUnset, width_m = kUnset;  // on either side
};

struct CarShape {
  std::string_view name;
  double length_m = kUnset, width_m = kUnset, height_m = kUnset;
  std::vector<Block> blocks;
  std::vector<Wheel> wheels;
  float body_reflectance = 0.4F;
};

CarShape av21_shape();
CarShape sf23_shape();

// In this order.
enum class CarMesh : std::uint8_t { kBody, kTyres };

std::vector<Mesh> car_meshes(const CarShape& shape);

}  // namespace pitwall::sensors
