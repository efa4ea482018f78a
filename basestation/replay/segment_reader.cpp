// SPDX-License-Identifier: Apache-2.0
#include "basestation/replay/segment_reader.hpp"

#include <algorithm>
#include <set>
#include <string_view>

namespace pitwall::replay {
namespace {

constexpr std::string_view kTextPrefix = "/base/";

std::string_view as_text(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

SegmentReader::SegmentReader(std::span<const std::uint8_t> file, const recorder::ClockMap& clock,
                             telemetry::Snapshot& known)
    : file_(file), clock_(clock), known_(known), reader_(file), next_(reader_.next()) {}

std::optional<Instant> SegmentReader::due() {
  if (!next_) return std::nullopt;
  return to_base(next_->logged_ns);
}

void SegmentReader::step(Listener& listener) {
  if (!next_) return;
  const Place& place = place_of(next_->channel);
  if (place.topic) {
    listener.text(*place.topic, to_base(next_->logged_ns), as_text(next_->data));
  } else if (place.fields && !place.fields->is_snapshot()) {
    tell_state(place, listener);
  }
  next_ = reader_.next();
}

bool SegmentReader::restore(Instant at, Listener& listener) {
  std::optional<recording::McapReader> then;
  std::optional<recording::McapMessage> vehicle;
  for (; next_ && to_base(next_->logged_ns) <= at; next_ = reader_.next()) {
    const Place& place = place_of(next_->channel);
    if (!place.fields || !place.fields->is_snapshot()) continue;
    then = reader_;
    vehicle = next_;
  }
  if (!vehicle) {
    reader_ = recording::McapReader{file_};
    next_ = reader_.next();
    return false;
  }
  recorder::Known known;
  if (!place_of(vehicle->channel).fields->decode(vehicle->data, known)) ++unreadable_;
  publish_snapshot(known, to_base(vehicle->logged_ns), listener);
  reader_ = *then;
  next_ = reader_.next();
  return true;
}

void SegmentReader::skip_to(Instant at) {
  while (next_ && to_base(next_->logged_ns) < at) next_ = reader_.next();
}

const SegmentReader::Place& SegmentReader::place_of(std::uint16_t channel) {
  const auto found = places_.find(channel);
  if (found != places_.end()) return found->second;
  const recording::Channel& here = reader_.channels().at(channel);
  Place place{.fields = recorder::ChannelFields::of(here), .topic = std::nullopt};
  if (!place.fields && here.topic.starts_with(kTextPrefix)) {
    place.topic = recorder::topic_named(std::string_view{here.topic}.substr(kTextPrefix.size()));
    if (!place.topic) ++unreadable_;
  }
  return places_.emplace(channel, std::move(place)).first->second;
}

Instant SegmentReader::to_base(std::uint64_t file_ns) const {
  return clock_.to_base(Instant{static_cast<std::int64_t>(file_ns)});
}

void SegmentReader::tell_state(const Place& place, Listener& listener) {
  const auto group = place.fields->group();
  if (!group || !place.fields->decode(next_->data, known_.values)) {
    ++unreadable_;
    return;
  }
  known_.at(*group) = to_base(next_->published_ns);
  telemetry::GroupSet groups;
  groups.add(*group);
  listener.state(known_, groups, to_base(next_->logged_ns));
}

// A field that its group no longer knew has an older sample than the group: so each group is told
// once for each of its sample times, the newest last.
void SegmentReader::publish_snapshot(const recorder::Known& vehicle, Instant at,
                                     Listener& listener) {
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
    const auto [first, count] = telemetry::fields_of(row.group);
    std::set<Instant> times;
    for (auto i = first; i < first + count; ++i) {
      if (vehicle.sampled[i] != telemetry::kNeverSampled) times.insert(vehicle.sampled[i]);
    }
    for (const Instant sampled : times) {
      for (auto i = first; i < first + count; ++i) {
        known_.values[i] = vehicle.sampled[i] == sampled ? vehicle.value[i] : kUnset;
      }
      known_.at(row.group) = clock_.to_base(sampled);
      telemetry::GroupSet groups;
      groups.add(row.group);
      listener.state(known_, groups, at);
    }
  }
}

}  // namespace pitwall::replay
