// Quantiles by nearest rank: the smallest sample such that at least this share of all samples is
// not larger.
//   in     0 < share <= 1; samples in ascending order, or counts in cells of equal width
//   source Hyndman and Fan, "Sample Quantiles in Statistical Packages" (1996), definition 1
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pitwall {

// Index of the quantile among `count` sorted samples, count >= 1.
inline std::size_t nearest_rank(double share, std::size_t count) {
  const double rank = std::ceil(share * static_cast<double>(count));
  return static_cast<std::size_t>(std::clamp(rank, 1.0, static_cast<double>(count))) - 1;
}

// Histogram with `cells` cells of width 1: add() allocates nothing. Values below 0 count in the
// first cell, values beyond the last cell in the last one.
class Histogram {
 public:
  explicit Histogram(std::size_t cells) : cells_(cells) {}

  void add(double value) {
    const double last = static_cast<double>(cells_.size() - 1);
    ++cells_[value > 0.0 ? static_cast<std::size_t>(std::min(value, last)) : 0];
    ++count_;
  }
  void reset() { *this = Histogram(cells_.size()); }
  std::uint64_t count() const { return count_; }

  // Upper edge of the cell with the quantile; 0 without samples.
  double quantile(double share) const {
    if (count_ == 0) return 0.0;
    const std::uint64_t wanted = nearest_rank(share, count_) + 1;
    std::uint64_t seen = 0;
    std::size_t cell = 0;
    while (cell + 1 < cells_.size() && (seen += cells_[cell]) < wanted) ++cell;
    return static_cast<double>(cell + 1);
  }

 private:
  std::vector<std::uint32_t> cells_;
  std::uint64_t count_ = 0;
};

}  // namespace pitwall
