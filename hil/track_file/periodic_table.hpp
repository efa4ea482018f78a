// Periodic lookup table of a quantity along a lap: values at stations, linear interpolation.
//   in     pairs in any order; stations outside of the lap are wrapped into it
//   out    at(): the value at any station; mean(): the mean over an interval
//   cost   at() O(log n)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::track_file {

class PeriodicTable {
 public:
  struct Entry {
    double s_m = kUnset, value = kUnset;
  };

  PeriodicTable(double period_m, std::vector<Entry> entries);  // at least one

  double at(double s_m) const;
  double mean(double from_m, double to_m) const;
  // The smallest of at(s) and of the local minima among the entries within `reach_m` of it, so that
  // a narrow place between two knots is not lost.
  double least_near(double s_m, double reach_m) const;

 private:
  double wrap(double s_m) const;
  std::size_t count() const { return entries_.size(); }

  double period_m_;
  std::vector<Entry> entries_;
};

}  // namespace pitwall::track_file
