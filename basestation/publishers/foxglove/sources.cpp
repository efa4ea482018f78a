// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/foxglove/sources.hpp"

#include <algorithm>
#include <utility>

#include "basestation/state/station_field.hpp"

namespace pitwall::publishers::foxglove {
namespace {

constexpr std::size_t kNowhere = std::string::npos;
constexpr std::string_view kOwnPackage = "pitwall_msgs/", kBase = "/base/",
                           kValues = "/base/values/";

// Texts that say how things are: who comes later needs the newest.
bool is_standing(recorder::Topic topic) {
  using enum recorder::Topic;
  return topic == kHello || topic == kAlarms || topic == kAuthority || topic == kFuel ||
         topic == kLink || topic == kExpected || topic == kSettings;
}

bool is_of_base(std::string_view group) {
  return std::ranges::any_of(state::kBaseTable,
                             [group](const auto& row) { return row.group == group; });
}

}  // namespace

Sources::Sources(ros_view::ViewConfig view, recorder::ClockMap clock)
    : clock_(std::move(clock)), view_(view) {
  add_view_topics(view.space);
  add_recorded_channels(view.space);
}

void Sources::add_view_topics(const std::string& space) {
  for (const ros_view::Topic& topic : view_.topics()) {
    std::string name = topic.name;
    if (topic.type.starts_with(kOwnPackage)) {
      const std::string group = name.substr(std::min(name.size(), space.size() + kBase.size()));
      if (!is_of_base(group)) {
        of_view_.push_back(kNowhere);  // the car's groups are told as a recording has them
        continue;
      }
      name = space + std::string{kValues} + group;
    }
    of_view_.push_back(channels_.size());
    channels_.push_back({.topic = name,
                         .encoding = "cdr",
                         .schema_name = topic.type,
                         .schema_encoding = "ros2msg",
                         .schema = topic.schema,
                         .latched = topic.latched});
  }
}

void Sources::add_recorded_channels(const std::string& space) {
  const auto recorded = recorder::channels();
  for (std::size_t place = 0; place < telemetry::kGroups + recorder::kTopics; ++place) {
    const recording::Channel& channel = recorded[place];
    of_recording_.push_back(channels_.size());
    const bool text = place >= telemetry::kGroups;
    channels_.push_back(
        {.topic = space + channel.topic,
         .encoding = channel.message_encoding,
         .schema_name = channel.schema.name,
         .schema_encoding = channel.schema.encoding,
         .schema = channel.schema.text,
         .latched = text && is_standing(static_cast<recorder::Topic>(place - telemetry::kGroups))});
  }
}

void Sources::statics(Instant now, const Sink& sink) {
  view_.statics(now, clock_.utc_minus_base, [&](const ros_view::Message& message) {
    sink(of_view_[message.topic], utc(now), message.cdr);
  });
}

void Sources::take(const feed::Sample& sample, const Sink& sink) {
  const UtcTime at = utc(sample.received);
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
    if (!sample.groups.has(row.group) || !sample.state.ever(row.group)) continue;
    const recorder::GroupBytes bytes = recorder::encode(row.group, sample.state.values);
    sink(of_recording_[recorder::channel_of(row.group)], at, bytes.span());
  }
  view_.car(sample.state, sample.groups, sample.received, clock_.utc_minus_base,
            [&](const ros_view::Message& message) {
              const std::size_t channel = of_view_[message.topic];
              if (channel != kNowhere) sink(channel, at, message.cdr);
            });
}

void Sources::take(const feed::Reported& reported, const Sink& sink) const {
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(reported.json.data());
  sink(of_recording_[recorder::channel_of(reported.topic)], utc(reported.at),
       {bytes, reported.json.size()});
}

void Sources::take(const feed::BaseStatus& base_status, const Sink& sink) {
  view_.base(base_status, clock_.utc_minus_base, [&](const ros_view::Message& message) {
    const std::size_t channel = of_view_[message.topic];
    if (channel != kNowhere) sink(channel, utc(base_status.at), message.cdr);
  });
}

}  // namespace pitwall::publishers::foxglove
