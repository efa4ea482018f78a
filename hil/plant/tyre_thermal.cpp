// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/tyre_thermal.hpp"

#include <algorithm>

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

double warming_kps(const TyreThermal& thermal, double tyre_c, double friction_w, double speed_mps) {
  const TyreThermal& t = thermal;
  const double cooling_w_per_k = t.cooling_w_per_k + t.cooling_w_per_k_per_mps * speed_mps;
  return (t.slip_heat_share * friction_w - cooling_w_per_k * (tyre_c - t.ambient_c)) /
         t.heat_capacity_jpk;
}

}  // namespace pitwall::plant
