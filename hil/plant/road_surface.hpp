// The surface on which the modelled car's centre of gravity moves: the ruled road of the track map,
// z = -n tan(bank(s)), lifted by the height of the centre of gravity along its normal.
//   in     a track map, what the true banking is more than the map's; where the car is and how it
//          moves
//   out    attitude, height and their rates, as plant::Surface takes them
//   invariants
//          Z(s, n) = -n T + h sqrt(1 + T^2), T(s) = tan(bank). With the heading error e, the slopes
//          a = Z_s / (1 - n kappa) and b = Z_n, along and across the car p = a cos e + b sin e and
//          q = b cos e - a sin e: climb = atan p, tan(bank) = -q cos(climb). Rates by the chain
//          rule; that of the heading enters its own equation and is solved for
//   method T is a uniform cubic B-spline over the map's banking (knots kKnot_m apart): twice
//          differentiable, so that a kink of the table is not a step of the vertical speed. Equal
//          to the map where the banking is straight over four knots; elsewhere within
//          0.25 kKnot_m times the change of slope (0.2 degrees at Las Vegas)
//   frames as plant.hpp
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

  // `here`: of the centre of gravity, by road_at(). Friction and wind are not its business.
  Surface at(const Road& here, const Motion& motion) const;

 private:
  struct Bank {  // tan(bank) and its derivatives by the station
    double value = 0.0, slope = 0.0, bend = 0.0;
  };
  struct Line {
    double curvature_per_m = 0.0, change_per_m2 = 0.0;
  };
  Bank bank(double s_m) const;
  Line line(double s_m) const;

  double knot_m_ = kKnot_m, spacing_m_ = 1.0, height_m_ = 0.0;
  std::vector<double> tangent_;          // of the banking, at the knots
  std::vector<double> curvature_per_m_;  // at the points of the map
};

}  // namespace pitwall::plant
