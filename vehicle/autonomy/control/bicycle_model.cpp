// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/bicycle_model.hpp"

#include "protocol/vocabulary/check.hpp"

namespace pitwall::control {

ErrorMatrix error_dynamics(const BicycleParams& car, double speed_mps) {
  CHECK(speed_mps > 0.0);
  const double m = car.mass_kg, iz = car.yaw_inertia_kg_m2, v = speed_mps;
  const double cf = car.cornering_front_n_per_rad, cr = car.cornering_rear_n_per_rad;
  const double lf = car.cg_to_front_m, lr = car.cg_to_rear_m;
  const double force = cf + cr, moment = cf * lf - cr * lr, damping = cf * lf * lf + cr * lr * lr;
  ErrorMatrix a = ErrorMatrix::Zero();
  a(0, 1) = 1.0;
  a(1, 1) = -force / (m * v);
  a(1, 2) = force / m;
  a(1, 3) = -moment / (m * v);
  a(2, 3) = 1.0;
  a(3, 1) = -moment / (iz * v);
  a(3, 2) = moment / iz;
  a(3, 3) = -damping / (iz * v);
  return a;
}

ErrorVector steering_input(const BicycleParams& car) {
  return {0.0, car.cornering_front_n_per_rad / car.mass_kg, 0.0,
          car.cornering_front_n_per_rad * car.cg_to_front_m / car.yaw_inertia_kg_m2};
}

}  // namespace pitwall::control
