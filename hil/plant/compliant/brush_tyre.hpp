// Brush tyre model: force of one tyre from its slip.
//   in     slip as in tyre.hpp, load, friction scale
//   out    force, used share of the friction (1 if the whole patch slides), pneumatic trail
//   invariants
//          bristles of one stiffness under a parabolic pressure: with rho = slip / slip at which
//          the whole patch slides, force = mu Fz (3 rho - 3 rho^2 + rho^3) up to its maximum at
//          rho = 1; trail = trail at rest (1 - rho)^3 / (1 - rho + rho^2 / 3). Beyond, friction
//          falls from its full value towards sliding_friction. Longitudinal and lateral slip are
//          combined by their normalised sum, so that both directions share one curve
//          the slip stiffness is that of the bristles: friction does not change it, so that the
//          peak on a slippery road is at a smaller slip. With load it rises up to stiffest_load and
//          falls beyond
//          the peak slips of Tyre are those at nominal load on a road of grip 1
//   source Pacejka, Tire and Vehicle Dynamics (2012), 3.2.1 to 3.2.3 (brush model, combined slip,
//          trail) and 4.3.2, K = p1 sin(2 atan(Fz / p2)) (stiffness over load); Svendenius, Tire
//          Modeling and Friction Estimation (2007), 3 (normalised combined slip of a brush with
//          different longitudinal and lateral stiffness); Rill, Road Vehicle Dynamics (2012),
//          3.4 (force that falls to a sliding value beyond the peak)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/plant/tyre.hpp"

namespace pitwall::plant {

TyreForce brush_force(const Tyre& tyre, const Brush& brush, const TyreSlip& slip, double load_n,
                      double grip);

// Distance of the lateral force behind the middle of the patch.
double pneumatic_trail_m(const Tyre& tyre, const Brush& brush, const TyreSlip& slip, double load_n,
                         double grip);

// Force per slip at zero slip.
double brush_long_stiffness_n(const Tyre& tyre, const Brush& brush, double load_n);
double brush_lat_stiffness_n(const Tyre& tyre, const Brush& brush, double load_n);

}  // namespace pitwall::plant
