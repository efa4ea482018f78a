// Courses that a car may have taken since it was seen last: it went on in its lane; it did with an
// acceleration of which nothing is known; it had one and is in another lane.
//
//   in     a track that was not seen for a while, predicted as if nothing had happened
//   out    the track for each course, and how likely a car that is seen is it on any of them
//   invariants
//          the states are those of the track; the covariance along the road is never smaller,
//          nor is that across it where the car changed its lane
//   cost   1 us for a track, 1 us for a fit; no allocation
//   source a sum of normal distributions has the long tails that one has not: Alspach and Sorenson
//          (1972), IEEE Trans. Automatic Control 17, p. 439
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/tracking/filter/filter_params.hpp"
#include "vehicle/autonomy/tracking/filter/track.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::tracking {

inline constexpr std::size_t kAsBefore = 0, kOtherSpeed = 1, kOtherLane = 2, kCourses = 3;

struct Courses {
  std::array<Track, kCourses> track;    // the last one has the largest covariance
  std::array<double, kCourses> cost{};  // -2 log of its probability
};
Courses courses_of(const RoadParams& params, Duration unseen, const Track& track);

struct CourseFit {
  double square = 0.0;   // Mahalanobis distance on the last course
  double cost = 0.0;     // -2 log of the likelihood, without its constant
  std::size_t best = 0;  // most likely course
};
// Of the track of a car that was seen since, at the same time.
CourseFit course_fit(const Courses& courses, const world::TrackMap* map, const Track& seen);

// States of `to` minus those of `from`.
RoadVector difference_of(const world::TrackMap* map, const Track& from, const Track& to);

}  // namespace pitwall::tracking
