// Surfaces that a LiDAR's ray can meet: triangles of one reflectance.
//   frames those of the maker: Map for what stands still, Vehicle (x forward, y left, z up, origin
//          under the middle of the car's rectangle, on the road) for a car
//   units  reflectance: share of the light that a white surface would send back
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace pitwall::sensors {

using Corner = std::array<float, 3>;

struct Mesh {
  float reflectance = 0.1F;
  std::vector<Corner> corners{};
  std::vector<std::array<std::uint32_t, 3>> triangles{};

  // The corners in order around it.
  void add_quad(const std::array<Corner, 4>& around) {
    const auto first = static_cast<std::uint32_t>(corners.size());
    corners.insert(corners.end(), around.begin(), around.end());
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first, first + 2, first + 3});
  }
};

}  // namespace pitwall::sensors
