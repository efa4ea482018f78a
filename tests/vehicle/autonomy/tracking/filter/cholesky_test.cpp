// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/cholesky.hpp"

#include <gtest/gtest.h>

#include <random>

namespace pitwall::tracking {
namespace {

constexpr std::size_t kSize = 4;
using Matrix = std::array<std::array<double, kSize>, kSize>;

// [-1, 1)
double unit(std::mt19937& dice) { return static_cast<double>(dice()) / 2'147'483'648.0 - 1.0; }

// A A' + 1 of a random A: symmetric and positive definite.
Matrix definite(std::mt19937& dice) {
  Matrix a{}, s{};
  for (auto& row : a)
    for (double& value : row) value = unit(dice);
  for (std::size_t i = 0; i < kSize; ++i)
    for (std::size_t j = 0; j < kSize; ++j) {
      s[i][j] = i == j ? 1.0 : 0.0;
      for (std::size_t k = 0; k < kSize; ++k) s[i][j] += a[i][k] * a[j][k];
    }
  return s;
}

TEST(Cholesky, TheFactorTimesItselfIsTheMatrixAndSolvesWhatItWasMadeOf) {
  std::mt19937 dice{3};
  for (int round = 0; round < 200; ++round) {
    const std::size_t size = 1 + static_cast<std::size_t>(round) % kSize;
    const Matrix s = definite(dice);
    const Matrix l = factor<kSize>(size, [&](std::size_t i, std::size_t j) { return s[i][j]; });
    std::array<double, kSize> b{};
    for (double& value : b) value = unit(dice);
    const auto y = solved(l, size, b);
    for (std::size_t i = 0; i < size; ++i) {
      double of_y = 0.0;
      for (std::size_t k = 0; k < size; ++k) of_y += l[i][k] * y[k];
      EXPECT_NEAR(of_y, b[i], 1e-14);
      for (std::size_t j = 0; j < size; ++j) {
        double product = 0.0;
        for (std::size_t k = 0; k < size; ++k) product += l[i][k] * l[j][k];
        EXPECT_NEAR(product, s[i][j], 1e-14);
        EXPECT_TRUE(j <= i || l[i][j] == 0.0);
      }
    }
  }
}

}  // namespace
}  // namespace pitwall::tracking
