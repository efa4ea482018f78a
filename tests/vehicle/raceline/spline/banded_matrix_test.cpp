// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/spline/banded_matrix.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "protocol/vocabulary/random.hpp"

namespace pitwall::raceline {
namespace {

// A x = b for a known x, with diagonals that are small beside the others: without an exchange of
// rows the result would be noise.
TEST(BandedMatrix, SolvesWhatItWasMadeOf) {
  Random random{7};
  for (const auto& [order, lower, upper] :
       {std::array<std::size_t, 3>{1, 0, 0}, {5, 1, 2}, {40, 11, 11}, {97, 5, 3}, {12, 11, 11}}) {
    BandedMatrix matrix{order, lower, upper};
    std::vector<double> x(order), b(order, 0.0);
    for (double& value : x) value = random.between(-1.0, 1.0);
    for (std::size_t row = 0; row < order; ++row)
      for (std::size_t column = row > lower ? row - lower : 0;
           column < std::min(order, row + upper + 1); ++column) {
        const double value = random.between(-1.0, 1.0) * (row == column && order > 1 ? 1e-9 : 1.0);
        matrix.add(row, column, value);
        b[row] += value * x[column];
      }
    ASSERT_TRUE(matrix.solve(b)) << order;
    for (std::size_t i = 0; i < order; ++i) EXPECT_NEAR(b[i], x[i], 1e-8) << order << " " << i;
  }
}

TEST(BandedMatrix, AddsToWhatIsThere) {
  BandedMatrix matrix{1, 0, 0};
  matrix.add(0, 0, 1.5);
  matrix.add(0, 0, 0.5);
  std::vector<double> b{4.0};
  ASSERT_TRUE(matrix.solve(b));
  EXPECT_DOUBLE_EQ(b[0], 2.0);
}

TEST(BandedMatrix, AFoldedRowIsAnOrderOfNearNeighbours) {
  for (const std::size_t n : {1U, 2U, 3U, 8U, 9U}) {
    std::set<std::size_t> places;
    for (std::size_t i = 0; i < n; ++i) {
      places.insert(folded(i, n));
      EXPECT_LT(folded(i, n), n);
      const std::size_t here = folded(i, n), next = folded((i + 1) % n, n);
      EXPECT_LE(std::max(here, next) - std::min(here, next), 2U) << i << " of " << n;
    }
    EXPECT_EQ(places.size(), n);
  }
}

TEST(BandedMatrix, TellsASingularOne) {
  BandedMatrix matrix{3, 1, 1};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = row > 0 ? row - 1 : 0; column < std::min<std::size_t>(3, row + 2);
         ++column)
      matrix.add(row, column, row == 1 ? 0.0 : 1.0);
  std::vector<double> b{1.0, 1.0, 1.0};
  EXPECT_FALSE(matrix.solve(b));
}

}  // namespace
}  // namespace pitwall::raceline
