// Thermal model of a tyre and its grip: one lumped mass of tread and belt, heated by rolling and
// sliding, cooled by air.
//   in     temperature, power of sliding in the contact patch and of rolling, speed of the car
//   out    rate of the temperature, K/s; factor on the friction coefficient, 0..1; factor on the
//          rolling resistance, 1 at working_c
//   model  C dT/dt = a P_slip + b P_roll - A U(v) (T - ambient)
//          1/U = 1/(h_still + h_moving v^0.8) + R        air, and the rubber up to its surface
//          P_roll = Crr exp(-k (T - working_c)) Fz v     warmer rubber loses less
//          grip: 1 from working_c to hot_c; falls linearly by cold_grip_loss down to ambient, and
//          by hot_grip_loss up to ruined_c; constant beyond both
//   numbers
//          h_moving  turbulent plate, Nu = 0.037 Re^0.8 Pr^(1/3), 0.6 m of air at 60 C: 175 W/m2K
//                    at 65.7 m/s. R: about 4 mm of rubber at 0.25 W/m K; at speed the rubber limits
//                    the cooling, not the air. A, C from the size of tread and walls
//          a  share that a patch keeps: 0.32 by the effusivities of rubber (684) and asphalt
//             (1440), 0.55 in Farroni et al., Thermo Racing Tyre
//          b  hysteresis is 80 to 95 % of rolling loss
//          k  UN R117, annex 6: 0.8 to 1.0 % per K of the air; the tyre, some 30 K warmer, changes
//             by less, hence 1.05 to 1.43 % per K of its own temperature
//          At Las Vegas at 147 mph the four tyres settle between 80 and 100 C, 6.7 laps from 30 C.
//          Within their ranges a, k and R are chosen for that; no measurement supports it
//   beside One public run of an AV-21 (PITT-MIT-IAC betty data set, 2023-06-18): front left 31 to
//          53 C in about 10 min at up to 48 m/s. The model gives 50 C at a steady 30 m/s
//   unvalidated
//          nothing more is published. Not modelled: heat to the road (warmer than the air in the
//          sun), heat of the brakes and of the gas inside; the surface temperature, which infrared
//          sensors measure, is lower on a straight and higher in a turn than this one
//   errors none
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "hil/plant/params.hpp"

namespace pitwall::plant {

// Caveat for reports with a tyre temperature or with a verdict that depends on one.
inline constexpr std::string_view kTyreThermalCaveat =
    "tyre temperatures and the grip that follows them: unvalidated model (one public run of an "
    "AV-21 lies beside it); only its energy balance is tested";

struct TyreHeating {
  double slip_w = 0.0, rolling_w = 0.0;
  double speed_mps = 0.0;  // of the car, never negative
};

double thermal_grip(const TyreThermal& thermal, double tyre_c);

double rolling_factor(const TyreThermal& thermal, double tyre_c);

double cooling_w_per_k(const TyreThermal& thermal, const TyreBody& body, double speed_mps);

double warming_kps(const TyreThermal& thermal, const TyreBody& body, double tyre_c,
                   const TyreHeating& by);

}  // namespace pitwall::plant
