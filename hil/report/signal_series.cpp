// SPDX-License-Identifier: Apache-2.0
#include "hil/report/signal_series.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "protocol/can/decode.hpp"

namespace pitwall::report {
namespace {

void add_frame(SignalSeries& series, double t_s, const can::Frame& frame) {
  const auto& [message, signal] = series.chosen;
  if (!can::is_frame_of(*message, frame)) {
    ++series.other_frames;
    return;
  }
  if (!can::is_present(*message, *signal, frame)) {
    ++series.absent;
    return;
  }
  const double value = can::decode(*signal, frame);
  const bool is_drawn = std::abs(value) <= kMaxDrawn;  // false for NaN
  ++(is_drawn ? series.values : series.not_drawn);
  series.points.push_back({t_s, is_drawn ? value : kUnset});
}

// Sorted, with a gap in each pause that is too long.
Line with_gaps(Line points) {
  std::stable_sort(points.begin(), points.end(),
                   [](const Point& a, const Point& b) { return a.x < b.x; });
  if (points.size() < 2) return points;
  const double mean_s =
      (points.back().x - points.front().x) / static_cast<double>(points.size() - 1);
  Line out;
  out.reserve(points.size());
  for (const Point& point : points) {
    if (!out.empty() && point.x - out.back().x > kGapPeriods * mean_s)
      out.push_back({point.x, kUnset});
    out.push_back(point);
  }
  return out;
}

std::vector<SignalSeries> by_channel(const replay::CanLog& log, const ChosenSignal& chosen,
                                     const LogPart& part, UtcTime begin) {
  std::map<std::uint8_t, SignalSeries> found;
  for (const replay::LoggedFrame& logged : log.frames) {
    const can::Frame& frame = logged.frame;
    if (frame.id != chosen.message->id || frame.extended != chosen.message->extended) continue;
    const double t_s = Duration{logged.at.ns - begin.ns}.seconds();
    if (t_s < part.from_s || t_s > part.to_s) continue;
    const std::string& channel = log.channels[logged.channel];
    if (!part.channel.empty() && channel != part.channel) continue;
    SignalSeries& series = found[logged.channel];
    series.chosen = chosen;
    series.channel = channel;
    add_frame(series, t_s, frame);
  }
  std::vector<SignalSeries> out;
  for (auto& [channel, series] : found) out.push_back(std::move(series));
  if (out.empty()) out.emplace_back().chosen = chosen;
  if (out.size() == 1) out.front().channel.clear();
  return out;
}

}  // namespace

LogSpan span_of(const replay::CanLog& log) {
  if (log.frames.empty()) return {};
  const auto [first, last] =
      std::ranges::minmax_element(log.frames, {}, [](const auto& logged) { return logged.at.ns; });
  return {first->at, Duration{last->at.ns - first->at.ns}.seconds()};
}

std::vector<SignalSeries> signal_series(const replay::CanLog& log,
                                        std::span<const ChosenSignal> chosen, const LogPart& part) {
  const UtcTime begin = span_of(log).begin;
  std::vector<SignalSeries> out;
  for (const ChosenSignal& one : chosen)
    for (SignalSeries& series : by_channel(log, one, part, begin)) {
      series.points = with_gaps(std::move(series.points));
      out.push_back(std::move(series));
    }
  return out;
}

}  // namespace pitwall::report
