// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/courses.hpp"

#include <algorithm>
#include <cmath>

#include "vehicle/autonomy/tracking/filter/modes.hpp"
#include "vehicle/autonomy/tracking/filter/motion.hpp"

namespace pitwall::tracking {
namespace {

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
    if (i != kOtherLane) keep_lane(params, c.track[i]);
    join_modes(c.track[i]);
    c.cost[i] = -2.0 * std::log(share[i]);
  }
  return c;
}

CourseFit course_fit(const Courses& courses, const Expectation& e, const Innovation& in) {
  constexpr double kMost = 1e6;
  CourseFit fit;
  std::array<double, kCourses> cost{};
  for (std::size_t i = 0; i < kCourses; ++i) {
    const Distance distance = distance_of(spread_of(e, courses.track[i].p), in, kMost);
    cost[i] = distance.square + distance.log_det + courses.cost[i];
    if (cost[i] < cost[fit.best]) fit.best = i;
    fit.square = distance.square;
  }
  double sum = 0.0;
  for (const double c : cost) sum += std::exp(0.5 * (cost[fit.best] - c));
  fit.cost = cost[fit.best] - 2.0 * std::log(sum);
  return fit;
}

}  // namespace pitwall::tracking
