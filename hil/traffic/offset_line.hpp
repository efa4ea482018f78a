// Line of a ghost: its offset from the track's reference line over the station.
//   in     a raceline of the track's bank and a distance beside it, or an offset alone
//   out    offset and its slope dn/ds, both continuous around the lap
//   method cubic Hermite between the points of the raceline, with the slope of its headings
//   errors Problem: a raceline that does not lead once around the track; a line where a car of this
//          half width touches a wall
//   cost   build O(points); at() O(log points), no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/raceline.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::traffic {

struct LineOffset {
  double n_m = 0.0, slope = 0.0;
};

class OffsetLine {
 public:
  explicit OffsetLine(double n_m) : beside_m_(n_m) {}
  static Result<OffsetLine, Problem> of(const world::Raceline& line, const world::TrackMap& track,
                                        double beside_m);

  LineOffset at(double s_m) const;  // s in [0, length)

 private:
  struct Knot {
    double s_m, n_m, slope;
  };
  std::vector<Knot> knots_;  // none: a constant offset
  double length_m_ = 0.0, beside_m_ = 0.0;
};

// `half_width_m`: of the car, with what it may wander beside the line.
std::optional<Problem> touches_wall(const OffsetLine& line, const world::TrackMap& track,
                                    double half_width_m);

}  // namespace pitwall::traffic
