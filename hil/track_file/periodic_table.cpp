// SPDX-License-Identifier: Apache-2.0
#include "hil/track_file/periodic_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::track_file {

PeriodicTable::PeriodicTable(double period_m, std::vector<Entry> entries)
    : period_m_(period_m), entries_(std::move(entries)) {
  CHECK(period_m_ > 0.0 && !entries_.empty());
  for (Entry& e : entries_) e.s_m = wrap(e.s_m);
  std::ranges::stable_sort(entries_, {}, &Entry::s_m);
}

double PeriodicTable::wrap(double s_m) const {
  const double wrapped_m = s_m - period_m_ * std::floor(s_m / period_m_);
  return wrapped_m < period_m_ ? wrapped_m : 0.0;
}

double PeriodicTable::at(double s_m) const {
  const double at_m = wrap(s_m);
  const auto next = std::ranges::upper_bound(entries_, at_m, {}, &Entry::s_m);
  const Entry& b = next == entries_.end() ? entries_.front() : *next;
  const Entry& a = next == entries_.begin() ? entries_.back() : *std::prev(next);
  const double from_m = next == entries_.begin() ? a.s_m - period_m_ : a.s_m;
  const double to_m = next == entries_.end() ? b.s_m + period_m_ : b.s_m;
  if (to_m <= from_m) return a.value;
  return a.value + (b.value - a.value) * (at_m - from_m) / (to_m - from_m);
}

double PeriodicTable::mean(double from_m, double to_m) const {
  constexpr int kSamples = 16;  // midpoints: a stretch is a few metres, the entries are dense
  double sum = 0.0;
  for (int i = 0; i < kSamples; ++i) sum += at(from_m + (to_m - from_m) * (i + 0.5) / kSamples);
  return sum / kSamples;
}

double PeriodicTable::least_near(double s_m, double reach_m) const {
  double least = at(s_m);
  const auto first = std::ranges::lower_bound(entries_, wrap(s_m - reach_m), {}, &Entry::s_m);
  auto i = static_cast<std::size_t>(first - entries_.begin());
  for (std::size_t seen = 0; seen < count(); ++seen, ++i) {
    const Entry& e = entries_[i % count()];
    if (std::abs(std::remainder(e.s_m - s_m, period_m_)) > reach_m) break;
    const Entry& before = entries_[(i + count() - 1) % count()];
    const Entry& after = entries_[(i + 1) % count()];
    if (e.value <= before.value && e.value <= after.value) least = std::min(least, e.value);
  }
  return least;
}

}  // namespace pitwall::track_file
