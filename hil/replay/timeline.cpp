// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/timeline.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pitwall::replay {
namespace {

constexpr double kMinSpeed = 1e-3, kMaxSpeed = 1e6;
constexpr Duration kMaxPass = seconds(366LL * 24 * 3'600);

std::string target_of(const std::string& channel, const TimelineOptions& options) {
  for (const auto& [recorded, interface] : options.map)
    if (recorded == channel) return interface;
  return options.interface.empty() ? channel : options.interface;
}

std::size_t track_of(std::vector<BusTrack>& buses, const std::string& interface) {
  for (std::size_t i = 0; i < buses.size(); ++i)
    if (buses[i].interface == interface) return i;
  buses.push_back({.interface = interface, .frames = {}, .fd_flags = {}, .due = {}});
  return buses.size() - 1;
}

Duration scaled(Duration d, double speed) {
  return {std::llround(static_cast<double>(d.ns) / speed)};
}

// Time of the log without what is left out: never runs back, and not through a gap that is skipped.
struct LogClock {
  UtcTime latest;
  Duration elapsed{};

  Duration at(UtcTime stamp, Duration longest_gap) {
    const Duration gap{std::max<std::int64_t>(stamp.ns - latest.ns, 0)};
    latest = std::max(latest, stamp);
    if (gap <= longest_gap) elapsed = elapsed + gap;
    return elapsed;
  }
};

bool is_wanted(const LoggedFrame& logged, const TimelineOptions& options) {
  const auto& ids = options.ids;
  return ids.empty() || std::find(ids.begin(), ids.end(), logged.frame.id) != ids.end();
}

std::optional<Problem> problem_of(const CanLog& log, const TimelineOptions& options) {
  if (!(options.speed >= kMinSpeed && options.speed <= kMaxSpeed))
    return Problem{"speed", "must be from 0.001 to 1000000"};
  if (log.frames.empty()) return Problem{"log", "holds no frames"};
  if (options.start < Duration{} || options.start > kMaxPass)
    return Problem{"start", "must be from 0 to a year"};
  for (const auto& [recorded, interface] : options.map)
    if (std::find(log.channels.begin(), log.channels.end(), recorded) == log.channels.end())
      return Problem{recorded, "is mapped, but does not occur in the log"};
  return std::nullopt;
}

}  // namespace

Result<Timeline, Problem> make_timeline(const CanLog& log, const TimelineOptions& options) {
  if (const auto problem = problem_of(log, options)) return Unexpected{*problem};
  Timeline out;
  std::vector<std::size_t> track;
  for (const std::string& channel : log.channels)
    track.push_back(track_of(out.buses, target_of(channel, options)));
  const UtcTime begin{log.frames.front().at.ns + options.start.ns};
  LogClock clock{.latest = begin};
  Duration first{}, latest{};
  for (const LoggedFrame& logged : log.frames) {
    if (logged.at < begin && out.frames == 0) continue;
    if (!is_wanted(logged, options)) continue;
    latest = clock.at(logged.at, options.longest_gap);
    if (out.frames == 0) first = latest;
    if ((latest - first).seconds() / options.speed > kMaxPass.seconds())
      return Unexpected{Problem{"log", "takes more than a year to play (skip its gaps?)"}};
    BusTrack& bus = out.buses[track[logged.channel]];
    bus.frames.push_back(logged.frame);
    bus.fd_flags.push_back(logged.fd_flags);
    bus.due.push_back(scaled(latest - first, options.speed));
    ++out.frames;
  }
  if (out.frames == 0) return Unexpected{Problem{"log", "nothing is left of it to play"}};
  std::erase_if(out.buses, [](const BusTrack& bus) { return bus.frames.empty(); });
  const auto gaps = static_cast<std::int64_t>(std::max<std::uint64_t>(out.frames - 1, 1));
  const Duration span = scaled(latest - first, options.speed);
  out.pass = span + span / gaps;
  return out;
}

}  // namespace pitwall::replay
