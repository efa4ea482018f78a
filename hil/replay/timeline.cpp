// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/timeline.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::replay {
namespace {

constexpr double kMinSpeed = 1e-3, kMaxSpeed = 1e6;

std::string target_of(const std::string& channel, const TimelineOptions& options) {
  for (const auto& [recorded, interface] : options.map)
    if (recorded == channel) return interface;
  return options.interface.empty() ? channel : options.interface;
}

std::size_t track_of(std::vector<BusTrack>& buses, const std::string& interface) {
  for (std::size_t i = 0; i < buses.size(); ++i)
    if (buses[i].interface == interface) return i;
  buses.push_back({.interface = interface, .frames = {}, .due = {}});
  return buses.size() - 1;
}

Duration scaled(Duration d, double speed) {
  return {std::llround(static_cast<double>(d.ns) / speed)};
}

}  // namespace

Result<Timeline, Problem> make_timeline(const CandumpLog& log, const TimelineOptions& options) {
  if (!(options.speed >= kMinSpeed && options.speed <= kMaxSpeed))
    return Unexpected{Problem{"speed", "must be from 0.001 to 1000000"}};
  if (log.frames.empty()) return Unexpected{Problem{"log", "holds no frames"}};
  for (const auto& [recorded, interface] : options.map)
    if (std::find(log.channels.begin(), log.channels.end(), recorded) == log.channels.end())
      return Unexpected{Problem{recorded, "is mapped, but does not occur in the log"}};
  Timeline out;
  std::vector<std::size_t> track;
  for (const std::string& channel : log.channels)
    track.push_back(track_of(out.buses, target_of(channel, options)));
  const UtcTime start = log.frames.front().at;
  Duration latest{};
  for (const LoggedFrame& logged : log.frames) {
    latest = std::max(latest, Duration{logged.at.ns - start.ns});
    BusTrack& bus = out.buses[track[logged.channel]];
    bus.frames.push_back(logged.frame);
    bus.due.push_back(scaled(latest, options.speed));
  }
  out.frames = log.frames.size();
  const auto gaps = static_cast<std::int64_t>(std::max<std::uint64_t>(out.frames - 1, 1));
  out.pass = scaled(latest + latest / gaps, options.speed);
  return out;
}

}  // namespace pitwall::replay
