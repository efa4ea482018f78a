// Place of a station among rising knots of a closed lap.
//   in     knots with a member s_m, rising, within [0, length); at least one
//   out    the knot before and the one after, and the share of the way between them
//   cost   O(log n)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pitwall::traffic {

template <class Knot>
struct Between {
  const Knot& before;
  const Knot& after;
  double way_m, share;  // from one to the other; [0, 1)
};

template <class Knot>
Between<Knot> between(const std::vector<Knot>& knots, double s_m, double length_m) {
  const auto after = std::upper_bound(knots.begin(), knots.end(), s_m,
                                      [](double s, const Knot& knot) { return s < knot.s_m; });
  const Knot& a = after == knots.begin() ? knots.back() : *(after - 1);
  const Knot& b = after == knots.end() ? knots.front() : *after;
  const double way_m = b.s_m > a.s_m ? b.s_m - a.s_m : b.s_m - a.s_m + length_m;
  const double from_m = s_m >= a.s_m ? s_m - a.s_m : s_m - a.s_m + length_m;
  return {a, b, way_m, from_m / way_m};
}

}  // namespace pitwall::traffic
