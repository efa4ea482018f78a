// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/timeline_builder.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::replay {
namespace {

constexpr double kMinSpeed = 1e-3, kMaxSpeed = 1e6;
constexpr Duration kMaxPass = seconds(366LL * 24 * 3'600);

Duration scaled(Duration d, double speed) {
  return {std::llround(static_cast<double>(d.ns) / speed)};
}

}  // namespace

std::optional<Problem> TimelineBuilder::problem_of(const TimelineOptions& options) {
  if (!(options.speed >= kMinSpeed && options.speed <= kMaxSpeed))
    return Problem{"speed", "must be from 0.001 to 1000000"};
  if (options.start < Duration{} || options.start > kMaxPass)
    return Problem{"start", "must be from 0 to a year"};
  return std::nullopt;
}

TimelineBuilder::TimelineBuilder(std::string name, UtcTime first, const TimelineOptions& options)
    : name_(std::move(name)),
      options_(options),
      begin_{first.ns + options.start.ns},
      latest_{begin_} {}

std::size_t TimelineBuilder::bus(const std::string& interface) {
  const auto same = std::ranges::find_if(
      out_.tracks, [&](const Track& track) { return !track.to && track.target == interface; });
  if (same != out_.tracks.end()) return static_cast<std::size_t>(same - out_.tracks.begin());
  out_.tracks.push_back({.target = interface});
  return out_.tracks.size() - 1;
}

std::size_t TimelineBuilder::receiver(const transport::UdpAddress& to) {
  out_.tracks.push_back({.target = transport::to_string(to), .to = to});
  return out_.tracks.size() - 1;
}

bool TimelineBuilder::is_wanted(const can::Frame& frame) const {
  return options_.ids.empty() || std::ranges::find(options_.ids, frame.id) != options_.ids.end();
}

// Time never runs back, and not through a gap that is skipped.
std::optional<Duration> TimelineBuilder::due_of(UtcTime at) {
  if (too_long_ || (at < begin_ && out_.size() == 0)) return std::nullopt;
  const Duration gap{std::max<std::int64_t>(at.ns - latest_.ns, 0)};
  latest_ = std::max(latest_, at);
  if (gap <= options_.longest_gap) elapsed_ = elapsed_ + gap;
  if (out_.size() == 0) first_ = elapsed_;
  too_long_ = (elapsed_ - first_).seconds() / options_.speed > kMaxPass.seconds();
  if (too_long_) return std::nullopt;
  return scaled(elapsed_ - first_, options_.speed);
}

void TimelineBuilder::add(std::size_t track, UtcTime at, const can::Frame& frame,
                          std::uint8_t fd_flags) {
  if (!is_wanted(frame)) return;
  const auto due = due_of(at);
  if (!due) return;
  Track& to = out_.tracks[track];
  to.frames.push_back(frame);
  to.fd_flags.push_back(fd_flags);
  to.due.push_back(*due);
  ++out_.frames;
}

void TimelineBuilder::add(std::size_t track, UtcTime at, std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return;
  const auto due = due_of(at);
  if (!due) return;
  Track& to = out_.tracks[track];
  const std::size_t begin = to.datagrams.bytes.size();
  to.datagrams.bytes.insert(to.datagrams.bytes.end(), bytes.begin(), bytes.end());
  for (std::size_t end = 0; end < bytes.size(); ++out_.datagrams) {
    end = std::min(end + transport::kMaxDatagramBytes, bytes.size());
    to.datagrams.ends.push_back(begin + end);
    to.due.push_back(*due);
  }
}

Result<Timeline, Problem> TimelineBuilder::finish() && {
  if (too_long_)
    return Unexpected{Problem{name_, "takes more than a year to play (skip its gaps?)"}};
  if (out_.size() == 0) {
    std::string what = "nothing is left of it to play";
    for (const LeftOut& left : out_.left_out) what += "; " + left.source + ": " + left.why;
    return Unexpected{Problem{name_, what}};
  }
  std::erase_if(out_.tracks, [](const Track& track) { return track.due.empty(); });
  const auto gaps = static_cast<std::int64_t>(std::max<std::uint64_t>(out_.size() - 1, 1));
  const Duration span = scaled(elapsed_ - first_, options_.speed);
  out_.pass = span + span / gaps;
  return std::move(out_);
}

}  // namespace pitwall::replay
