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

AroundPeak::AroundPeak(const OutputPlanes& out, const Cell& peak) : out_(out) {
  double sum = 0.0;
  for (std::size_t r = peak.row - std::min<std::size_t>(peak.row, 1);
       r < std::min(peak.row + 2, out.rows); ++r)
    for (std::size_t c = peak.column - std::min<std::size_t>(peak.column, 1);
         c < std::min(peak.column + 2, out.columns); ++c) {
      parts_.push_back({{r, c}, share_of_logit(static_cast<double>(out.at(0, r, c)))});
      sum += parts_.back().share;
    }
  for (Part& part : parts_) part.share /= sum;
}

double AroundPeak::mean(std::size_t plane) const {
  double sum = 0.0;
  for (const auto& [cell, share] : parts_)
    sum += share * static_cast<double>(out_.at(plane, cell.row, cell.column));
  return sum;
}

double AroundPeak::mean_row(std::size_t plane) const {
  double sum = mean(plane) + 0.5;
  for (const auto& [cell, share] : parts_) sum += share * static_cast<double>(cell.row);
  return sum;
}

double AroundPeak::mean_column(std::size_t plane) const {
  double sum = mean(plane) + 0.5;
  for (const auto& [cell, share] : parts_) sum += share * static_cast<double>(cell.column);
  return sum;
}

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
