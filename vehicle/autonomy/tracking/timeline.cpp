// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/timeline.hpp"

#include <algorithm>

#include "protocol/vocabulary/fixed_vector.hpp"
#include "vehicle/autonomy/tracking/filter/road_filter.hpp"

namespace pitwall::tracking {
namespace {

constexpr Duration kMarkEvery = milliseconds(100);

// Without the places that are not used.
void copy(const Tracks& from, Tracks& to) {
  to.started = from.started, to.at = from.at, to.crowded = from.crowded;
  to.list.clear();
  for (const Track& track : from.list) (void)to.list.push(track);
}

}  // namespace

Timeline::Timeline() {
  for (std::size_t i = 0; i < kStoredMax; ++i) pool_[i].next = static_cast<std::uint16_t>(i + 1);
}

// The oldest checkpoint stays as long as the next one is within the window.
void Timeline::forget_before(Instant from) {
  while (marks_ >= 2 && checkpoint(1).key.at < from) {
    oldest_ = (oldest_ + 1) % kCheckpointsMax;
    --marks_;
  }
  if (marks_ == 0 || checkpoint(0).key.at >= from) return;
  const FrameKey floor = checkpoint(0).key;
  std::size_t count = 0;
  while (count < size_ && frames_[count].key <= floor) ++count;
  drop_frames(count);
  dropped_ = true;
}

void Timeline::drop_frames(std::size_t count) {
  if (count == 0) return;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint16_t at = frames_[i].first;
    for (std::uint8_t k = 0; k < frames_[i].size; ++k) {
      const std::uint16_t next = pool_[at].next;
      pool_[at].next = free_;
      free_ = at;
      at = next;
    }
    room_ += frames_[i].size;
  }
  std::copy(frames_.begin() + count, frames_.begin() + size_, frames_.begin());
  size_ -= count;
  first_new_ -= std::min(first_new_, count);
}

Insertion Timeline::insert(const FrameKey& key, const OwnMotion& own,
                           std::span<const Measurement> measurements) {
  if (dropped_ && key <= checkpoint(0).key) return Insertion::kTooOld;
  const auto end = frames_.begin() + size_;
  const auto place = std::lower_bound(
      frames_.begin(), end, key, [](const StoredFrame& f, const FrameKey& k) { return f.key < k; });
  if (place != end && place->key == key) return Insertion::kRepeated;
  if (size_ == kFramesMax || measurements.size() > room_) return Insertion::kNoRoom;
  const auto index = static_cast<std::size_t>(place - frames_.begin());
  std::copy_backward(place, end, end + 1);
  StoredFrame& frame = *place;
  frame = {.key = key, .own = own, .size = static_cast<std::uint8_t>(measurements.size())};
  for (std::size_t k = measurements.size(); k-- > 0;) {
    const std::uint16_t at = free_;
    free_ = pool_[at].next;
    pool_[at] = {.measurement = measurements[k], .next = frame.first};
    frame.first = at;
  }
  room_ -= measurements.size();
  ++size_;
  late_ = late_ || index < first_new_;
  first_new_ = std::min(first_new_, index);
  return Insertion::kDone;
}

// Returns the first frame to filter.
std::size_t Timeline::go_back(Tracks& tracks) {
  while (marks_ > 0 && checkpoint(marks_ - 1).key > frames_[first_new_].key) --marks_;
  if (marks_ == 0) {
    tracks = Tracks{};
    return 0;
  }
  const Checkpoint& from = checkpoint(marks_ - 1);
  copy(from.tracks, tracks);
  std::size_t first = first_new_;
  while (first > 0 && frames_[first - 1].key > from.key) --first;
  return first;
}

void Timeline::filter(const Params& params, const world::TrackMap* map, const StoredFrame& frame,
                      Tracks& tracks) const {
  FixedVector<Measurement, kMeasurementsMax> measurements;
  std::uint16_t at = frame.first;
  for (std::uint8_t k = 0; k < frame.size; ++k, at = pool_[at].next)
    (void)measurements.push(pool_[at].measurement);
  filter_road(params.road, map, from_seconds(params.coast_s),
              {.key = frame.key, .own = frame.own, .measurements = measurements.span()}, tracks);
}

// Without room the next late frame goes back further.
void Timeline::mark(const FrameKey& key, const Tracks& tracks) {
  if (marks_ == kCheckpointsMax) return;
  if (marks_ > 0 && key.at - checkpoint(marks_ - 1).key.at < kMarkEvery) return;
  Checkpoint& made = checkpoint(marks_++);
  made.key = key;
  copy(tracks, made.tracks);
}

void Timeline::settle(const Params& params, const world::TrackMap* map, Tracks& tracks) {
  if (first_new_ == size_) return;
  for (std::size_t i = late_ ? go_back(tracks) : first_new_; i < size_; ++i) {
    filter(params, map, frames_[i], tracks);
    mark(frames_[i].key, tracks);
  }
  first_new_ = size_;
  late_ = false;
}

}  // namespace pitwall::tracking
