// Square band matrix and the solution of its linear system.
//   in     order, number of diagonals below and above the main one; elements inside of the band
//   out    x of A x = b
//   errors solve(): false where the matrix is singular to working precision
//   cost   O(order * lower * (lower + upper)); rows are exchanged (partial pivoting)
//   source Golub and Van Loan, Matrix Computations, 4th ed., 4.3.5
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace pitwall::raceline {

// Place of element i of a closed row of n in a folded order, 0, n-1, 1, n-2, ...: the last element
// lies beside the first, and elements k apart in the row are at most 2k apart in the order.
inline std::size_t folded(std::size_t i, std::size_t n) {
  return 2 * i < n ? 2 * i : 2 * (n - i) - 1;
}

class BandedMatrix {
 public:
  BandedMatrix(std::size_t order, std::size_t lower, std::size_t upper);

  void add(std::size_t row, std::size_t column, double value);  // inside of the band
  // Replaces b by x. The matrix is used up.
  bool solve(std::vector<double>& b);

 private:
  double& at(std::size_t row, std::size_t column) {
    return elements_[row * width_ + (column + lower_ - row)];
  }

  std::size_t order_, lower_, upper_, width_;
  std::vector<double> elements_;  // row by row, with room for what the exchange of rows fills in
};

}  // namespace pitwall::raceline
