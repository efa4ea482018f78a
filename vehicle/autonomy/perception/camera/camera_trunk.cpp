// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/camera/camera_trunk.hpp"

#include <algorithm>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::perception {
namespace {

constexpr float kMid = 128.0F, kStep = 64.0F;  // training/camera_scenes.py

// Pixels that one of `count` covers, of a side of so many; at least one.
struct Span {
  std::size_t from, to;

  Span(std::size_t i, std::size_t count, std::size_t side)
      : from(i * side / count), to(std::max(from + 1, (i + 1) * side / count)) {}
};

}  // namespace

std::vector<float> planes_of(const Image& image) {
  CHECK(image.width_px > 0 && image.height_px > 0);
  CHECK(image.rgb.size() == 3 * image.width_px * image.height_px);
  constexpr std::size_t kPlane = CameraTrunk::kRows * CameraTrunk::kColumns;
  std::vector<float> planes(CameraTrunk::kColours * kPlane);
  for (std::size_t row = 0; row < CameraTrunk::kRows; ++row) {
    const Span down{row, CameraTrunk::kRows, image.height_px};
    for (std::size_t column = 0; column < CameraTrunk::kColumns; ++column) {
      const Span right{column, CameraTrunk::kColumns, image.width_px};
      std::size_t sums[CameraTrunk::kColours] = {};
      for (std::size_t v = down.from; v < down.to; ++v)
        for (std::size_t u = right.from; u < right.to; ++u)
          for (std::size_t c = 0; c < CameraTrunk::kColours; ++c) sums[c] += image.pixel(u, v)[c];
      const auto pixels = static_cast<float>((down.to - down.from) * (right.to - right.from));
      for (std::size_t c = 0; c < CameraTrunk::kColours; ++c)
        planes[c * kPlane + row * CameraTrunk::kColumns + column] =
            (static_cast<float>(sums[c]) / pixels - kMid) / kStep;
    }
  }
  return planes;
}

}  // namespace pitwall::perception
