// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/tracking/clear_mot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pitwall::tracking_bench {
namespace {

double apart_m(const Spot& a, const Spot& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

struct Candidate {
  SpotPair pair;
  double apart_m = 0.0;
  bool is_kept = false;  // as in the frame before
};

}  // namespace

const std::vector<SpotPair>& ClearMot::add(std::span<const Spot> objects,
                                           std::span<const Spot> tracks) {
  std::vector<Candidate> candidates;
  for (std::size_t o = 0; o < objects.size(); ++o) {
    const auto known = track_of_.find(objects[o].id);
    for (std::size_t t = 0; t < tracks.size(); ++t) {
      const double d_m = apart_m(objects[o], tracks[t]);
      const bool is_kept = known != track_of_.end() && known->second == tracks[t].id;
      if (d_m <= gate_m_) candidates.push_back({{o, t}, d_m, is_kept});
    }
  }
  std::ranges::sort(candidates, [](const Candidate& a, const Candidate& b) {
    return a.is_kept != b.is_kept ? a.is_kept : a.apart_m < b.apart_m;
  });
  std::vector<bool> has_track(objects.size(), false), is_taken(tracks.size(), false);
  pairs_.clear();
  switched_.clear();
  for (const Candidate& c : candidates) {
    if (has_track[c.pair.object] || is_taken[c.pair.track]) continue;
    has_track[c.pair.object] = is_taken[c.pair.track] = true;
    pairs_.push_back(c.pair);
    const std::uint32_t object = objects[c.pair.object].id, track = tracks[c.pair.track].id;
    const auto known = track_of_.find(object);
    const auto owner = object_of_.find(track);
    const bool has_changed = known != track_of_.end() && known->second != track;
    const bool is_anothers = owner != object_of_.end() && owner->second != object;
    if (has_changed || is_anothers) switched_.push_back(object);
    track_of_[object] = track;
    object_of_[track] = object;
  }
  switches_ += switched_.size();
  for (std::size_t o = 0; o < objects.size(); ++o) {
    if (!objects[o].is_required) continue;
    ++objects_;
    if (!has_track[o]) ++misses_;
  }
  false_ += static_cast<std::size_t>(std::ranges::count(is_taken, false));
  return pairs_;
}

double ClearMot::mota() const {
  if (objects_ == 0) return std::numeric_limits<double>::quiet_NaN();
  return 1.0 - static_cast<double>(misses_ + false_ + switches_) / static_cast<double>(objects_);
}

}  // namespace pitwall::tracking_bench
