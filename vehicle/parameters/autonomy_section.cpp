// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numbers>

#include "vehicle/parameters/car_file.hpp"
#include "vehicle/parameters/filter_section.hpp"
#include "vehicle/parameters/stop_section.hpp"

namespace pitwall::parameters {
namespace {

localization::UnitParams read_unit(yaml::StrictMap map) {
  const auto arm = map.numbers("antenna_m", 3, 3, -5.0, 5.0);
  const auto imu = map.numbers("imu_m", 3, 3, -5.0, 5.0);
  return {.antenna = {arm[0], arm[1], arm[2]},
          .baseline_yaw_rad = from_deg(map.number("baseline_yaw_deg", -180.0, 180.0)),
          .baseline_m = map.number("baseline_m", 0.2, 5.0),
          .imu = {imu[0], imu[1], imu[2]}};
}

// What the unit is, of whoever hears it; may be left out.
world::ReceiverParams read_receiver(yaml::StrictMap map) {
  world::ReceiverParams receiver;
  const std::string name = map.text_or("receiver", std::string(world::name_of(receiver.kind)));
  const auto* kind = std::ranges::find(world::kReceiverKindNames, name);
  if (kind == world::kReceiverKindNames.end())
    map.fail("receiver", "\"" + name + "\" is no kind of receiver; novatel_oem7 or vectornav");
  receiver.kind = static_cast<world::ReceiverKind>(kind - world::kReceiverKindNames.begin());
  receiver.least_delay =
      from_seconds(map.number_or("receiver_delay_s", receiver.least_delay.seconds(), 0.0, 0.05));
  return receiver;
}

planning::LineParams read_line(yaml::StrictMap map) {
  planning::LineParams line;
  line.offset_m = map.number("offset_m", -30.0, 30.0);
  line.wall_clearance_m = map.number("wall_clearance_m", 0.0, 10.0);
  line.spacing_m = map.number("spacing_m", 0.5, 5.0);
  line.speed_max_mps = map.number("speed_max_mps", 5.0, 110.0);
  line.grip_share = map.number("grip_share", 0.1, 1.0);
  line.friction = read_friction(map.map("friction"));
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

localization::Params read_localization(yaml::StrictMap map, world::Receivers& receivers) {
  localization::Params p;
  std::vector<yaml::StrictMap> units = map.maps("units");
  if (units.size() != world::kGnssUnits) map.fail("units", "one entry per GNSS unit is needed: 2");
  for (std::size_t i = 0; i < units.size(); ++i) {
    p.units[i] = read_unit(units[i]);
    receivers[i] = read_receiver(units[i]);
  }
  p.filter = read_filter(map.map("filter"));
  p.checks = read_checks(map);
  p.priorities = read_priorities(map);
  p.position_sigma_max_m = map.number("position_sigma_max_m", 0.05, 20.0);
  p.heading_sigma_max_rad = map.number("heading_sigma_max_rad", 0.005, 0.5);
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
  read_stop_plan(map.map("stop"), p);
  p.point_spacing_m = map.number("point_spacing_m", 1.0, 4.0);
  p.merge_from_m = map.number("merge_from_m", 0.5, 5.0);
  p.merge_time_s = map.number("merge_time_s", 1.0, 10.0);
  p.merge_least_m = map.number("merge_least_m", 10.0, 200.0);
  return p;
}

control::Params read_control(yaml::StrictMap map) {
  control::Params p;
  p.bicycle = read_bicycle(map.map("bicycle"));
  yaml::StrictMap lateral = map.map("lateral");
  p.drive_law = read_law(lateral, "drive_law");
  p.stop_law = read_law(lateral, "stop_law");
  p.lateral = read_lateral(lateral);
  read_stop_control(map.map("stop"), p);
  p.longitudinal = read_longitudinal(map.map("longitudinal"));
  p.gear = read_gear(map.map("gear"));
  return p;
}

}  // namespace pitwall::parameters
