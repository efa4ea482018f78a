// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/dynamics.hpp"

#include <algorithm>
#include <cmath>

#include "hil/plant/compliant/brush_tyre.hpp"
#include "hil/plant/compliant/flexible_chassis.hpp"
#include "hil/plant/powertrain.hpp"
#include "hil/plant/tyre.hpp"
#include "hil/plant/tyre_thermal.hpp"

namespace pitwall::plant {
namespace {

constexpr std::size_t kFl = 0, kFr = 1, kRl = 2, kRr = 3;

bool is_compliant(const Params& p) { return p.structure == Structure::kCompliantBrush; }

// Sums in an order that a mirrored car shares, so that mirror symmetry is exact.
double total(const Wheels& w) { return (w[kFl] + w[kFr]) + (w[kRl] + w[kRr]); }

// The air's velocity relative to the car and the wind's across it, in the plane of the road.
struct Air {
  double along_mps, wind_across_mps;
};

Air air_of(const Motion& m, const Surface& road) {
  if (road.wind_east_mps == 0.0 && road.wind_north_mps == 0.0) return {m.vx_mps, 0.0};
  const double cos_yaw = std::cos(m.yaw_rad), sin_yaw = std::sin(m.yaw_rad);
  const double along_mps = road.wind_east_mps * cos_yaw + road.wind_north_mps * sin_yaw;
  const double across_mps = road.wind_north_mps * cos_yaw - road.wind_east_mps * sin_yaw;
  return {m.vx_mps - along_mps, across_mps * std::cos(road.bank_rad)};
}

// How the road turns the car, and the force that keeps it on the road.
void add_turning(double mass_kg, const Motion& m, const Surface& road, Forces& f) {
  const double cos_bank = std::cos(road.bank_rad), sin_bank = std::sin(road.bank_rad);
  const double cos_climb = std::cos(road.climb_rad), sin_climb = std::sin(road.climb_rad);
  f.heading_rate_rad_per_s =
      (m.yaw_rate_rad_per_s + road.climb_rate_rad_per_s * sin_bank) / (cos_climb * cos_bank);
  f.roll_rate_rad_per_s = f.heading_rate_rad_per_s * sin_climb - road.bank_rate_rad_per_s;
  f.pitch_rate_rad_per_s =
      -(f.heading_rate_rad_per_s * cos_climb * sin_bank) - road.climb_rate_rad_per_s * cos_bank;
  f.normal_n = std::max(
      0.0, mass_kg * (kGravity_mps2 * cos_climb * cos_bank + f.roll_rate_rad_per_s * m.vy_mps -
                      f.pitch_rate_rad_per_s * m.vx_mps));
}

// Quasi-static: springs and anti-roll bars enter as the share of the front axle.
LoadShift stiff_shift(const Params& p, double mass_kg, const Motion& m) {
  const Chassis& c = p.chassis;
  const double roll_nm = mass_kg * m.load_ay_mps2 * c.height_m;
  return {c.roll_stiffness_front * roll_nm / c.track_front_m,
          (1.0 - c.roll_stiffness_front) * roll_nm / c.track_rear_m};
}

// A wheel that would lift carries nothing and its neighbour the whole axle, so that the sum is
// always right.
void add_loads(const Params& p, double mass_kg, const Motion& m, const Surface& road,
               const Air& air, Forces& f) {
  const Chassis& c = p.chassis;
  const double wheelbase_m = c.front_axle_m + c.rear_axle_m;
  const double pressure = 0.5 * p.aero.air_density_kgpm3 * air.along_mps * air.along_mps;
  add_turning(mass_kg, m, road, f);
  const double down_front_n = pressure * p.aero.front_lift_area_m2;
  const double down_rear_n = pressure * p.aero.rear_lift_area_m2;
  const double sum_n = f.normal_n + down_front_n + down_rear_n;
  const double pitch_n = mass_kg * m.load_ax_mps2 * c.height_m / wheelbase_m;
  const double front_n =
      std::clamp(f.normal_n * c.rear_axle_m / wheelbase_m + down_front_n - pitch_n, 0.0, sum_n);
  const double rear_n = sum_n - front_n;
  const LoadShift shift =
      is_compliant(p) ? leaning_shift(p, mass_kg, m) : stiff_shift(p, mass_kg, m);
  const double front_shift_n = std::clamp(shift.front_n, -0.5 * front_n, 0.5 * front_n);
  const double rear_shift_n = std::clamp(shift.rear_n, -0.5 * rear_n, 0.5 * rear_n);
  f.load_n = {0.5 * front_n - front_shift_n, 0.5 * front_n + front_shift_n,
              0.5 * rear_n - rear_shift_n, 0.5 * rear_n + rear_shift_n};
}

struct Patch {               // motion of one contact patch
  double long_mps, lat_mps;  // of the hub, in the wheel's frame
  double tread_mps;          // circumferential
  double reference_mps;      // of the slips; never below either of the three, up to sqrt 2
};

struct Steered {
  double cosine, sine;
};

Patch patch_of(const Params& p, const Motion& m, std::size_t i, const Steered& steer) {
  const Chassis& c = p.chassis;
  const bool front = i < 2;
  const double half_m = 0.5 * (front ? c.track_front_m : c.track_rear_m);
  const double y_m = i % 2 == 0 ? half_m : -half_m;
  const double x_m = front ? c.front_axle_m : -c.rear_axle_m;
  const double vx_mps = m.vx_mps - m.yaw_rate_rad_per_s * y_m;
  const double vy_mps = m.vy_mps + m.yaw_rate_rad_per_s * x_m;
  const double cosine = front ? steer.cosine : 1.0, sine = front ? steer.sine : 0.0;
  Patch q{};
  q.long_mps = cosine * vx_mps + sine * vy_mps;
  q.lat_mps = cosine * vy_mps - sine * vx_mps;
  q.tread_mps = m.wheel_rad_per_s[i] * tyre_of(p, i).radius_m;
  // Root mean square of hub and tread speed, so that slips stay finite whatever turns or stands.
  q.reference_mps = std::sqrt(0.5 * (q.long_mps * q.long_mps + q.tread_mps * q.tread_mps) +
                              q.lat_mps * q.lat_mps);
  return q;
}

Steered steered(const Params& p, const Motion& m) {
  const double angle_rad = road_wheel_rad(p, m);
  return {std::cos(angle_rad), std::sin(angle_rad)};
}

struct SlipStiffness {
  double long_n, lat_n;
};

SlipStiffness stiffness_of(const Params& p, const Tyre& tyre, double load_n, double grip) {
  if (is_compliant(p))
    return {brush_long_stiffness_n(tyre, p.brush, load_n),
            brush_lat_stiffness_n(tyre, p.brush, load_n)};
  return {long_stiffness_n(tyre, load_n, grip), lat_stiffness_n(tyre, load_n, grip)};
}

void add_tyre(const Params& p, const State& discrete, const Motion& m, const Surface& road,
              std::size_t i, const Patch& q, Forces& f) {
  const Tyre& tyre = tyre_of(p, i);
  const double grip = road.grip * thermal_grip(p.thermal, discrete.tyre_c[i]);
  TyreSlip slip{m.stretch_long_m[i] / tyre.relaxation_m, m.stretch_lat_m[i] / tyre.relaxation_m};
  const double slow = q.reference_mps / p.low_speed_mps;
  if (slow < 1.0) {
    // Pacejka 8.6: damping of the standing tyre, as additional slip so that friction bounds it.
    const double fade = 1.0 - slow * slow;
    const double damping_nspm = p.low_speed_damping_nspm * fade * fade;
    const SlipStiffness stiffness = stiffness_of(p, tyre, f.load_n[i], grip);
    slip.ratio += damping_nspm * (q.tread_mps - q.long_mps) / (1.0 + stiffness.long_n);
    slip.sine -= damping_nspm * q.lat_mps / (1.0 + stiffness.lat_n);
  }
  const TyreForce force = is_compliant(p) ? brush_force(tyre, p.brush, slip, f.load_n[i], grip)
                                          : tyre_force(tyre, slip, f.load_n[i], grip);
  if (is_compliant(p) && i < 2)
    f.steering_nm -= force.lat_n * (p.compliance.caster_trail_m +
                                    pneumatic_trail_m(tyre, p.brush, slip, f.load_n[i], grip));
  f.long_n[i] = force.long_n;
  f.lat_n[i] = force.lat_n;
  f.slip_ratio[i] = slip.ratio;
  f.slip_sine[i] = slip.sine;
  f.use[i] = force.use;
  f.slip_power_w[i] =
      std::max(0.0, force.long_n * (q.tread_mps - q.long_mps) - force.lat_n * q.lat_mps);
}

double side_wind_n(const Aero& a, const Air& air) {
  return 0.5 * a.air_density_kgpm3 * a.side_area_m2 *
         std::hypot(air.along_mps, air.wind_across_mps) * air.wind_across_mps;
}

void add_body(const Params& p, const Air& air, const Steered& steer, Forces& f) {
  const Chassis& c = p.chassis;
  Wheels x_n{}, y_n{};
  for (std::size_t i = 0; i < world::kCorners; ++i) {
    const bool front = i < 2;
    x_n[i] = front ? steer.cosine * f.long_n[i] - steer.sine * f.lat_n[i] : f.long_n[i];
    y_n[i] = front ? steer.cosine * f.lat_n[i] + steer.sine * f.long_n[i] : f.lat_n[i];
  }
  const double drag_n = 0.5 * p.aero.air_density_kgpm3 * p.aero.drag_area_m2 * air.along_mps *
                        std::abs(air.along_mps);
  const double side_n = side_wind_n(p.aero, air);
  f.body_x_n = total(x_n) - drag_n;
  f.body_y_n = total(y_n) + side_n;
  f.yaw_moment_nm = c.front_axle_m * (y_n[kFl] + y_n[kFr]) - c.rear_axle_m * (y_n[kRl] + y_n[kRr]) +
                    0.5 * c.track_front_m * (x_n[kFr] - x_n[kFl]) +
                    0.5 * c.track_rear_m * (x_n[kRr] - x_n[kRl]) + p.aero.side_arm_m * side_n;
}

void add_wheel_torques(const Params& p, const State& discrete, const Motion& m, Forces& f) {
  const Drivetrain& d = p.drivetrain;
  const double front_kpa = is_compliant(p) ? pressing_kpa(p, m.brake_front_kpa) : m.brake_front_kpa;
  const double rear_kpa = is_compliant(p) ? pressing_kpa(p, m.brake_rear_kpa) : m.brake_rear_kpa;
  for (std::size_t i = 0; i < world::kCorners; ++i) {
    const Tyre& tyre = tyre_of(p, i);
    const double brake_nm =
        i < 2 ? 0.5 * p.brakes.front_remaining * p.brakes.front_nm_per_kpa * front_kpa
              : 0.5 * p.brakes.rear_remaining * p.brakes.rear_nm_per_kpa * rear_kpa;
    const double rolling_nm = tyre.rolling_resistance *
                              rolling_factor(p.thermal, discrete.tyre_c[i]) * f.load_n[i] *
                              tyre.radius_m;
    f.hold_nm[i] = brake_nm + rolling_nm;
    f.rolling_power_w[i] = rolling_nm * std::abs(m.wheel_rad_per_s[i]);
  }
  const double ratio = total_ratio(d, discrete);
  const double crank_nm = clutch_of(p, discrete, m).crank_torque_nm;
  const double axle_nm = ratio * crank_nm * (crank_nm > 0.0 ? d.efficiency : 1.0);
  const double apart_rad_per_s = m.wheel_rad_per_s[kRl] - m.wheel_rad_per_s[kRr];
  const double lock_nm = d.differential_max_nm * std::tanh(d.differential_nms_per_rad *
                                                           apart_rad_per_s / d.differential_max_nm);
  f.drive_nm[kRl] = 0.5 * axle_nm - lock_nm;
  f.drive_nm[kRr] = 0.5 * axle_nm + lock_nm;
}

// Friction against the rotation; where there is none, against what would start it.
double net_moment_nm(const Forces& f, const Motion& m, std::size_t i, double radius_m) {
  const double turning_nm = turning_moment_nm(f, i, radius_m);
  const double speed = m.wheel_rad_per_s[i];
  if (speed > 0.0) return turning_nm - f.hold_nm[i];
  if (speed < 0.0) return turning_nm + f.hold_nm[i];
  return turning_nm - std::clamp(turning_nm, -f.hold_nm[i], f.hold_nm[i]);
}

void spin_wheels(const Params& p, const State& discrete, const Motion& m, const Forces& f,
                 Motion& d) {
  Wheels moment_nm{};
  for (std::size_t i = 0; i < world::kCorners; ++i) {
    const Tyre& tyre = tyre_of(p, i);
    moment_nm[i] = discrete.locked[i] ? 0.0 : net_moment_nm(f, m, i, tyre.radius_m);
    d.wheel_rad_per_s[i] = moment_nm[i] / tyre.wheel_inertia_kgm2;
  }
  const bool coupled =
      clutch_of(p, discrete, m).engaged && !discrete.locked[kRl] && !discrete.locked[kRr];
  if (!coupled) return;
  // The engine's inertia goes with the mean of the rear wheels.
  const double ratio = total_ratio(p.drivetrain, discrete);
  const double wheel_kgm2 = p.rear.wheel_inertia_kgm2;
  const double mean = (moment_nm[kRl] + moment_nm[kRr]) /
                      (2.0 * wheel_kgm2 + p.engine.inertia_kgm2 * ratio * ratio);
  const double half_difference = 0.5 * (moment_nm[kRl] - moment_nm[kRr]) / wheel_kgm2;
  d.wheel_rad_per_s[kRl] = mean + half_difference;
  d.wheel_rad_per_s[kRr] = mean - half_difference;
}

void drive_actuators(const Params& p, const Motion& m, const SetPoints& set, Motion& d) {
  const Steering& s = p.steering;
  d.steering_motor_rad = std::clamp((set.steering_motor_rad - m.steering_motor_rad) / s.lag_s,
                                    -s.rate_max_rad_per_s, s.rate_max_rad_per_s);
  d.throttle_fraction = (set.throttle_fraction - m.throttle_fraction) / p.engine.throttle_lag_s;
  d.brake_front_kpa = (set.brake_front_kpa - m.brake_front_kpa) / p.brakes.lag_s;
  d.brake_rear_kpa = (set.brake_rear_kpa - m.brake_rear_kpa) / p.brakes.lag_s;
}

}  // namespace

double road_wheel_rad(const Params& p, const Motion& m) {
  const double rigid_rad = m.steering_motor_rad / p.steering.ratio;
  return is_compliant(p) ? rigid_rad + m.steering_flex_rad : rigid_rad;
}

void settle_loads(const Params& p, double mass_kg, double ax_mps2, double ay_mps2, Motion& m) {
  m.load_ax_mps2 = ax_mps2;
  m.load_ay_mps2 = ay_mps2;
  if (!is_compliant(p)) return;
  m.roll_rad = settled_roll_rad(p, mass_kg, ay_mps2);
  m.roll_rate_rad_per_s = 0.0;
}

MapVelocity map_velocity(const Motion& m, const Surface& road) {
  const double cos_yaw = std::cos(m.yaw_rad), sin_yaw = std::sin(m.yaw_rad);
  const double sin_bank = std::sin(road.bank_rad);
  const double cos_climb = std::cos(road.climb_rad), sin_climb = std::sin(road.climb_rad);
  const double ahead_mps = m.vx_mps * cos_climb + m.vy_mps * sin_bank * sin_climb;
  const double left_mps = m.vy_mps * std::cos(road.bank_rad);
  return {ahead_mps * cos_yaw - left_mps * sin_yaw, ahead_mps * sin_yaw + left_mps * cos_yaw,
          m.vx_mps * sin_climb - m.vy_mps * sin_bank * cos_climb};
}

Forces forces_of(const Params& params, const State& discrete, const Motion& motion,
                 const Surface& surface) {
  Forces f;
  const Air air = air_of(motion, surface);
  add_loads(params, mass_kg(params, discrete), motion, surface, air, f);
  const Steered steer = steered(params, motion);
  for (std::size_t i = 0; i < world::kCorners; ++i)
    add_tyre(params, discrete, motion, surface, i, patch_of(params, motion, i, steer), f);
  add_body(params, air, steer, f);
  add_wheel_torques(params, discrete, motion, f);
  return f;
}

Motion derivative_of(const Params& params, const State& discrete, const Motion& motion,
                     const Surface& surface, const SetPoints& set) {
  const Motion& m = motion;
  const Chassis& c = params.chassis;
  const Forces f = forces_of(params, discrete, m, surface);
  const Steered steer = steered(params, m);
  const double carried_kg = mass_kg(params, discrete);
  const double ax_mps2 = f.body_x_n / carried_kg, ay_mps2 = f.body_y_n / carried_kg;
  const MapVelocity over_ground = map_velocity(m, surface);
  Motion d;
  d.x_m = over_ground.east_mps;
  d.y_m = over_ground.north_mps;
  d.yaw_rad = f.heading_rate_rad_per_s;
  d.vx_mps =
      ax_mps2 - kGravity_mps2 * std::sin(surface.climb_rad) + m.vy_mps * m.yaw_rate_rad_per_s;
  d.vy_mps = ay_mps2 + kGravity_mps2 * std::sin(surface.bank_rad) * std::cos(surface.climb_rad) -
             m.vx_mps * m.yaw_rate_rad_per_s;
  d.yaw_rate_rad_per_s = f.yaw_moment_nm / c.yaw_inertia_kgm2;
  for (std::size_t i = 0; i < world::kCorners; ++i) {
    // Deflection of the patch: fed by slip speed, laid down again as the tyre rolls.
    const Patch q = patch_of(params, m, i, steer);
    const double per_s = q.reference_mps / tyre_of(params, i).relaxation_m;
    d.stretch_long_m[i] = q.tread_mps - q.long_mps - per_s * m.stretch_long_m[i];
    d.stretch_lat_m[i] = -q.lat_mps - per_s * m.stretch_lat_m[i];
  }
  spin_wheels(params, discrete, m, f, d);
  d.load_ax_mps2 = (ax_mps2 - m.load_ax_mps2) / c.load_lag_s;
  d.load_ay_mps2 = (ay_mps2 - m.load_ay_mps2) / c.load_lag_s;
  drive_actuators(params, m, set, d);
  if (is_compliant(params)) bend(params, carried_kg, ay_mps2, f.steering_nm, m, set, d);
  d.odometer_m = std::hypot(m.vx_mps, m.vy_mps);
  return d;
}

}  // namespace pitwall::plant
