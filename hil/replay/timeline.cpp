// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/timeline.hpp"

#include <algorithm>

#include "hil/replay/timeline_builder.hpp"
#include "protocol/recorder/can_record.hpp"

namespace pitwall::replay {
namespace {

using traffic::Recording;
using traffic::Source;
using traffic::SourceKind;

template <class Pairs>
auto* value_of(const Pairs& pairs, const std::string& name) {
  const auto found = std::ranges::find_if(pairs, [&](const auto& p) { return p.first == name; });
  return found == pairs.end() ? nullptr : &found->second;
}

std::string target_of(const std::string& channel, const TimelineOptions& options) {
  if (const auto* mapped = value_of(options.map, channel)) return *mapped;
  return options.interface.empty() ? channel : options.interface;
}

bool is_chosen(const std::string& name, const TimelineOptions& options) {
  return options.topics.empty() || std::ranges::find(options.topics, name) != options.topics.end();
}

// `known`: what there is to choose from.
std::optional<Problem> topic_problem(const std::vector<std::string>& known,
                                     const TimelineOptions& options) {
  std::string list;
  for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
  for (const std::string& topic : options.topics)
    if (std::ranges::find(known, topic) == known.end())
      return Problem{topic, "is not a source with records; expected one of: " + list};
  return std::nullopt;
}

std::vector<std::string> topics_of(const Recording& recording) {
  std::vector<std::string> names;
  for (const Source& source : recording.sources)
    if (source.records > 0) names.push_back(source.name);
  return names;
}

std::optional<Problem> problem_of(const CanLog& log, const TimelineOptions& options) {
  if (auto problem = TimelineBuilder::problem_of(options)) return problem;
  if (log.frames.empty()) return Problem{"log", "holds no frames"};
  if (auto problem = topic_problem(log.channels, options)) return problem;
  for (const auto& [recorded, interface] : options.map)
    if (std::ranges::find(log.channels, recorded) == log.channels.end())
      return Problem{recorded, "is mapped, but does not occur in the log"};
  if (!options.receivers.empty())
    return Problem{options.receivers.front().first, "is not a receiver: a CAN log holds none"};
  if (options.dds) return Problem{"--dds", "a CAN log holds no ROS 2 topics"};
  return std::nullopt;
}

std::string names_of(const Recording& recording, bool can) {
  std::string names;
  for (const Source& source : recording.sources)
    if (source.kind == (can ? SourceKind::kCan : SourceKind::kReceiver))
      names += (names.empty() ? "" : ", ") + source.name;
  return names.empty() ? "there are none" : names;
}

// Of a name that --map (CAN) or --receiver gives.
std::optional<Problem> problem_of(const Recording& recording, const std::string& name, bool can) {
  const std::string known = std::string(can ? "CAN sources" : "receivers") +
                            " of the recording: " + names_of(recording, can);
  const auto source = std::ranges::find(recording.sources, name, &Source::name);
  if (source == recording.sources.end())
    return Problem{name, "is mapped, but does not occur in the recording; " + known};
  if (source->kind != (can ? SourceKind::kCan : SourceKind::kReceiver))
    return Problem{name,
                   std::string(can ? "holds no CAN frames" : "is not a receiver") + "; " + known};
  return std::nullopt;
}

std::optional<Problem> problem_of(const Recording& recording, const TimelineOptions& options) {
  if (auto problem = TimelineBuilder::problem_of(options)) return problem;
  if (recording.records.empty()) return Problem{"recording", "holds no records"};
  if (auto problem = topic_problem(topics_of(recording), options)) return problem;
  if (options.dds && std::ranges::find(recording.sources, SourceKind::kRos, &Source::kind) ==
                         recording.sources.end())
    return Problem{"--dds", "the recording holds no ROS 2 topics"};
  for (const auto& [name, interface] : options.map)
    if (auto problem = problem_of(recording, name, true)) return problem;
  for (auto one = options.receivers.begin(); one != options.receivers.end(); ++one) {
    if (auto problem = problem_of(recording, one->first, false)) return problem;
    for (auto other = options.receivers.begin(); other != one; ++other) {
      if (other->first == one->first) return Problem{one->first, "has two targets"};
      if (is_same_place(other->second, one->second))
        return Problem{to_string(one->second),
                       "is the target of two receivers: their bytes would mix"};
    }
  }
  return std::nullopt;
}

bool can_be_interface(const std::string& name) {
  return !name.empty() && name.size() <= kMaxChannelName && name.find('/') == std::string::npos;
}

struct Way {
  std::optional<std::size_t> track{};
  std::string reason{};
};

Way way_of_can(const std::string& name, const TimelineOptions& options, TimelineBuilder& builder) {
  if (const auto* mapped = value_of(options.map, name)) return {.track = builder.bus(*mapped)};
  const std::string remedy = "--map " + name + "=INTERFACE sends it";
  if (name == recorder::kSentTopic) return {.reason = "the car said it itself; " + remedy};
  if (!options.interface.empty()) return {.track = builder.bus(options.interface)};
  if (can_be_interface(name)) return {.track = builder.bus(name)};
  return {.reason = "has no interface; " + remedy};
}

Way way_of_topic(const Source& source, const TimelineOptions& options, TimelineBuilder& builder) {
  if (!options.dds) return {.reason = "a ROS 2 topic; --dds DOMAIN sends it"};
  const auto topic = ros_topic(source.name, source.type);
  if (!topic) return {.reason = topic.error().what};
  const auto track = builder.topic(*topic);
  if (!track) return {.reason = "its topic has another type already"};
  return {.track = track};
}

Way way_of(const Source& source, const TimelineOptions& options, TimelineBuilder& builder) {
  if (!is_chosen(source.name, options)) return {.reason = "not among those of --topic"};
  switch (source.kind) {
    case SourceKind::kCan:
      return way_of_can(source.name, options, builder);
    case SourceKind::kReceiver:
      if (const auto* to = value_of(options.receivers, source.name))
        return {.track = builder.bytes(*to)};
      return {.reason = "has no target; --receiver " + source.name + "=ADDRESS:PORT sends it"};
    case SourceKind::kRos:
      return way_of_topic(source, options, builder);
    case SourceKind::kOther:
      break;
  }
  return {.reason = "neither CAN nor a receiver nor a ROS 2 topic"};
}

}  // namespace

Result<Timeline, Problem> make_timeline(const CanLog& log, const TimelineOptions& options) {
  if (const auto problem = problem_of(log, options)) return Unexpected{*problem};
  TimelineBuilder builder{"log", log.frames.front().at, options};
  std::vector<std::optional<std::size_t>> track(log.channels.size());
  std::vector<std::uint64_t> left_out(log.channels.size());
  for (std::size_t i = 0; i < track.size(); ++i)
    if (is_chosen(log.channels[i], options))
      track[i] = builder.bus(target_of(log.channels[i], options));
  for (const LoggedFrame& logged : log.frames) {
    if (const auto to = track[logged.channel]) {
      builder.add(*to, logged.at, logged.frame, logged.fd_flags);
    } else {
      ++left_out[logged.channel];
    }
  }
  for (std::size_t i = 0; i < track.size(); ++i)
    if (left_out[i] > 0)
      builder.leave_out({log.channels[i], "not among those of --topic", left_out[i]});
  return std::move(builder).finish();
}

Result<Timeline, Problem> make_timeline(const Recording& recording,
                                        const TimelineOptions& options) {
  if (const auto problem = problem_of(recording, options)) return Unexpected{*problem};
  TimelineBuilder builder{"recording", recording.first(), options};
  std::vector<std::optional<std::size_t>> track;
  for (const Source& source : recording.sources) {
    if (source.records == 0) {
      track.emplace_back();
      continue;
    }
    Way way = way_of(source, options, builder);
    if (!way.track) builder.leave_out({source.name, std::move(way.reason), source.records});
    track.push_back(way.track);
  }
  for (const traffic::Record& record : recording.records) {
    const auto to = track[record.source];
    if (!to) continue;
    if (const can::Frame* frame = record.frame()) {
      builder.add(*to, record.at, *frame, 0);
    } else {
      builder.add(*to, record.at, record.bytes());
    }
  }
  return std::move(builder).finish();
}

}  // namespace pitwall::replay
