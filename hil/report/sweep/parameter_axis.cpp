// SPDX-License-Identifier: Apache-2.0
#include "hil/report/sweep/parameter_axis.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "hil/report/text.hpp"

namespace pitwall::report {

double number_of(std::string_view value) {
  double number = kUnset;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  const bool is_whole = error == std::errc{} && end == value.data() + value.size();
  return is_whole && std::isfinite(number) ? number : kUnset;
}

ParameterAxis::ParameterAxis(const sweep::Parameter& parameter) : path_(parameter.path) {
  if (parameter.values.empty())
    take_range(parameter.from, parameter.to);
  else
    take_list(parameter.values);
}

void ParameterAxis::take_range(double from, double to) {
  constexpr int kDigits = 3;
  from_ = from, to_ = to;
  const double width = (to - from) / static_cast<double>(kBins);
  for (std::size_t i = 0; i < kBins; ++i) {
    const double begin = from + width * static_cast<double>(i);
    bins_.push_back(significant(begin, kDigits) + " to " + significant(begin + width, kDigits));
  }
}

void ParameterAxis::take_list(const std::vector<std::string>& values) {
  const std::size_t count = std::min(kBins, values.size());
  for (std::size_t bin = 0; bin < count; ++bin) {
    const std::size_t begin = bin * values.size() / count, end = (bin + 1) * values.size() / count;
    for (std::size_t i = begin; i < end; ++i) bin_of_value_.try_emplace(values[i], bin);
    bins_.push_back(end - begin == 1 ? values[begin] : values[begin] + " to " + values[end - 1]);
  }
  double least = HUGE_VAL, greatest = -HUGE_VAL;
  for (const std::string& value : values) {
    const double number = number_of(value);
    if (!std::isfinite(number)) return;
    least = std::min(least, number), greatest = std::max(greatest, number);
  }
  from_ = least, to_ = greatest;
}

std::size_t ParameterAxis::bin_of(const std::string& value) const {
  if (const auto found = bin_of_value_.find(value); found != bin_of_value_.end())
    return found->second;
  const double share = (number_of(value) - from_) / (to_ - from_);
  const double last = static_cast<double>(bins_.size() - 1);
  const double bin = std::floor(share * static_cast<double>(bins_.size()));
  return static_cast<std::size_t>(std::isfinite(bin) ? std::clamp(bin, 0.0, last) : last);
}

}  // namespace pitwall::report
