// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/network/peaks.hpp"

namespace pitwall::perception {
namespace {

bool is_peak(const OutputPlanes& out, const Cell& cell) {
  const float here = out.at(0, cell.row, cell.column);
  for (std::size_t r = cell.row - std::min<std::size_t>(cell.row, 1);
       r < std::min(cell.row + 2, out.rows); ++r)
    for (std::size_t c = cell.column - std::min<std::size_t>(cell.column, 1);
         c < std::min(cell.column + 2, out.columns); ++c) {
      const float other = out.at(0, r, c);
      const bool is_before = r * out.columns + c < cell.row * out.columns + cell.column;
      if (other > here || (other == here && is_before)) return false;
    }
  return true;
}

}  // namespace

std::vector<Cell> peaks_of(const OutputPlanes& out, double confidence_least) {
  const double logit_least = std::log(confidence_least / (1.0 - confidence_least));
  std::vector<Cell> peaks;
  for (std::size_t row = 0; row < out.rows; ++row)
    for (std::size_t column = 0; column < out.columns; ++column) {
      const double logit = out.at(0, row, column);
      if (logit >= logit_least && is_peak(out, {row, column})) peaks.push_back({row, column});
    }
  return peaks;
}

}  // namespace pitwall::perception
