// Series of a plot: fewer points that look the same, spans of equal value, load of the bus,
// intervals between frames.
//   in     rows of RunData, sorted by time
//   invariants
//          thinned(): keeps the least and the greatest value of every bucket and every gap, so that
//          no peak is lost; at most 4 points for each bucket
//   units  seconds, shares of 1
//   cost   O(points)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "hil/report/run_data.hpp"

namespace pitwall::report {

struct Point {
  double x = 0.0, y = kUnset;  // y NaN: a gap of the line
};
using Line = std::vector<Point>;

Line thinned(std::span<const Point> points, double from, double to, std::size_t buckets);

// A line of one value per row; a row that is later than 0.1 s after the one before makes a gap.
template <class S, class Value>
Line line_of(const std::vector<At<S>>& rows, Value value) {
  constexpr double kGap_s = 0.1;
  Line line;
  line.reserve(rows.size());
  for (const At<S>& row : rows) {
    if (!line.empty() && row.t_s - line.back().x > kGap_s) line.push_back({row.t_s, kUnset});
    line.push_back({row.t_s, static_cast<double>(value(row.v))});
  }
  return line;
}

// While a number stays the same.
struct Span {
  double from_s = 0.0, to_s = 0.0;
  int value = 0;
};

template <class S, class Value>
std::vector<Span> spans_of(const std::vector<At<S>>& rows, Value value) {
  std::vector<Span> spans;
  for (const At<S>& row : rows) {
    const int now = static_cast<int>(value(row.v));
    if (!spans.empty()) spans.back().to_s = row.t_s;
    if (spans.empty() || spans.back().value != now) spans.push_back({row.t_s, row.t_s, now});
  }
  return spans;
}

inline constexpr double kBitRate = 500'000.0;

// Share of the bus's time that frames took, per window, at its middle. Windows are of one width,
// at least `least_window_s`, and at most 1200.
Line bus_load(std::span<const At<BusFrame>> frames, double end_s, double least_window_s);

// Of all frames with one identifier from one node.
struct Intervals {
  std::uint8_t from = 0;
  std::uint32_t id = 0;
  std::uint64_t frames = 0;
  double nominal_s = kUnset;     // of the database; NaN: it knows no such message
  std::string name;              // likewise empty
  std::vector<double> sorted_s;  // between two frames, ascending

  double quantile_s(double share) const;  // NaN where there are fewer than two frames
};

// By node and identifier. Names and periods are those of the database that this build has.
std::vector<Intervals> intervals_of(std::span<const At<BusFrame>> frames);

// How many of `values` (ascending) fall in each of `bins` equal parts of [from, to]; what lies
// outside counts for the first or the last one.
std::vector<std::uint64_t> histogram(std::span<const double> values, double from, double to,
                                     std::size_t bins);

}  // namespace pitwall::report
