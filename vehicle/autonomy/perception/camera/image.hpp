// An image of a camera as its detector takes it.
//   format rows from the top, each pixel red, green, blue, sRGB
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pitwall::perception {

struct Image {
  std::size_t width_px = 0, height_px = 0;
  std::vector<std::uint8_t> rgb;  // 3 x width x height

  const std::uint8_t* pixel(std::size_t u, std::size_t v) const {
    return rgb.data() + 3 * (v * width_px + u);
  }
};

}  // namespace pitwall::perception
