// Surface on which the centre of gravity of the modelled car moves: the ruled road of the track
// map, z = -n tan(bank(s)), raised by the height of the centre of gravity along its normal.
//   in     a track map, the excess of the true banking over the map's; position and motion of the
//          car
//   out    attitude, height and their rates, in the form of plant::Surface
//   invariants
//          Z(s, n) = -n T + h sqrt(1 + T^2), T(s) = tan(bank). With the heading error e, the slopes
//          a = Z_s / (1 - n kappa) and b = Z_n, along and across the car p = a cos e + b sin e and
//          q = b cos e - a sin e: climb = atan p, tan(bank) = -q cos(climb). Rates by the chain
//          rule; the heading rate appears in its own equation, which is solved for it
//   method T is a uniform cubic B-spline over the map's banking (knots kKnot_m apart): twice
//          differentiable, so that a kink of the table gives no step of the vertical speed. Equal
//          to the map where the banking is linear over four knots; elsewhere within 0.25 kKnot_m
//          times the change of slope (0.2 degrees at Las Vegas)
//   frames as in plant.hpp
//   cost   at(): O(1), no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hil/plant/plant.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::plant {

class RoadSurface {
 public:
  static constexpr double kKnot_m = 5.0;

  RoadSurface() = default;  // level everywhere
  RoadSurface(const world::TrackMap& track, double bank_error_rad, double height_m);

  // `here`: position of the centre of gravity, from road_at(). Friction and wind stay at their
  // defaults.
  Surface at(const Road& here, const Motion& motion) const;

 private:
  struct Bank {  // tan(bank) and its derivatives by station
    double value = 0.0, slope = 0.0, bend = 0.0;
  };
  struct Line {
    double curvature_per_m = 0.0, change_per_m2 = 0.0;
  };
  Bank bank(double s_m) const;
  Line line(double s_m) const;

  double knot_m_ = kKnot_m, spacing_m_ = 1.0, height_m_ = 0.0;
  std::vector<double> tangent_;          // tan(bank) at the knots
  std::vector<double> curvature_per_m_;  // at the points of the map
};

}  // namespace pitwall::plant
