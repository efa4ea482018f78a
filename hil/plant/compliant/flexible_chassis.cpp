// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/compliant/flexible_chassis.hpp"

#include <algorithm>

namespace pitwall::plant {
namespace {

// Centre of gravity above the roll axis.
double roll_arm_m(const Params& p) {
  const Chassis& c = p.chassis;
  const Suspension& s = p.suspension;
  return c.height_m - (s.front_centre_m * c.rear_axle_m + s.rear_centre_m * c.front_axle_m) /
                          (c.front_axle_m + c.rear_axle_m);
}

}  // namespace

LoadShift leaning_shift(const Params& p, double mass_kg, const Motion& m) {
  const Chassis& c = p.chassis;
  const Suspension& s = p.suspension;
  const double side_n = mass_kg * m.load_ay_mps2 / (c.front_axle_m + c.rear_axle_m);
  const double front_nm = s.front_nm_per_rad * m.roll_rad +
                          s.front_nms_per_rad * m.roll_rate_rad_per_s +
                          side_n * c.rear_axle_m * s.front_centre_m;
  const double rear_nm = s.rear_nm_per_rad * m.roll_rad +
                         s.rear_nms_per_rad * m.roll_rate_rad_per_s +
                         side_n * c.front_axle_m * s.rear_centre_m;
  return {front_nm / c.track_front_m, rear_nm / c.track_rear_m};
}

double settled_roll_rad(const Params& p, double mass_kg, double ay_mps2) {
  const Suspension& s = p.suspension;
  return mass_kg * roll_arm_m(p) * ay_mps2 / (s.front_nm_per_rad + s.rear_nm_per_rad);
}

double pressing_kpa(const Params& p, double pressure_kpa) {
  return std::max(0.0, pressure_kpa - p.hydraulics.dead_band_kpa);
}

void bend(const Params& p, double mass_kg, double ay_mps2, double steering_nm, const Motion& m,
          const SetPoints& set, Motion& d) {
  const Suspension& s = p.suspension;
  d.roll_rad = m.roll_rate_rad_per_s;
  d.roll_rate_rad_per_s =
      (mass_kg * roll_arm_m(p) * ay_mps2 - (s.front_nm_per_rad + s.rear_nm_per_rad) * m.roll_rad -
       (s.front_nms_per_rad + s.rear_nms_per_rad) * m.roll_rate_rad_per_s) /
      s.roll_inertia_kgm2;
  d.steering_flex_rad =
      (p.compliance.rad_per_nm * steering_nm - m.steering_flex_rad) / p.compliance.lag_s;
  const double front_kpa = set.brake_front_kpa - m.brake_front_kpa;
  const double rear_kpa = set.brake_rear_kpa - m.brake_rear_kpa;
  if (front_kpa < 0.0) d.brake_front_kpa = front_kpa / p.hydraulics.release_lag_s;
  if (rear_kpa < 0.0) d.brake_rear_kpa = rear_kpa / p.hydraulics.release_lag_s;
}

}  // namespace pitwall::plant
