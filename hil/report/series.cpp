// SPDX-License-Identifier: Apache-2.0
#include "hil/report/series.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "protocol/can/av21.hpp"
#include "protocol/vocabulary/quantile.hpp"

namespace pitwall::report {
namespace {

// First, least, greatest and last point of one bucket, in the order of the line.
class Bucket {
 public:
  void add(std::size_t i, double y, std::span<const Point> points) {
    if (empty()) first_ = least_ = greatest_ = i;
    last_ = i;
    if (y < points[least_].y) least_ = i;
    if (y > points[greatest_].y) greatest_ = i;
  }
  bool empty() const { return last_ == kNone; }

  void move_to(Line& out, std::span<const Point> points) {
    if (empty()) return;
    std::array picks{first_, least_, greatest_, last_};
    std::ranges::sort(picks);
    const auto end = std::unique(picks.begin(), picks.end());
    for (auto i = picks.begin(); i != end; ++i) out.push_back(points[*i]);
    last_ = kNone;
  }

 private:
  static constexpr std::size_t kNone = SIZE_MAX;
  std::size_t first_ = 0, least_ = 0, greatest_ = 0, last_ = kNone;
};

const can::MessageRow* row_of(std::uint32_t id) {
  const auto row = std::ranges::find(can::av21::kMessages, id, &can::MessageRow::id);
  return row != can::av21::kMessages.end() ? &*row : nullptr;
}

}  // namespace

Line thinned(std::span<const Point> points, double from, double to, std::size_t buckets) {
  Line out;
  Bucket bucket;
  double filling = -1.0;
  const double per_x = static_cast<double>(buckets) / (to - from);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [x, y] = points[i];
    const double place = std::floor((x - from) * per_x);
    const bool gap = !std::isfinite(y);
    if (place != filling || gap) bucket.move_to(out, points);
    filling = place;
    if (gap) {
      if (!out.empty() && std::isfinite(out.back().y)) out.push_back({x, kUnset});
    } else {
      bucket.add(i, y, points);
    }
  }
  bucket.move_to(out, points);
  return out;
}

Line bus_load(std::span<const At<BusFrame>> frames, double end_s, double least_window_s) {
  constexpr double kWindowsMax = 1200.0;
  if (frames.empty()) return {};
  const double windows = std::clamp(std::floor(end_s / least_window_s), 1.0, kWindowsMax);
  const double window_s = end_s / windows;
  std::vector<double> bits(static_cast<std::size_t>(windows));
  for (const At<BusFrame>& frame : frames) {
    const double place = std::clamp(std::floor(frame.t_s / window_s), 0.0, windows - 1.0);
    bits[static_cast<std::size_t>(place)] += frame.v.bits;
  }
  Line line;
  for (std::size_t i = 0; i < bits.size(); ++i)
    line.push_back({(static_cast<double>(i) + 0.5) * window_s, bits[i] / (kBitRate * window_s)});
  return line;
}

double Intervals::quantile_s(double share) const {
  if (sorted_s.empty()) return kUnset;
  return sorted_s[nearest_rank(share, sorted_s.size())];
}

std::vector<Intervals> intervals_of(std::span<const At<BusFrame>> frames) {
  struct Running {
    Intervals intervals;
    double last_s = kUnset;
  };
  std::map<std::pair<std::uint8_t, std::uint32_t>, Running> by_sender;
  for (const At<BusFrame>& frame : frames) {
    Running& running = by_sender[{frame.v.from, frame.v.id}];
    ++running.intervals.frames;
    if (std::isfinite(running.last_s))
      running.intervals.sorted_s.push_back(frame.t_s - running.last_s);
    running.last_s = frame.t_s;
  }
  std::vector<Intervals> all;
  for (auto& [sender, running] : by_sender) {
    Intervals& intervals = all.emplace_back(std::move(running.intervals));
    std::tie(intervals.from, intervals.id) = sender;
    std::ranges::sort(intervals.sorted_s);
    if (const can::MessageRow* row = row_of(intervals.id)) {
      intervals.name = row->name;
      if (row->period > Duration{}) intervals.nominal_s = row->period.seconds();
    }
  }
  return all;
}

std::vector<std::uint64_t> histogram(std::span<const double> values, double from, double to,
                                     std::size_t bins) {
  std::vector<std::uint64_t> counts(bins);
  const double last = static_cast<double>(bins - 1);
  for (const double value : values) {
    const double place = (value - from) / (to - from) * static_cast<double>(bins);
    ++counts[static_cast<std::size_t>(std::clamp(std::floor(place), 0.0, last))];
  }
  return counts;
}

}  // namespace pitwall::report
