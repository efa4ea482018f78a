// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/association.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/fixed_vector.hpp"

namespace pitwall::tracking {
namespace {

struct Pair {
  double cost = 0.0;
  std::uint8_t track = 0, detection = 0;
};

void join(Assignment& a, std::size_t track, std::size_t detection) {
  a.of_track[track] = static_cast<std::uint8_t>(detection);
  a.of_detection[detection] = static_cast<std::uint8_t>(track);
}

Assignment greedy(const Costs& c) {
  FixedVector<Pair, kTracksMax * kMeasurementsMax> pairs;
  for (std::size_t t = 0; t < c.tracks; ++t)
    for (std::size_t d = 0; d < c.detections; ++d)
      if (std::isfinite(c.cost[t][d]))
        (void)pairs.push(
            {c.cost[t][d], static_cast<std::uint8_t>(t), static_cast<std::uint8_t>(d)});
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    if (a.cost != b.cost) return a.cost < b.cost;
    return a.track != b.track ? a.track < b.track : a.detection < b.detection;
  });
  Assignment a;
  a.of_track.fill(kNone), a.of_detection.fill(kNone);
  for (const Pair& p : pairs)
    if (a.of_track[p.track] == kNone && a.of_detection[p.detection] == kNone)
      join(a, p.track, p.detection);
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
