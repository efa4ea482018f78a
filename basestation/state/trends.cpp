// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/trends.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pitwall::state {
namespace {

constexpr float kNoValue = std::numeric_limits<float>::quiet_NaN();

double seconds_of(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

// Of a span: what was smallest and largest in it, in the order of time.
struct Extremes {
  TrendPoint smallest, largest;
  bool any = false;

  void take(const TrendPoint& point) {
    if (!any || point.value < smallest.value) smallest = point;
    if (!any || point.value > largest.value) largest = point;
    any = true;
  }
  void give(std::vector<TrendPoint>& out) {
    if (any) {
      const bool rises = smallest.time_s <= largest.time_s;
      out.push_back(rises ? smallest : largest);
      if (smallest.time_s != largest.time_s) out.push_back(rises ? largest : smallest);
    }
    any = false;
  }
};

// Where a gap ends a span, too, its point without a value is kept as the third of the span.
std::vector<TrendPoint> thinned(const std::vector<TrendPoint>& all, std::size_t points) {
  if (all.size() <= points || points < 3) {
    return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), points))};
  }
  const std::size_t spans = points / 3;
  const double begin = all.front().time_s;
  const double length = (all.back().time_s - begin) / static_cast<double>(spans);
  std::vector<TrendPoint> out;
  Extremes extremes;
  std::size_t span = 0;
  bool gap = false;
  for (const TrendPoint& point : all) {
    const auto at = static_cast<std::size_t>((point.time_s - begin) / length);
    if (const std::size_t now = std::min(at, spans - 1); now != span) {
      extremes.give(out);
      span = now;
      gap = false;
    }
    if (!std::isnan(point.value)) {
      extremes.take(point);
    } else if (!gap) {
      extremes.give(out);
      out.push_back(point);
      gap = true;
    }
  }
  extremes.give(out);
  if (out.size() > points) out.resize(points);
  return out;
}

}  // namespace

std::span<float> TrendTable::Ring::push(Instant at, std::size_t width, std::size_t rows) {
  std::size_t row = size();
  if (row < rows) {
    time_ns.push_back(at.ns);
    values.resize(values.size() + width, kNoValue);
  } else {
    row = head;
    time_ns[row] = at.ns;
    head = (head + 1) % rows;
  }
  return std::span{values}.subspan(row * width, width);
}

std::size_t TrendTable::Ring::first_not_before(std::int64_t ns) const {
  std::size_t low = 0, high = size();
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (time_ns[place(middle)] < ns) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

bool TrendTable::note(Instant sampled, std::span<const double> values) {
  CHECK(values.size() == columns_);
  if (fine_.size() > 0 && fine_.time_ns[fine_.place(fine_.size() - 1)] >= sampled.ns) return false;
  const std::span<float> row = fine_.push(sampled, columns_, capacity_.fine_rows);
  std::ranges::transform(values, row.begin(), [](double v) { return static_cast<float>(v); });
  note_coarse(sampled, values);
  return true;
}

void TrendTable::note_coarse(Instant sampled, std::span<const double> values) {
  const std::size_t width = 2 * columns_;
  if (capacity_.whole && coarse_.size() == capacity_.spans) double_spans();
  const std::size_t last = coarse_.size() > 0 ? coarse_.place(coarse_.size() - 1) : 0;
  const bool same = coarse_.size() > 0 &&
                    sampled.ns / capacity_.span.ns == coarse_.time_ns[last] / capacity_.span.ns;
  std::span<float> row;
  if (same) {
    row = std::span{coarse_.values}.subspan(last * width, width);
  } else {
    row = coarse_.push(sampled, width, capacity_.spans);
    std::ranges::fill(row, kNoValue);
  }
  for (std::size_t i = 0; i < columns_; ++i) {
    const auto value = static_cast<float>(values[i]);
    row[2 * i] = std::fmin(row[2 * i], value);  // of a number and NaN it is the number
    row[2 * i + 1] = std::fmax(row[2 * i + 1], value);
  }
}

// Joins neighbours until half of the rows are free: the ring has not come round yet.
void TrendTable::double_spans() {
  const std::size_t width = 2 * columns_;
  while (2 * coarse_.size() > capacity_.spans) {
    capacity_.span = 2 * capacity_.span;
    std::size_t kept = 0;
    for (std::size_t row = 1; row < coarse_.size(); ++row) {
      const std::span<float> from = std::span{coarse_.values}.subspan(row * width, width);
      const bool same =
          coarse_.time_ns[row] / capacity_.span.ns == coarse_.time_ns[kept] / capacity_.span.ns;
      if (!same) coarse_.time_ns[++kept] = coarse_.time_ns[row];
      const std::span<float> to = std::span{coarse_.values}.subspan(kept * width, width);
      for (std::size_t i = 0; i < width; ++i) {
        const bool low = i % 2 == 0;
        to[i] = !same ? from[i] : low ? std::fmin(to[i], from[i]) : std::fmax(to[i], from[i]);
      }
    }
    coarse_.time_ns.resize(kept + 1);
    coarse_.values.resize((kept + 1) * width);
  }
}

std::vector<TrendTable::Sample> TrendTable::samples(std::size_t column, Instant from,
                                                    Instant to) const {
  std::vector<Sample> out;
  if (fine_.size() == 0 || to < from) return out;
  const std::int64_t fine_from = fine_.time_ns[fine_.place(0)];
  for (std::size_t i = coarse_.first_not_before(from.ns - capacity_.span.ns); i < coarse_.size();
       ++i) {
    const std::size_t row = coarse_.place(i);
    const std::int64_t at = coarse_.time_ns[row];
    if (at >= fine_from || at > to.ns) break;
    const float low = coarse_.values[row * 2 * columns_ + 2 * column];
    const float high = coarse_.values[row * 2 * columns_ + 2 * column + 1];
    if (at >= from.ns) out.push_back({at, low});
    const std::int64_t later = std::min(at + capacity_.span.ns / 2, fine_from - 1);
    if (high != low && later > at && later >= from.ns && later <= to.ns)
      out.push_back({later, high});
  }
  for (std::size_t i = fine_.first_not_before(from.ns); i < fine_.size(); ++i) {
    const std::size_t row = fine_.place(i);
    if (fine_.time_ns[row] > to.ns) break;
    out.push_back({fine_.time_ns[row], fine_.values[row * columns_ + column]});
  }
  return out;
}

std::vector<TrendPoint> TrendTable::range(std::size_t column, Instant from, Instant to,
                                          std::size_t points, Duration target_age) const {
  CHECK(column < columns_);
  const std::int64_t silence = std::max(stale_after(target_age).ns, 2 * capacity_.span.ns);
  std::vector<TrendPoint> all;
  for (const Sample& sample : samples(column, from, to)) {
    if (!all.empty() && seconds_of(sample.ns) - all.back().time_s > seconds_of(silence)) {
      all.push_back({.time_s = all.back().time_s + stale_after(target_age).seconds(),
                     .value = kNoValue,
                     .quality = Quality::kStale});
    }
    all.push_back({.time_s = seconds_of(sample.ns), .value = sample.value});
  }
  return thinned(all, points);
}

std::size_t TrendTable::filled_bytes() const {
  const auto of = [](const Ring& ring) {
    return ring.time_ns.size() * sizeof(std::int64_t) + ring.values.size() * sizeof(float);
  };
  return of(fine_) + of(coarse_);
}

Trends::Trends(const TrendCapacity& capacity) {
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
    groups_.emplace_back(telemetry::fields_of(row.group).count, capacity);
  }
}

void Trends::note(const telemetry::Snapshot& state, telemetry::GroupSet groups) {
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
    if (!groups.has(row.group) || !state.ever(row.group)) continue;
    const auto [first, count] = telemetry::fields_of(row.group);
    groups_[telemetry::index_of(row.group)].note(state.at(row.group),
                                                 std::span{state.values.at}.subspan(first, count));
  }
}

std::vector<TrendPoint> Trends::range(telemetry::FieldIndex field, Instant from, Instant to,
                                      std::size_t points) const {
  const telemetry::FieldRow& row = telemetry::kFields[field];
  return groups_[telemetry::index_of(row.group)].range(
      field - telemetry::fields_of(row.group).first, from, to, points, row.target_age());
}

std::size_t Trends::filled_bytes() const {
  std::size_t sum = 0;
  for (const TrendTable& table : groups_) sum += table.filled_bytes();
  return sum;
}

}  // namespace pitwall::state
