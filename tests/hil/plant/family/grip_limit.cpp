// SPDX-License-Identifier: Apache-2.0
#include "tests/hil/plant/family/grip_limit.hpp"

#include <algorithm>
#include <cmath>

#include "hil/plant/dynamics.hpp"
#include "hil/plant/tyre.hpp"
#include "hil/plant/tyre_thermal.hpp"

namespace pitwall::plant {
namespace {

constexpr int kRounds = 8;  // of load transfer and limit, each of which makes the other

State turning(const Params& p, const Turn& turn) {
  State s = rolling(p, standing(p, 0.0, 0.0, 0.0), turn.speed_mps, 0);
  s.motion.yaw_rate_rad_per_s = turn.speed_mps * turn.curvature_per_m * std::cos(turn.bank_rad);
  return s;
}

AxleForces lateral_of(const Params& p, const Wheels& load_n, double grip) {
  const auto at = [&](std::size_t i) { return lat_limit_n(tyre_of(p, i), load_n[i], grip); };
  return {at(0) + at(1), at(2) + at(3)};
}

AxleForces longitudinal_of(const Params& p, const Wheels& load_n, double grip) {
  const auto at = [&](std::size_t i) { return long_limit_n(tyre_of(p, i), load_n[i], grip); };
  return {at(0) + at(1), at(2) + at(3)};
}

double lateral_mps2(const Chassis& c, const AxleForces& limit) {
  const double wheelbase_m = c.front_axle_m + c.rear_axle_m;
  return std::min(limit.front_n / c.rear_axle_m, limit.rear_n / c.front_axle_m) * wheelbase_m /
         c.mass_kg;
}

// Pressure up to where the first axle locks; rolling resistance brakes all the time.
double braking_mps2(const Params& p, const Wheels& load_n, const AxleForces& limit) {
  const double front = p.brakes.front_nm_per_kpa * p.brakes.front_remaining / p.front.radius_m;
  const double rear = p.brakes.rear_nm_per_kpa * p.brakes.rear_remaining / p.rear.radius_m;
  const double front_rolling_n = p.front.rolling_resistance * (load_n[0] + load_n[1]);
  const double rear_rolling_n = p.rear.rolling_resistance * (load_n[2] + load_n[3]);
  double most_kpa = p.brakes.pressure_max_kpa;
  if (front > 0.0) most_kpa = std::min(most_kpa, (limit.front_n - front_rolling_n) / front);
  if (rear > 0.0) most_kpa = std::min(most_kpa, (limit.rear_n - rear_rolling_n) / rear);
  return (most_kpa * (front + rear) + front_rolling_n + rear_rolling_n) / p.chassis.mass_kg;
}

}  // namespace

GripLimit grip_limit(const Params& params, const Turn& turn, double grip) {
  const Surface road{.bank_rad = turn.bank_rad};
  const double mass_kg = params.chassis.mass_kg;
  const double side = turn.curvature_per_m < 0.0 ? -1.0 : 1.0;
  GripLimit limit;
  State s = turning(params, turn);
  for (int i = 0; i < kRounds; ++i) {
    settle_loads(params, mass_kg, 0.0, side * limit.lateral_mps2, s.motion);
    limit.lateral = lateral_of(params, observe(params, s, road).load_n, grip);
    limit.lateral_mps2 = lateral_mps2(params.chassis, limit.lateral);
  }
  for (int i = 0; i < kRounds; ++i) {
    settle_loads(params, mass_kg, -limit.braking_mps2, 0.0, s.motion);
    const Wheels load_n = observe(params, s, road).load_n;
    limit.longitudinal = longitudinal_of(params, load_n, grip);
    limit.braking_mps2 = braking_mps2(params, load_n, limit.longitudinal);
  }
  return limit;
}

double axle_use(const Params& params, const Truth& truth, double grip) {
  std::array<double, 2> along_n{}, across_n{}, along_most_n{}, across_most_n{};
  for (std::size_t i = 0; i < world::kCorners; ++i) {
    const std::size_t axle = i / 2;
    const double scale = grip * thermal_grip(params.thermal, truth.tyre_c[i]);
    along_n[axle] += truth.force_long_n[i];
    across_n[axle] += truth.force_lat_n[i];
    along_most_n[axle] += long_limit_n(tyre_of(params, i), truth.load_n[i], scale);
    across_most_n[axle] += lat_limit_n(tyre_of(params, i), truth.load_n[i], scale);
  }
  double use = 0.0;
  for (std::size_t axle = 0; axle < 2; ++axle)
    if (along_most_n[axle] > 0.0)
      use = std::max(use, std::hypot(along_n[axle] / along_most_n[axle],
                                     across_n[axle] / across_most_n[axle]));
  return use;
}

}  // namespace pitwall::plant
