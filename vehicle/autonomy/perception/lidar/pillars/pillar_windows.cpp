// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/pillars/pillar_windows.hpp"

#include <algorithm>
#include <array>

namespace pitwall::perception {
namespace {

constexpr float kOffWall_m = 0.5F;
// So far away the road sends nothing back: what is a little over it is no road.
constexpr float kFar_100m = 0.5F, kFarOver_m = 0.05F;

bool is_standing(const Pillar& pillar) {
  const auto of = [&](PillarFeature f) { return pillar.features[static_cast<std::size_t>(f)]; };
  const bool is_far = of(PillarFeature::kRange_100m) > kFar_100m;
  const bool is_over =
      of(PillarFeature::kHigh) > 0.0F || (is_far && of(PillarFeature::kTop_m) > kFarOver_m);
  return is_over && of(PillarFeature::kWall_m) > kOffWall_m;
}

}  // namespace

std::vector<PillarWindow> windows_of(std::span<const Pillar> pillars) {
  using Window = PillarWindow;
  constexpr std::size_t kLast = PillarGrid::kRows - Window::kRows;
  static_assert(kLast % Window::kStep == 0);
  std::array<bool, PillarGrid::kRows> is_wanted{};
  for (const Pillar& pillar : pillars) {
    if (!is_standing(pillar)) continue;
    const std::size_t row = pillar.cell / PillarGrid::kColumns;
    const std::size_t from = row - std::min(row, Window::kBeside);
    const std::size_t until = std::min(row + Window::kBeside + 1, PillarGrid::kRows);
    std::fill(is_wanted.begin() + from, is_wanted.begin() + until, true);
  }
  std::vector<Window> windows;
  for (std::size_t row = 0; row < PillarGrid::kRows;) {
    if (!is_wanted[row]) {
      ++row;
      continue;
    }
    const std::size_t core = std::min(row - row % Window::kStep, PillarGrid::kRows - Window::kCore);
    const std::size_t first = core - std::min(core, Window::kMargin);
    windows.push_back({std::min(first, kLast), core});
    row = core + Window::kCore;
  }
  return windows;
}

}  // namespace pitwall::perception
