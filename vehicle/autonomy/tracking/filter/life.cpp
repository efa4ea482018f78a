// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/life.hpp"

#include <algorithm>

namespace pitwall::tracking {
namespace {

constexpr Duration kTrialMax = milliseconds(500);  // where the sensor of the first one is silent
constexpr std::uint32_t kDetectionsToConfirm = 2;
constexpr Duration kLostAfter = milliseconds(300);

DetectionKey key_of(const Frame& frame, std::size_t index) {
  return {frame.key, static_cast<std::uint8_t>(index)};
}

bool is_unseen(const Frame& frame, Duration coast, const Track& t) {
  return frame.key.at - t.newest.frame.at > (t.confirmed ? coast : kTrialMax);
}

bool has_ended(const Frame& frame, Duration coast, const Track& t) {
  const FrameKey& first = t.first.frame;
  const bool same_sensor = frame.key.source == first.source && frame.key.unit == first.unit;
  return is_unseen(frame, coast, t) || (!t.confirmed && same_sensor && t.newest.frame != frame.key);
}

template <class Ended>
void remove_tracks(Tracks& tracks, Ended&& ended) {
  const Track* const all = tracks.list.begin();
  const std::size_t size = tracks.list.size();
  if (std::none_of(all, all + size, ended)) return;
  tracks.list.clear();
  for (std::size_t i = 0; i < size; ++i)
    if (!ended(all[i])) (void)tracks.list.push(all[i]);
}

}  // namespace

void note_first(const Frame& frame, std::size_t index, Track& track) {
  track.first = track.previous = track.newest = key_of(frame, index);
  track.detections = 1;
  track.confidence = frame.measurements[index].confidence;
}

void note_detection(const Frame& frame, std::size_t index, Track& track) {
  track.previous = track.newest;
  track.newest = key_of(frame, index);
  track.confidence = frame.measurements[index].confidence;
  ++track.detections;
  if (track.confirmed || track.detections < kDetectionsToConfirm) return;
  track.confirmed = true;
  track.born_at = frame.key.at;
}

bool is_lost(const Frame& frame, const Track& t) {
  return t.confirmed && frame.key.at - t.newest.frame.at > kLostAfter;
}

void add_track(const Track& track, Tracks& tracks) {
  if (!tracks.list.push(track)) ++tracks.crowded;
}

void make_room(const Frame& frame, Duration coast, Tracks& tracks) {
  while (tracks.list.size() + frame.measurements.size() > kTracksMax && !tracks.list.empty()) {
    const Track* const oldest = std::min_element(
        tracks.list.begin(), tracks.list.end(),
        [](const Track& a, const Track& b) { return a.newest.frame.at < b.newest.frame.at; });
    if (!is_unseen(frame, coast, *oldest)) return;
    remove_tracks(tracks, [oldest](const Track& t) { return &t == oldest; });
  }
}

void end_unseen(const Frame& frame, Duration coast, Tracks& tracks) {
  remove_tracks(tracks, [&](const Track& t) { return is_unseen(frame, coast, t); });
}

void end_tracks(const Frame& frame, Duration coast, Tracks& tracks) {
  remove_tracks(tracks, [&](const Track& t) { return has_ended(frame, coast, t); });
}

void end_track(std::size_t index, Tracks& tracks) {
  const Track* const ended = &tracks.list[index];
  remove_tracks(tracks, [ended](const Track& t) { return &t == ended; });
}

}  // namespace pitwall::tracking
