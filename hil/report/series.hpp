// Data series of a plot: thinned points that look the same, spans of equal value, bus load,
// intervals between frames.
//   in     rows of RunData, sorted by time
//   invariants
//          thinned() keeps the smallest and the largest value of every bucket, and every gap, so
//          that no peak is lost; at most 4 points per bucket
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

// Line with one value per row. A row more than 0.1 s after the one before makes a gap.
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

// Time span in which a value stays the same.
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

// Share of bus time that frames occupy, per window, at the middle of the window. All windows have
// the same width, at least `least_window_s`; there are at most 1200.
Line bus_load(std::span<const At<BusFrame>> frames, double end_s, double least_window_s);

// Intervals between the frames of one identifier from one node.
struct Intervals {
  std::uint8_t from = 0;
  std::uint32_t id = 0;
  std::uint64_t frames = 0;
  double nominal_s = kUnset;     // period in the database; NaN if it has no such message
  std::string name;              // name in the database; empty if it has no such message
  std::vector<double> sorted_s;  // between two frames, ascending

  double quantile_s(double share) const;  // NaN with fewer than two frames
};

// By node and identifier. Names and periods come from the database of this build.
std::vector<Intervals> intervals_of(std::span<const At<BusFrame>> frames);

// Number of `values` (ascending) in each of `bins` equal parts of [from, to]. Values outside count
// in the first or the last part.
std::vector<std::uint64_t> histogram(std::span<const double> values, double from, double to,
                                     std::size_t bins);

}  // namespace pitwall::report
