// Force of one brush tyre from its slip.
//   in     slip as of tyre.hpp, load, friction scale
//   out    force, share of the friction in use (1 where the whole patch slides), pneumatic trail
//   invariants
//          bristles of one stiffness under a parabolic pressure: with rho the slip over that at
//          which the whole patch slides, force = mu Fz (3 rho - 3 rho^2 + rho^3) up to rho = 1, its
//          greatest; trail = trail at rest (1 - rho)^3 / (1 - rho + rho^2 / 3). Beyond, friction
//          falls from the whole towards sliding_friction. Slips along and across are combined by
//          their normalised sum, so both directions share one curve
//          slip stiffness belongs to the bristles: friction does not change it, so that a slippery
//          road has its peak at less slip. Over load it rises to stiffest_load and falls beyond
//          Tyre's peak slips are those at nominal load on a road of grip 1
//   source Pacejka, Tire and Vehicle Dynamics (2012), 3.2.1 to 3.2.3 (brush model, combined slip,
//          trail) and 4.3.2, K = p1 sin(2 atan(Fz / p2)) (stiffness over load); Svendenius, Tire
//          Modeling and Friction Estimation (2007), 3 (normalised combined slip of a brush with
//          unlike stiffness along and across); Rill, Road Vehicle Dynamics (2012), 3.4 (force that
//          falls to a sliding value beyond the peak)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/plant/tyre.hpp"

namespace pitwall::plant {

TyreForce brush_force(const Tyre& tyre, const Brush& brush, const TyreSlip& slip, double load_n,
                      double grip);

// The lateral force acts so far behind the middle of the patch.
double pneumatic_trail_m(const Tyre& tyre, const Brush& brush, const TyreSlip& slip, double load_n,
                         double grip);

// Force per slip at zero slip.
double brush_long_stiffness_n(const Tyre& tyre, const Brush& brush, double load_n);
double brush_lat_stiffness_n(const Tyre& tyre, const Brush& brush, double load_n);

}  // namespace pitwall::plant
