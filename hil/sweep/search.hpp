// Search for a point of a box at which the least of some margins is lowest.
//   in     number of parameters and of evaluations, seed; a function that evaluates a batch of
//          points
//   out    every point with its margins, in the order of evaluation; ends with the batch in which a
//          margin is first below 0
//   law    first the box is filled evenly (Latin hypercube), two fifths of the evaluations; then
//          each batch looks about the best points, with steps from 0.2 down to 0.0125 of the box,
//          and anywhere. Margins of different units are compared by how far each of them varies
//   units  points: 0 to 1 along each parameter
//   law    the same seed and margins give the same points, however batches are evaluated
//   source Latin hypercube: McKay et al., Technometrics 21(2), 1979. About the best: an evolution
//          strategy (H.-G. Beyer, H.-P. Schwefel, Natural Computing 1, 2002), with several steps at
//          once in place of one that adapts
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace pitwall::sweep {

using Point = std::vector<double>;

// Of one point, in an order that is the same for all; below 0: broken. One that is not finite is
// passed over.
using Margins = std::vector<double>;

struct Evaluated {
  Point at;
  Margins margins;
};

struct SearchPlan {
  std::size_t parameters = 0, evaluations = 200;
  std::uint64_t seed = 0;
};

inline constexpr std::size_t kBatch = 10;

using Evaluate = std::function<std::vector<Margins>(std::span<const Point>)>;

std::vector<Evaluated> search(const SearchPlan& plan, const Evaluate& evaluate);

}  // namespace pitwall::sweep
