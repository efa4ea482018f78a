// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/pillars/pillar_windows.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace pitwall::perception {
namespace {

Pillar pillar_at(std::size_t row, float high, float wall_m) {
  Pillar pillar{.cell = static_cast<std::uint32_t>(row * PillarGrid::kColumns + 40)};
  pillar.features[static_cast<std::size_t>(PillarFeature::kHigh)] = high;
  pillar.features[static_cast<std::size_t>(PillarFeature::kWall_m)] = wall_m;
  return pillar;
}

TEST(PillarWindows, WhereNothingStandsThereIsNone) {
  EXPECT_TRUE(windows_of({}).empty());
  const std::vector<Pillar> pillars{pillar_at(100, 0.0F, 3.0F), pillar_at(300, 0.5F, 0.1F)};
  EXPECT_TRUE(windows_of(pillars).empty()) << "the road, and the wall";
}

TEST(PillarWindows, FarAwayLittleIsEnough) {
  Pillar low = pillar_at(100, 0.0F, 3.0F);
  low.features[static_cast<std::size_t>(PillarFeature::kTop_m)] = 0.09F;
  EXPECT_TRUE(windows_of({&low, 1}).empty());
  low.features[static_cast<std::size_t>(PillarFeature::kRange_100m)] = 0.8F;
  EXPECT_EQ(windows_of({&low, 1}).size(), 1U);
}

TEST(PillarWindows, TheirCoresCoverWhatStandsAndTheirMarginsWhatTheNetworkSees) {
  std::mt19937_64 random{5};
  for (int run = 0; run < 300; ++run) {
    std::vector<Pillar> pillars;
    std::vector<std::size_t> rows;
    for (int i = 0; i <= run % 6; ++i) {
      rows.push_back(random() % PillarGrid::kRows);
      pillars.push_back(pillar_at(rows.back(), 0.25F, 2.0F));
    }
    const auto windows = windows_of(pillars);
    const auto is_covered = [&](std::size_t row) {
      return std::ranges::any_of(windows, [&](const PillarWindow& w) {
        return row >= w.core_row && row < w.core_row + PillarWindow::kCore;
      });
    };
    for (const std::size_t row : rows) {
      const std::size_t first = row - std::min(row, PillarWindow::kBeside);
      const std::size_t last = std::min(row + PillarWindow::kBeside, PillarGrid::kRows - 1);
      for (std::size_t near = first; near <= last; ++near) EXPECT_TRUE(is_covered(near)) << near;
    }
    for (const PillarWindow& w : windows) {
      const std::size_t end = w.first_row + PillarWindow::kRows;
      ASSERT_LE(end, PillarGrid::kRows);
      EXPECT_EQ(w.first_row % PillarWindow::kStep, 0U);
      EXPECT_EQ(w.core_row % PillarWindow::kStep, 0U);
      EXPECT_TRUE(w.first_row == 0 || w.core_row >= w.first_row + PillarWindow::kMargin);
      EXPECT_TRUE(end == PillarGrid::kRows ||
                  end >= w.core_row + PillarWindow::kCore + PillarWindow::kMargin);
    }
  }
}

}  // namespace
}  // namespace pitwall::perception
