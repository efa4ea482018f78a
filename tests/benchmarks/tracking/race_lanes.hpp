// Places on the road for cars that are driven by a script: lanes along the middle of the road, and
// the motion of a car along them.
//   in     the track; station, lane and speed of a car
//   out    true cars in Map that move in the direction in which they point
//   frames a lane is an offset from the middle of the road, positive left. The middle is smoothed
//          over some 200 m, because the walls of a track file have corners
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hil/sensors/detections.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::tracking_bench {

struct Motion {
  double s_m = 0.0;  // of the reference line; grows from lap to lap
  double lane_m = 0.0, lane_rate_mps = 0.0;
  double speed_mps = 0.0, accel_mps2 = 0.0;
};

class RaceLanes {
 public:
  explicit RaceLanes(const world::TrackMap& track);

  plant::CarPose placed(const Motion& motion) const;
  // Speed and station after a while; the lane is the driver's.
  void advance(Motion& motion, double dt_s) const;

 private:
  struct Middle {
    double offset_m = 0.0, slope = 0.0;
  };
  Middle middle(double s_m) const;
  struct Rates {
    double along_mps = 0.0, across_mps = 0.0;  // to the reference line
    double station_mps = 0.0;
  };
  Rates rates(const Motion& motion, const world::TrackPoint& at, const Middle& middle) const;

  const world::TrackMap* track_;
  double step_m_ = 0.0;
  std::vector<double> offset_m_;
};

}  // namespace pitwall::tracking_bench
