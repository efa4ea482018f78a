// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/reidentification.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "protocol/vocabulary/fixed_vector.hpp"
#include "vehicle/autonomy/tracking/filter/association.hpp"
#include "vehicle/autonomy/tracking/filter/cholesky.hpp"
#include "vehicle/autonomy/tracking/filter/courses.hpp"
#include "vehicle/autonomy/tracking/filter/life.hpp"
#include "vehicle/autonomy/tracking/filter/measurement.hpp"
#include "vehicle/autonomy/tracking/filter/modes.hpp"

namespace pitwall::tracking {
namespace {

using world::TrackMap;

// Places of the tracks in their list: rows and columns of the costs.
using Places = FixedVector<std::uint8_t, kTracksMax>;
struct Pairs {
  Places lost, seen;
  Costs costs;
};

bool is_undecided(const Track& t) { return t.confirmed && t.undecided; }

bool may_be(const Track& lost, const Track& seen) {
  return lost.newest.frame.at < seen.first.frame.at;
}

Pairs pairs_of(const RoadParams& params, const TrackMap* map, const Frame& frame,
               const Tracks& tracks) {
  Pairs p;
  for (std::size_t i = 0; i < tracks.list.size(); ++i) {
    const Track& t = tracks.list[i];
    if (is_undecided(t))
      (void)p.seen.push(static_cast<std::uint8_t>(i));
    else if (is_lost(frame, t))
      (void)p.lost.push(static_cast<std::uint8_t>(i));
  }
  p.costs.tracks = p.lost.size(), p.costs.detections = p.seen.size();
  for (std::size_t l = 0; l < p.lost.size(); ++l) {
    const Track& lost = tracks.list[p.lost[l]];
    const Courses courses = courses_of(params, frame.key.at - lost.newest.frame.at, lost);
    for (std::size_t s = 0; s < p.seen.size(); ++s) {
      const Track& seen = tracks.list[p.seen[s]];
      p.costs.cost[l][s] = Costs::kOutside;
      if (!may_be(lost, seen)) continue;
      const CourseFit fit = course_fit(courses, map, seen);
      if (fit.square <= params.same_car_gate) p.costs.cost[l][s] = fit.cost;
    }
  }
  return p;
}

// A normal distribution by another one: each mode of the track is updated by all states of `seen`.
void fuse(const TrackMap* map, const Track& seen, Track& track) {
  const RoadVector d = difference_of(map, track, seen);
  Modes& m = track.modes;
  std::array<double, kModes> cost{};
  for (std::size_t k = 0; k < kModes; ++k) {
    RoadMatrix& p = m.p[k];
    const RoadMatrix before = p;
    const auto l = factor<kRoadStates>(
        kRoadStates, [&](std::size_t i, std::size_t j) { return p[i][j] + seen.p[i][j]; });
    RoadVector rest;
    for (std::size_t i = 0; i < kRoadStates; ++i) rest[i] = d[i] - m.apart[k][i];
    const RoadVector y = solved(l, kRoadStates, rest);
    RoadMatrix half;  // L^-1 P, by columns
    for (std::size_t i = 0; i < kRoadStates; ++i) half[i] = solved(l, kRoadStates, before[i]);
    for (std::size_t i = 0; i < kRoadStates; ++i) {
      cost[k] += y[i] * y[i] + 2.0 * std::log(l[i][i]);
      for (std::size_t n = 0; n < kRoadStates; ++n) m.apart[k][i] += half[i][n] * y[n];
      for (std::size_t j = 0; j < kRoadStates; ++j)
        for (std::size_t n = 0; n < kRoadStates; ++n) p[i][j] -= half[i][n] * half[j][n];
    }
  }
  const double least = *std::min_element(cost.begin(), cost.end());
  double sum = 0.0;
  for (std::size_t k = 0; k < kModes; ++k)
    sum += m.share[k] *= std::max(1e-6, std::exp(0.5 * (least - cost[k])));
  for (double& share : m.share) share /= sum;
  centre_modes(track);
  track.x[kHeading] = full_turn(track.x[kHeading]);
  if (map != nullptr) track.x[kAlong] = map->wrap_station(track.x[kAlong]);
  join_modes(track);
}

// The lost track on the course that fits best, as it goes on.
Track resumed(const RoadParams& params, const TrackMap* map, Duration coast, const Frame& frame,
              const Track& lost, const Track& seen) {
  const Duration unseen = frame.key.at - lost.newest.frame.at;
  const Courses courses = courses_of(params, unseen, lost);
  Track track = courses.track[course_fit(courses, map, seen).best];
  fuse(map, seen, track);
  track.previous = seen.previous, track.newest = seen.newest;
  track.detections += seen.detections, track.confidence = seen.confidence;
  if (seen.first.frame.at - lost.newest.frame.at > coast)
    track.first = seen.first, track.born_at = seen.born_at;
  return track;
}

}  // namespace

void identify(const RoadParams& params, const TrackMap* map, Duration coast, const Frame& frame,
              Tracks& tracks) {
  if (std::none_of(tracks.list.begin(), tracks.list.end(), is_undecided)) return;
  for (Track& track : tracks.list)
    if (is_undecided(track)) join_modes(track);
  const Pairs p = pairs_of(params, map, frame, tracks);
  const Assignment a = assign(p.costs, Search::kBestTwo);
  std::array<bool, kTracksMax> ends{};
  for (std::size_t s = 0; s < p.seen.size(); ++s) {
    Track& seen = tracks.list[p.seen[s]];
    seen.undecided = false;
    const std::size_t l = a.of_detection[s];
    if (l == kNone) continue;
    seen = resumed(params, map, coast, frame, tracks.list[p.lost[l]], seen);
    ends[p.lost[l]] = true;
  }
  for (std::size_t i = tracks.list.size(); i-- > 0;)
    if (ends[i]) end_track(i, tracks);
}

}  // namespace pitwall::tracking
