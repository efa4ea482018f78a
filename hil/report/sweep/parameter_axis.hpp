// Parameter of a sweep as an axis: its values in bins, and as numbers where they are.
//   in     parameter of the plan; values as the cases have them
//   out    bins: kBins equal parts of a range; the values of a list, or kBins groups of
//          neighbours of a longer one
//   law    every value of the parameter is in exactly one bin
//   errors bin_of(): the last bin for a value that is not of the parameter
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "hil/sweep/plan.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::report {

inline constexpr std::size_t kBins = 8;

class ParameterAxis {
 public:
  explicit ParameterAxis(const sweep::Parameter& parameter);

  const std::string& path() const { return path_; }
  const std::vector<std::string>& bins() const { return bins_; }  // their names
  std::size_t bin_of(const std::string& value) const;
  bool varies() const { return bins_.size() > 1; }
  // Range or list of numbers, of which two at least differ.
  bool is_numeric() const { return from_ < to_; }
  double from() const { return from_; }
  double to() const { return to_; }

 private:
  void take_range(double from, double to);
  void take_list(const std::vector<std::string>& values);

  std::string path_;
  std::vector<std::string> bins_;
  std::map<std::string, std::size_t> bin_of_value_;  // of a list
  double from_ = kUnset, to_ = kUnset;
};

// NaN for what is no number.
double number_of(std::string_view value);

}  // namespace pitwall::report
