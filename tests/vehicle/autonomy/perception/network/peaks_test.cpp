// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/network/peaks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/support/draw.hpp"

namespace pitwall::perception {
namespace {

constexpr std::size_t kRows = 7, kColumns = 9;

TEST(Peaks, AreTheGreatestOfTheirNeighbours) {
  std::mt19937_64 random{4};
  for (int round = 0; round < 50; ++round) {
    std::vector<float> planes(2 * kRows * kColumns);
    for (float& value : planes)
      value = static_cast<float>(std::round(testing::draw_uniform(random, -4.0, 4.0)));
    const OutputPlanes out{planes, kRows, kColumns};
    std::size_t expected = 0;
    std::vector<bool> is_peak(kRows * kColumns);
    for (const Cell& cell : peaks_of(out, 0.5)) is_peak[cell.row * kColumns + cell.column] = true;
    for (std::size_t row = 0; row < kRows; ++row)
      for (std::size_t column = 0; column < kColumns; ++column) {
        const std::size_t here = row * kColumns + column;
        bool greatest = planes[here] >= 0.0F;
        for (std::size_t other = 0; other < kRows * kColumns; ++other) {
          const auto apart = [](std::size_t a, std::size_t b) { return a > b ? a - b : b - a; };
          if (other == here || apart(other / kColumns, row) > 1 ||
              apart(other % kColumns, column) > 1)
            continue;
          greatest = greatest && (planes[other] < planes[here] ||
                                  (planes[other] == planes[here] && other > here));
        }
        EXPECT_EQ(is_peak[here], greatest) << row << ' ' << column;
        expected += greatest;
      }
    EXPECT_GT(expected, 0U);
  }
}

TEST(Peaks, TheConfidenceIsTheShareOfTheLogit) {
  std::vector<float> planes(kRows * kColumns, -9.0F);
  planes[20] = 1.0F;
  const OutputPlanes out{planes, kRows, kColumns};
  const double confidence = share_of_logit(1.0);
  EXPECT_NEAR(confidence, 0.7310585786, 1e-9);
  EXPECT_EQ(peaks_of(out, confidence - 1e-6).size(), 1U);
  EXPECT_TRUE(peaks_of(out, confidence + 1e-6).empty());
}

// A plane of logits, and one of figures.
struct TwoPlanes {
  std::vector<float> values = std::vector<float>(2 * kRows * kColumns, -30.0F);

  void set(std::size_t row, std::size_t column, double confidence, float figure) {
    values[row * kColumns + column] = static_cast<float>(std::log(confidence / (1.0 - confidence)));
    values[kRows * kColumns + row * kColumns + column] = figure;
  }
  OutputPlanes out() const { return {values, kRows, kColumns}; }
};

TEST(AroundPeak, ACellThatIsSureAloneSaysItAll) {
  for (const Cell& peak : {Cell{3, 4}, Cell{0, 0}, Cell{kRows - 1, kColumns - 1}}) {
    TwoPlanes planes;
    planes.set(peak.row, peak.column, 0.8, 0.25F);
    const OutputPlanes out = planes.out();
    const AroundPeak around{out, peak};
    EXPECT_NEAR(around.mean(1), 0.25, 1e-6);
    EXPECT_NEAR(around.mean_row(1), static_cast<double>(peak.row) + 0.75, 1e-6);
    EXPECT_NEAR(around.mean_column(1), static_cast<double>(peak.column) + 0.75, 1e-6);
  }
}

// Those beside say the same place from where they are.
TEST(AroundPeak, TheMeanGoesByConfidenceAndThePlaceIsThatOfTheThing) {
  TwoPlanes planes;
  planes.set(3, 4, 0.8, 0.25F), planes.set(3, 5, 0.4, -0.75F), planes.set(3, 6, 0.9, 7.0F);
  const OutputPlanes out = planes.out();
  const AroundPeak around{out, {3, 4}};
  EXPECT_NEAR(around.mean(1), (0.8 * 0.25 - 0.4 * 0.75) / 1.2, 1e-6) << "none two cells off";
  EXPECT_NEAR(around.mean_column(1), 4.75, 1e-6);
}

TEST(Peaks, OfThoseThatAreOneThingTheFirstIsKept) {
  const auto is_near = [](int a, int b) { return std::abs(a - b) < 3; };
  EXPECT_EQ(surest<int>({10, 11, 20, 13, 22}, is_near), (std::vector{10, 20, 13}));
}

}  // namespace
}  // namespace pitwall::perception
