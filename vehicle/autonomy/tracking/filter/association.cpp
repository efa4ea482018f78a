// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/association.hpp"

#include <cmath>

namespace pitwall::tracking {
namespace {

void join(Assignment& a, std::size_t track, std::size_t detection) {
  a.of_track[track] = static_cast<std::uint8_t>(detection);
  a.of_detection[detection] = static_cast<std::uint8_t>(track);
}

// Of the pairs that are still free the one with the least cost; the first of equal ones.
bool join_least(const Costs& c, Assignment& a) {
  double least = Costs::kOutside;
  std::size_t track = kNone, detection = kNone;
  for (std::size_t t = 0; t < c.tracks; ++t) {
    if (a.of_track[t] != kNone) continue;
    for (std::size_t d = 0; d < c.detections; ++d)
      if (c.cost[t][d] < least && a.of_detection[d] == kNone)
        least = c.cost[t][d], track = t, detection = d;
  }
  if (track != kNone) join(a, track, detection);
  return track != kNone;
}

Assignment greedy(const Costs& c) {
  Assignment a;
  a.of_track.fill(kNone), a.of_detection.fill(kNone);
  while (join_least(c, a)) {
  }
  return a;
}

// Both keep their number of detections.
bool exchange(const Costs& c, Assignment& a, std::size_t s, std::size_t t) {
  const std::size_t ds = a.of_track[s], dt = a.of_track[t];
  if (ds == kNone || dt == kNone) return false;
  if (!(c.cost[s][dt] + c.cost[t][ds] < c.cost[s][ds] + c.cost[t][dt])) return false;
  join(a, s, dt), join(a, t, ds);
  return true;
}

// Track s has none, and its detection is held by a track that can take a free one.
bool hand_over(const Costs& c, Assignment& a, std::size_t s, std::size_t t) {
  const std::size_t held = a.of_track[t];
  if (a.of_track[s] != kNone || held == kNone || !std::isfinite(c.cost[s][held])) return false;
  std::size_t best = kNone;
  for (std::size_t d = 0; d < c.detections; ++d)
    if (a.of_detection[d] == kNone && std::isfinite(c.cost[t][d]) &&
        (best == kNone || c.cost[t][d] < c.cost[t][best]))
      best = d;
  if (best == kNone) return false;
  join(a, t, best), join(a, s, held);
  return true;
}

bool improved(const Costs& c, Assignment& a) {
  for (std::size_t s = 0; s < c.tracks; ++s)
    for (std::size_t t = 0; t < c.tracks; ++t)
      if (s != t && (exchange(c, a, s, t) || hand_over(c, a, s, t))) return true;
  return false;
}

}  // namespace

Assignment assign(const Costs& costs, Search search) {
  Assignment a = greedy(costs);
  constexpr int kRounds = 4 * kTracksMax;  // each assigns one more or lowers the cost
  if (search == Search::kBestTwo)
    for (int k = 0; k < kRounds && improved(costs, a); ++k) {
    }
  return a;
}

}  // namespace pitwall::tracking
