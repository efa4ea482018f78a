// Rows of the grid in which something stands over the road: there alone a car can be, and there
// alone the network has to look.
//   in     pillars of a sweep
//   out    windows, from behind us to ahead. Their cores cover each row within kBeside rows of a
//          pillar with points over the road, off the walls
//   law    what the network says of a core is what it would say of the whole grid: its layers see
//          no further than kMargin rows to either side
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "vehicle/autonomy/perception/lidar/pillars/pillar_grid.hpp"

namespace pitwall::perception {

struct PillarWindow {
  static constexpr std::size_t kRows = 192, kMargin = 64, kCore = kRows - 2 * kMargin;
  // A car's middle is not further from what is seen of it; 4.8 m.
  static constexpr std::size_t kBeside = 12;
  // Coarsest stride of the network: a window begins at a multiple of it.
  static constexpr std::size_t kStep = 8;

  std::size_t first_row = 0;  // of the grid
  std::size_t core_row = 0;   // the first of kCore
};

std::vector<PillarWindow> windows_of(std::span<const Pillar> pillars);

}  // namespace pitwall::perception
