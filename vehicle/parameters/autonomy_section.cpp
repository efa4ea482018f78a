// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numbers>

#include "vehicle/parameters/car_file.hpp"

namespace pitwall::parameters {
namespace {

localization::UnitParams read_unit(yaml::StrictMap map) {
  const auto arm = map.numbers("antenna_m", 3, 3, -5.0, 5.0);
  return {.antenna = {arm[0], arm[1], arm[2]},
          .baseline_yaw_rad = from_deg(map.number("baseline_yaw_deg", -180.0, 180.0))};
}

localization::TimelineParams read_timeline(yaml::StrictMap map) {
  localization::TimelineParams t;
  t.noise.gyro_rad_per_sqrt_s = map.number("gyro_rad_per_sqrt_s", 1e-5, 0.1);
  t.noise.accel_mps_per_sqrt_s = map.number("accel_mps_per_sqrt_s", 1e-3, 5.0);
  t.noise.lateral_mps_per_sqrt_s = map.number("lateral_mps_per_sqrt_s", 1e-3, 5.0);
  t.noise.gyro_bias_rad_per_s_sqrt_s = map.number("gyro_bias_rad_per_s_sqrt_s", 1e-7, 0.01);
  t.noise.position_m_per_sqrt_s = map.number("position_m_per_sqrt_s", 0.0, 1.0);
  const auto gates = map.numbers("gate_nis", 2, 2, 4.0, 100.0);
  t.gate_nis = {gates[0], gates[1]};
  t.window_s = map.number("window_s", 0.05, 0.5);
  return t;
}

planning::LineParams read_line(yaml::StrictMap map) {
  planning::LineParams line;
  line.offset_m = map.number("offset_m", -30.0, 30.0);
  line.wall_clearance_m = map.number("wall_clearance_m", 0.0, 10.0);
  line.spacing_m = map.number("spacing_m", 0.5, 5.0);
  line.speed_max_mps = map.number("speed_max_mps", 5.0, 110.0);
  line.grip_share = map.number("grip_share", 0.1, 1.0);
  yaml::StrictMap friction = map.map("friction");
  line.friction.friction = friction.number("friction", 0.3, 2.5);
  line.friction.downforce_per_m = friction.number("downforce_per_m", 0.0, 0.01);
  line.friction.drag_per_m = friction.number("drag_per_m", 0.0, 0.01);
  line.friction.accel_max_mps2 = friction.number("accel_max_mps2", 0.5, 15.0);
  line.friction.power_w_per_kg = friction.number("power_w_per_kg", 10.0, 1000.0);
  line.friction.brake_max_mps2 = friction.number("brake_max_mps2", 1.0, 30.0);
  return line;
}

control::BicycleParams read_bicycle(yaml::StrictMap map) {
  control::BicycleParams car;
  car.mass_kg = map.number("mass_kg", 300.0, 2000.0);
  car.yaw_inertia_kg_m2 = map.number("yaw_inertia_kg_m2", 200.0, 5000.0);
  car.cg_to_front_m = map.number("cg_to_front_m", 0.5, 3.0);
  car.cg_to_rear_m = map.number("cg_to_rear_m", 0.5, 3.0);
  car.cornering_front_n_per_rad = map.number("cornering_front_n_per_rad", 2e4, 1e6);
  car.cornering_rear_n_per_rad = map.number("cornering_rear_n_per_rad", 2e4, 1e6);
  return car;
}

control::LateralParams read_lateral(yaml::StrictMap map) {
  control::LateralParams lateral;
  std::vector<yaml::StrictMap> brackets = map.maps("brackets");
  if (brackets.size() != control::kSpeedBrackets)
    map.fail("brackets",
             "one entry per speed bracket is needed: " + std::to_string(control::kSpeedBrackets));
  for (std::size_t i = 0; i < brackets.size(); ++i) {
    const double from_mps = brackets[i].number("from_mps", 0.0, 110.0);
    if (from_mps != control::kBracketFrom_mps[i])
      brackets[i].fail("from_mps", "this bracket begins at " +
                                       std::to_string(control::kBracketFrom_mps[i]) + " m/s");
    const auto q = brackets[i].numbers("q", 4, 4, 0.0, 1e6);
    std::copy(q.begin(), q.end(), lateral.weights[i].state.begin());
    lateral.weights[i].steering = brackets[i].number("r", 1e-6, 1e6);
  }
  lateral.lookahead_base_m = map.number("lookahead_base_m", 0.0, 30.0);
  lateral.lookahead_per_speed_s = map.number("lookahead_per_speed_s", 0.0, 1.0);
  lateral.angle_max_rad = map.number("angle_max_rad", 0.02, 0.3);
  lateral.gain_speed_floor_mps = map.number("gain_speed_floor_mps", 1.0, 10.0);
  lateral.deviation_max_m = map.number("deviation_max_m", 1.0, 20.0);
  return lateral;
}

control::LongitudinalParams read_longitudinal(yaml::StrictMap map) {
  control::LongitudinalParams l;
  l.kp_per_mps = map.number("kp_per_mps", 0.01, 2.0);
  l.feedforward_per_mps = map.number("feedforward_per_mps", 0.0, 0.05);
  l.brake_kpa_per_command = map.number("brake_kpa_per_command", 100.0, 20000.0);
  l.speed_preview_s = map.number("speed_preview_s", 0.0, 1.0);
  l.throttle_max = map.number("throttle_max", 0.0, 1.0);
  l.throttle_rise_per_s = map.number("throttle_rise_per_s", 0.1, 20.0);
  l.throttle_fall_per_s = map.number("throttle_fall_per_s", 0.1, 100.0);
  l.brake_max_kpa = map.number("brake_max_kpa", 500.0, 9000.0);
  l.brake_rise_kpa_per_s = map.number("brake_rise_kpa_per_s", 500.0, 50000.0);
  l.brake_fall_kpa_per_s = map.number("brake_fall_kpa_per_s", 500.0, 50000.0);
  l.hold_speed_mps = map.number("hold_speed_mps", 0.1, 2.0);
  l.hold_brake_kpa = map.number("hold_brake_kpa", 100.0, 3000.0);
  return l;
}

control::GearParams read_gear(yaml::StrictMap map) {
  control::GearParams gear;
  const auto up = map.numbers("up_above_mps", control::kGears - 1, control::kGears - 1, 1.0, 110.0);
  const auto down =
      map.numbers("down_below_mps", control::kGears - 1, control::kGears - 1, 0.5, 110.0);
  std::copy(up.begin(), up.end(), gear.up_above_mps.begin());
  std::copy(down.begin(), down.end(), gear.down_below_mps.begin());
  gear.dwell_s = map.number("dwell_s", 0.2, 5.0);
  return gear;
}

}  // namespace

localization::Params read_localization(yaml::StrictMap map) {
  localization::Params p;
  std::vector<yaml::StrictMap> units = map.maps("units");
  if (units.size() != world::kGnssUnits) map.fail("units", "one entry per GNSS unit is needed: 2");
  for (std::size_t i = 0; i < units.size(); ++i) p.units[i] = read_unit(units[i]);
  p.timeline = read_timeline(map.map("timeline"));
  p.position_sigma_floor_m = map.number("position_sigma_floor_m", 0.001, 1.0);
  p.position_sigma_max_m = map.number("position_sigma_max_m", 0.05, 20.0);
  p.velocity_sigma_mps = map.number("velocity_sigma_mps", 0.01, 2.0);
  p.heading_sigma_floor_rad = map.number("heading_sigma_floor_rad", 0.0005, 0.2);
  p.heading_sigma_max_rad = map.number("heading_sigma_max_rad", 0.005, 0.5);
  p.wheel_sigma_mps = map.number("wheel_sigma_mps", 0.01, 2.0);
  p.wheel_sigma_per_speed = map.number("wheel_sigma_per_speed", 0.0, 0.1);
  p.slip_sigma_mps = map.number("slip_sigma_mps", 0.05, 5.0);
  p.slip_after_s = map.number("slip_after_s", 0.05, 5.0);
  p.cg_to_rear_m = map.number("cg_to_rear_m", 0.5, 3.0);
  p.rear_slip_rad_per_mps2 = map.number("rear_slip_rad_per_mps2", 0.0, 0.02);
  p.imu_timeout_s = map.number("imu_timeout_s", 0.02, 0.5);
  p.good_age_max_s = map.number("good_age_max_s", 0.1, 2.0);
  p.dead_reckoning_max_s = map.number("dead_reckoning_max_s", 0.5, 20.0);
  p.good_sigma_max_m = map.number("good_sigma_max_m", 0.05, 5.0);
  p.lost_sigma_max_m = map.number("lost_sigma_max_m", 0.5, 50.0);
  p.reset_after_s = map.number("reset_after_s", 0.5, 10.0);
  return p;
}

planning::Params read_planning(yaml::StrictMap map) {
  planning::Params p;
  p.line = read_line(map.map("line"));
  p.green_speed_mps = map.number("green_speed_mps", 0.0, 110.0);
  p.caution_speed_mps = map.number("caution_speed_mps", 0.0, 60.0);
  p.accel_max_mps2 = map.number("accel_max_mps2", 0.2, 10.0);
  p.decel_max_mps2 = map.number("decel_max_mps2", 0.2, 10.0);
  p.jerk_max_mps3 = map.number("jerk_max_mps3", 0.5, 30.0);
  p.speed_band_mps = map.number("speed_band_mps", 0.5, 10.0);
  p.stop_decel_max_mps2 = map.number("stop_decel_max_mps2", 1.0, 12.0);
  p.stop_jerk_max_mps3 = map.number("stop_jerk_max_mps3", 1.0, 30.0);
  p.stop_grip_share = map.number("stop_grip_share", 0.3, 0.9);
  p.point_spacing_m = map.number("point_spacing_m", 1.0, 4.0);
  p.merge_from_m = map.number("merge_from_m", 0.5, 5.0);
  p.merge_time_s = map.number("merge_time_s", 1.0, 10.0);
  p.merge_least_m = map.number("merge_least_m", 10.0, 200.0);
  return p;
}

control::Params read_control(yaml::StrictMap map) {
  control::Params p;
  p.bicycle = read_bicycle(map.map("bicycle"));
  p.lateral = read_lateral(map.map("lateral"));
  p.longitudinal = read_longitudinal(map.map("longitudinal"));
  p.gear = read_gear(map.map("gear"));
  return p;
}

}  // namespace pitwall::parameters
