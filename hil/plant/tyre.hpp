// Magic-formula tyre model: force of one tyre from its slip.
//   in     slip ratio (positive drives forward) and sine of the slip angle (positive pushes to the
//          left) of the contact patch, load, friction scale
//   out    force along and across the wheel plane, newton; used share of the friction, 0..1 (1 at
//          the peak and beyond)
//   source Pacejka, Tire and Vehicle Dynamics (2012), 4.3.1 (magic formula) and the similarity
//          method with normalised slip; peak at normalised slip 1
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/plant/params.hpp"

namespace pitwall::plant {

struct TyreForce {
  double long_n = 0.0, lat_n = 0.0;
  double use = 0.0;
};

struct TyreSlip {
  double ratio = 0.0, sine = 0.0;
};

TyreForce tyre_force(const Tyre& tyre, const TyreSlip& slip, double load_n, double grip);

// Force per slip at zero slip.
double long_stiffness_n(const Tyre& tyre, double load_n, double grip);
double lat_stiffness_n(const Tyre& tyre, double load_n, double grip);

// Largest force, at the peak of the curve.
double long_limit_n(const Tyre& tyre, double load_n, double grip);
double lat_limit_n(const Tyre& tyre, double load_n, double grip);

}  // namespace pitwall::plant
