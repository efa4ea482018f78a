// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/timeline_builder.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/text.hpp"

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
  if (options.from < Duration{} || options.from > kMaxPass)
    return Problem{"from", "must be from 0 to a year"};
  if (options.until <= options.from) return Problem{"until", "must be later than --from"};
  return std::nullopt;
}

TimelineBuilder::TimelineBuilder(std::string name, UtcTime first, const TimelineOptions& options)
    : name_(std::move(name)),
      options_(options),
      filter_({.ids = options.ids, .not_ids = options.not_ids, .nodes = options.nodes}),
      origin_{first},
      begin_{first.ns + options.from.ns},
      end_{options.until.ns > INT64_MAX - first.ns ? INT64_MAX : first.ns + options.until.ns},
      latest_{begin_},
      newest_{first} {}

void TimelineBuilder::add_track(Track track) {
  out_.tracks.push_back(std::move(track));
  if (options_.restamp) histories_.emplace_back(*options_.restamp);
}

std::size_t TimelineBuilder::bus(const std::string& interface) {
  const auto same = std::ranges::find_if(
      out_.tracks, [&](const Track& track) { return !track.to && track.target == interface; });
  if (same != out_.tracks.end()) return static_cast<std::size_t>(same - out_.tracks.begin());
  add_track({.target = interface});
  return out_.tracks.size() - 1;
}

std::size_t TimelineBuilder::bytes(const ByteTarget& to) {
  add_track({.target = to_string(to), .to = to});
  return out_.tracks.size() - 1;
}

std::optional<std::size_t> TimelineBuilder::topic(const RosTopic& to) {
  for (std::size_t i = 0; i < out_.tracks.size(); ++i) {
    const auto* ros = out_.tracks[i].to ? std::get_if<RosTopic>(&*out_.tracks[i].to) : nullptr;
    if (ros == nullptr || ros->topic != to.topic) continue;
    return *ros == to ? std::optional{i} : std::nullopt;
  }
  return bytes(to);
}

// A log begins with the first stamp of the part that is played, and ends before the first one that
// lies beyond.
bool TimelineBuilder::is_in_time(UtcTime at) {
  newest_ = std::max(newest_, at);
  ended_ = ended_ || at >= end_;
  return !ended_ && !too_long_ && (at >= begin_ || out_.size() > 0);
}

// Time never runs back, and not through a gap that is skipped.
std::optional<Duration> TimelineBuilder::due_of(UtcTime at) {
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
  if (options_.restamp) histories_[track].observe(frame);
  if (!is_in_time(at) || !filter_.takes(frame)) return;
  const auto due = due_of(at);
  if (!due) return;
  Track& to = out_.tracks[track];
  to.frames.push_back(frame);
  to.fd_flags.push_back(fd_flags);
  to.due.push_back(*due);
  ++out_.frames;
}

void TimelineBuilder::add(std::size_t track, UtcTime at, std::span<const std::uint8_t> bytes) {
  if (!is_in_time(at) || bytes.empty()) return;
  const auto due = due_of(at);
  if (!due) return;
  Track& to = out_.tracks[track];
  const std::size_t begin = to.datagrams.bytes.size();
  to.datagrams.bytes.insert(to.datagrams.bytes.end(), bytes.begin(), bytes.end());
  const bool is_message = std::holds_alternative<RosTopic>(*to.to);
  const std::size_t most = is_message ? bytes.size() : transport::kMaxDatagramBytes;
  for (std::size_t end = 0; end < bytes.size(); ++out_.datagrams) {
    end = std::min(end + most, bytes.size());
    to.datagrams.ends.push_back(begin + end);
    to.due.push_back(*due);
  }
}

Problem TimelineBuilder::nothing_left() const {
  std::string what = "nothing is left of it to play";
  if (options_.from > Duration{} || end_ < UtcTime{INT64_MAX})
    what += formatted("; its %.3f s hold nothing from --from to --until",
                      Duration{newest_.ns - origin_.ns}.seconds());
  for (const LeftOut& left : out_.left_out) what += "; " + left.source + ": " + left.why;
  return {name_, what};
}

void TimelineBuilder::restamp() {
  for (std::size_t i = 0; i < out_.tracks.size(); ++i) {
    Track& track = out_.tracks[i];
    track.restamp = RestampPlan{*options_.restamp, histories_[i], track.frames};
    for (std::size_t f = 0; f < track.frames.size(); ++f)
      track.restamp.stamp(f, 0, track.frames[f]);
    out_.restamped += track.restamp.stamped();
    out_.unfit += track.restamp.unfit();
  }
}

Result<Timeline, Problem> TimelineBuilder::finish() && {
  if (too_long_)
    return Unexpected{Problem{name_, "takes more than a year to play (skip its gaps?)"}};
  if (out_.size() == 0 && !filter_.has_seen_any()) return Unexpected{nothing_left()};
  if (const auto problem = filter_.problem()) return Unexpected{*problem};
  if (out_.size() == 0) return Unexpected{nothing_left()};
  out_.filtered = filter_.left_out();
  out_.dds = options_.dds;
  if (options_.restamp) restamp();
  if (options_.restamp && out_.restamped == 0)
    return Unexpected{
        Problem{options_.restamp->name, "gives none of the frames a counter or a checksum"}};
  std::erase_if(out_.tracks, [](const Track& track) { return track.due.empty(); });
  const auto gaps = static_cast<std::int64_t>(std::max<std::uint64_t>(out_.size() - 1, 1));
  const Duration span = scaled(elapsed_ - first_, options_.speed);
  out_.pass = span + span / gaps;
  return std::move(out_);
}

}  // namespace pitwall::replay
