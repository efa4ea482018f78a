// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/courses.hpp"

#include <algorithm>
#include <cmath>

#include "vehicle/autonomy/tracking/filter/cholesky.hpp"
#include "vehicle/autonomy/tracking/filter/measurement.hpp"
#include "vehicle/autonomy/tracking/filter/modes.hpp"
#include "vehicle/autonomy/tracking/filter/motion.hpp"

namespace pitwall::tracking {
namespace {

constexpr double kSpeedLeast_mps = 10.0;

// A constant one, for some seconds at most; then the car keeps the speed that it came to.
void add_acceleration(const RoadParams& params, double unseen_s, Track& track) {
  const double for_s = std::min(unseen_s, params.unseen_accel_s);
  const double speed = params.unseen_accel_sigma_mps2 * for_s;
  const double along = speed * (unseen_s - 0.5 * for_s);
  for (RoadMatrix& p : track.modes.p) {
    p[kAlong][kAlong] += along * along;
    p[kSpeed][kSpeed] += speed * speed;
    p[kAlong][kSpeed] += along * speed;
    p[kSpeed][kAlong] += along * speed;
  }
}

// Anywhere between two lanes, in the direction that a change of lanes needs.
void add_lane_change(const RoadParams& params, double unseen_s, Track& track) {
  const double rate = params.unseen_lane_sigma_mps;
  const double across = rate * std::min(unseen_s, params.unseen_lane_s);
  const double heading = rate / std::max(std::abs(track.x[kSpeed]), kSpeedLeast_mps);
  for (RoadMatrix& p : track.modes.p) {
    p[kAcross][kAcross] += across * across;
    p[kHeading][kHeading] += heading * heading;
  }
}

void keep_lane(const RoadParams& params, Track& track) {
  for (RoadMatrix& p : track.modes.p)
    for (std::size_t i = 0; i < kRoadStates; ++i) {
      p[kAcross][i] *= params.lane_sigma_share;
      p[i][kAcross] *= params.lane_sigma_share;
    }
}

}  // namespace

Courses courses_of(const RoadParams& params, Duration unseen, const Track& track) {
  const double speed = params.other_speed_share, lane = params.other_lane_share;
  const std::array share{(1.0 - lane) * (1.0 - speed), (1.0 - lane) * speed, lane};
  Courses c;
  c.track.fill(track);
  for (std::size_t i = 0; i < kCourses; ++i) {
    if (i != kAsBefore) add_acceleration(params, unseen.seconds(), c.track[i]);
    if (i == kOtherLane)
      add_lane_change(params, unseen.seconds(), c.track[i]);
    else
      keep_lane(params, c.track[i]);
    join_modes(c.track[i]);
    c.cost[i] = -2.0 * std::log(share[i]);
  }
  return c;
}

RoadVector difference_of(const world::TrackMap* map, const Track& from, const Track& to) {
  RoadVector d{};
  for (std::size_t i = 0; i < kRoadStates; ++i) d[i] = to.x[i] - from.x[i];
  d[kAlong] = way_m(map, from.x[kAlong], to.x[kAlong]);
  d[kHeading] = full_turn(d[kHeading]);
  return d;
}

CourseFit course_fit(const Courses& courses, const world::TrackMap* map, const Track& seen) {
  CourseFit fit;
  std::array<double, kCourses> cost{};
  for (std::size_t i = 0; i < kCourses; ++i) {
    const Track& course = courses.track[i];
    const auto l = factor<kRoadStates>(kRoadStates, [&](std::size_t row, std::size_t column) {
      return course.p[row][column] + seen.p[row][column];
    });
    const RoadVector y = solved(l, kRoadStates, difference_of(map, course, seen));
    double square = 0.0, det = 1.0;
    for (std::size_t k = 0; k < kRoadStates; ++k) square += y[k] * y[k], det *= l[k][k];
    cost[i] = square + 2.0 * std::log(det) + courses.cost[i];
    if (cost[i] < cost[fit.best]) fit.best = i;
    fit.square = square;
  }
  double sum = 0.0;
  for (const double c : cost) sum += std::exp(0.5 * (cost[fit.best] - c));
  fit.cost = cost[fit.best] - 2.0 * std::log(sum);
  return fit;
}

}  // namespace pitwall::tracking
