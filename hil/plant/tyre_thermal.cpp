// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/tyre_thermal.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::plant {

double thermal_grip(const TyreThermal& thermal, double tyre_c) {
  const TyreThermal& t = thermal;
  if (tyre_c < t.working_c) {
    const double cold = (t.working_c - tyre_c) / (t.working_c - t.ambient_c);
    return 1.0 - t.cold_grip_loss * std::clamp(cold, 0.0, 1.0);
  }
  const double hot = (tyre_c - t.hot_c) / (t.ruined_c - t.hot_c);
  return 1.0 - t.hot_grip_loss * std::clamp(hot, 0.0, 1.0);
}

double rolling_factor(const TyreThermal& thermal, double tyre_c) {
  return std::exp(-thermal.rolling_fall_per_k * (tyre_c - thermal.working_c));
}

double cooling_w_per_k(const TyreThermal& thermal, const TyreBody& body, double speed_mps) {
  constexpr double kTurbulent = 0.8;
  const double air_w_per_m2k =
      thermal.still_air_w_per_m2k + thermal.moving_air_w_per_m2k * std::pow(speed_mps, kTurbulent);
  return body.surface_m2 * air_w_per_m2k / (1.0 + thermal.rubber_m2k_per_w * air_w_per_m2k);
}

double warming_kps(const TyreThermal& thermal, const TyreBody& body, double tyre_c,
                   const TyreHeating& by) {
  const TyreThermal& t = thermal;
  const double kept_w = t.slip_heat_share * by.slip_w + t.rolling_heat_share * by.rolling_w;
  return (kept_w - cooling_w_per_k(t, body, by.speed_mps) * (tyre_c - t.ambient_c)) /
         body.heat_capacity_jpk;
}

}  // namespace pitwall::plant
