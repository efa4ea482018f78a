// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/laps/lap_log.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pitwall::state {
namespace {

using telemetry::field;
using telemetry::FieldIndex;

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

struct Source {
  LapColumn column;
  FieldIndex field;
};
constexpr std::array<Source, kLapColumns - 1> kSources{
    {{LapColumn::kSpeed, field("ego.vx")},
     {LapColumn::kCrossTrack, field("dynamics.lateral_error")},
     {LapColumn::kThrottle, field("feedback.throttle")},
     {LapColumn::kBrake, field("feedback.brake_front")}}};

}  // namespace

LapLog::LapLog(double length_m)
    : length_m_(length_m),
      step_m_(std::max(kStep_m, length_m / static_cast<double>(kMostPoints))),
      points_(static_cast<std::size_t>(std::ceil(length_m / step_m_ - 1e-9))),
      progress_(length_m) {}

void LapLog::note(const telemetry::Snapshot& state, telemetry::GroupSet groups) {
  constexpr telemetry::Group kTrack = telemetry::Group::kTrack;
  bool news = false;
  for (const auto& [column, index] : kSources) {
    const telemetry::Group group = telemetry::kFields[index].group;
    if (!groups.has(group) || !state.ever(group)) continue;
    samples_[index_of(column)].note(state.at(group), state.values[index]);
    news = true;
  }
  if (groups.has(kTrack) && state.ever(kTrack)) {
    follow(progress_.take(state.at(kTrack), state.values[field("track.station")]));
    count_lap(state.values[field("track.lap")]);
    news = true;
  }
  if (!news) return;
  for (const auto& [column, index] : kSources) settle(column);
}

// The count comes later than the line.
void LapLog::count_lap(double number) {
  if (laps_.empty() || !std::isfinite(number) || laps_.back().number == number) return;
  laps_.back().number = number;
  ++revision_;
}

void LapLog::follow(const LapMove& move) {
  switch (move.kind) {
    case LapMove::Kind::kNone:
      return;
    case LapMove::Kind::kBegins:
      if (!laps_.empty() && laps_.back().running) end_lap(laps_.back().end, false);
      return begin_lap(move.to, move.to_m, false);
    case LapMove::Kind::kUnseen:
      laps_.back().gap = std::max(laps_.back().gap, move.to - move.from);
      break;
    case LapMove::Kind::kSeen:
      fill_time(move);
      break;
  }
  laps_.back().end = move.to;
  furthest_m_ = std::max(furthest_m_, move.to_m);
  if (move.to_m >= length_m_) return cross_line(move);
  decided_ =
      std::clamp(static_cast<std::size_t>(std::floor(std::max(furthest_m_, 0.0) / step_m_)) + 1,
                 decided_, points_);
}

void LapLog::begin_lap(Instant at, double way_m, bool seen) {
  Lap lap{.id = next_id_++, .begin = at, .end = at, .start_seen = seen};
  for (std::vector<float>& column : lap.columns) column.assign(points_, kUnknown);
  laps_.push_back(std::move(lap));
  from_m_ = furthest_m_ = way_m;
  decided_ = 0;
  ++revision_;
  if (laps_.size() <= kMostLaps) return;
  laps_.erase(laps_.begin() + (best() == &laps_.front() ? 1 : 0));
}

void LapLog::end_lap(Instant at, bool seen) {
  Lap& lap = laps_.back();
  lap.end = at;
  lap.finish_seen = seen;
  lap.running = false;
  ++revision_;
  if (!lap.complete() && furthest_m_ - from_m_ < kLeast_m) laps_.pop_back();
}

void LapLog::cross_line(const LapMove& move) {
  const bool seen = move.kind == LapMove::Kind::kSeen;
  const double share = (length_m_ - move.from_m) / (move.to_m - move.from_m);
  const Instant at =
      seen ? move.from + from_seconds(share * (move.to - move.from).seconds()) : move.to;
  end_lap(seen ? at : move.from, seen);
  progress_.cross_line();
  begin_lap(at, seen ? 0.0 : move.to_m - length_m_, seen);
  if (seen) {
    fill_time({.kind = move.kind,
               .from_m = 0.0,
               .to_m = move.to_m - length_m_,
               .from = at,
               .to = move.to});
  }
  laps_.back().end = move.to;
  furthest_m_ = move.to_m - length_m_;
  decided_ = std::min(static_cast<std::size_t>(std::floor(furthest_m_ / step_m_)) + 1, points_);
}

// Of the points that the car reaches first in this move.
void LapLog::fill_time(const LapMove& move) {
  Lap& lap = laps_.back();
  std::vector<float>& time = lap.column(LapColumn::kTime);
  const double way_m = move.to_m - move.from_m;
  if (way_m < 0.0) return;
  const double first_m = std::max({furthest_m_, move.from_m, 0.0});
  for (auto i = static_cast<std::size_t>(std::ceil(first_m / step_m_)); i < points_; ++i) {
    const double at_m = static_cast<double>(i) * step_m_;
    if (at_m > move.to_m) break;
    if (!std::isnan(time[i])) continue;  // the end of the move before
    const double share = way_m > 0.0 ? (at_m - move.from_m) / way_m : 0.0;
    time[i] = static_cast<float>((move.from - lap.begin).seconds() +
                                 share * (move.to - move.from).seconds());
  }
}

// Gives each point whose time is known the value at that time, as soon as the next sample has come.
void LapLog::settle(LapColumn column) {
  Cursor& cursor = cursors_[index_of(column)];
  while (true) {
    const auto lap = std::ranges::lower_bound(laps_, cursor.lap, {}, &Lap::id);
    if (lap == laps_.end()) return;
    if (lap->id != cursor.lap) cursor = {lap->id, 0};
    const std::size_t end = lap->running ? decided_ : points_;
    for (; cursor.point < end; ++cursor.point) {
      const float time_s = lap->column(LapColumn::kTime)[cursor.point];
      if (std::isnan(time_s)) continue;
      const auto value = samples_[index_of(column)].value_at(
          lap->begin + from_seconds(static_cast<double>(time_s)), LapProgress::kGap);
      if (!value) return;
      lap->column(column)[cursor.point] = *value;
    }
    if (lap->running) return;
    cursor = {lap->id + 1, 0};
  }
}

const Lap* LapLog::find(std::uint32_t id) const {
  const auto lap = std::ranges::lower_bound(laps_, id, {}, &Lap::id);
  return lap != laps_.end() && lap->id == id ? &*lap : nullptr;
}

const Lap* LapLog::best() const {
  const Lap* best = nullptr;
  for (const Lap& lap : laps_) {
    if (lap.complete() && (best == nullptr || lap.time_s() < best->time_s())) best = &lap;
  }
  return best;
}

}  // namespace pitwall::state
