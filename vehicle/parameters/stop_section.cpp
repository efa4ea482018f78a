// SPDX-License-Identifier: Apache-2.0
#include "vehicle/parameters/stop_section.hpp"

#include <algorithm>
#include <string>

namespace pitwall::parameters {
namespace {

world::TyreGrip read_tyres(yaml::StrictMap map) {
  world::TyreGrip tyres;
  const auto rows = world::kTyreRows;
  const auto temperature_c = map.numbers("temperature_c", rows, rows, -50.0, 150.0);
  const auto share = map.numbers("share", rows, rows, 0.05, 1.0);
  std::copy(temperature_c.begin(), temperature_c.end(), tyres.temperature_c.begin());
  std::copy(share.begin(), share.end(), tyres.share.begin());
  if (!world::is_legal(tyres)) map.fail("share", "temperatures must rise and shares not fall");
  return tyres;
}

control::StopSteeringParams read_steering(yaml::StrictMap map) {
  control::StopSteeringParams s;
  s.bandwidth_rad_per_s = map.number("bandwidth_rad_per_s", 0.5, 6.0);
  s.damping = map.number("damping", 0.5, 1.5);
  s.preview_s = map.number("preview_s", 0.0, 0.5);
  s.observer_s = map.number("observer_s", 0.05, 5.0);
  s.trim_per_s = map.number("trim_per_s", 0.0, 2.0);
  s.settle_s = map.number("settle_s", 0.1, 5.0);
  s.correction_max_rad = map.number("correction_max_rad", 0.0, 0.1);
  s.gain_speed_least_mps = map.number("gain_speed_least_mps", 2.0, 20.0);
  s.hold_speed_mps = map.number("hold_speed_mps", 0.1, 5.0);
  return s;
}

control::StopSpeedParams read_speed(yaml::StrictMap map) {
  control::StopSpeedParams s;
  s.kpa_per_mps2 = map.number("kpa_per_mps2", 50.0, 1000.0);
  s.coast_mps2 = map.number("coast_mps2", 0.0, 3.0);
  s.drag_per_m = map.number("drag_per_m", 0.0, 0.01);
  s.speed_share_per_s = map.number("speed_share_per_s", 0.0, 3.0);
  s.preview_s = map.number("preview_s", 0.0, 0.5);
  s.throttle_fall_per_s = map.number("throttle_fall_per_s", 0.2, 20.0);
  s.brake_rate_kpa_per_s = map.number("brake_rate_kpa_per_s", 500.0, 20000.0);
  s.hold_rate_kpa_per_s = map.number("hold_rate_kpa_per_s", 100.0, 20000.0);
  return s;
}

}  // namespace

planning::FrictionParams read_friction(yaml::StrictMap map) {
  planning::FrictionParams f;
  f.friction = map.number("friction", 0.3, 2.5);
  f.downforce_per_m = map.number("downforce_per_m", 0.0, 0.01);
  f.drag_per_m = map.number("drag_per_m", 0.0, 0.01);
  f.accel_max_mps2 = map.number("accel_max_mps2", 0.5, 15.0);
  f.power_w_per_kg = map.number("power_w_per_kg", 10.0, 1000.0);
  f.brake_max_mps2 = map.number("brake_max_mps2", 1.0, 30.0);
  f.brake_front = map.number("brake_front", 0.3, 0.9);
  f.load_front = map.number("load_front", 0.3, 0.7);
  f.load_shift = map.number("load_shift", 0.0, 0.4);
  f.long_friction = map.number("long_friction", 0.3, 1.5);
  f.tyres = read_tyres(map.map("tyres"));
  return f;
}

void read_stop_plan(yaml::StrictMap map, planning::Params& p) {
  p.stop_path.clearance_m = map.number("clearance_m", 0.5, 10.0);
  p.stop_path.low_speed_mps = map.number("low_speed_mps", 5.0, 40.0);
  p.stop_path.stretch_max = map.number("stretch_max", 1.0, 2.0);
  p.emergency_decel_max_mps2 = map.number("emergency_decel_max_mps2", p.stop_decel_max_mps2, 15.0);
  p.emergency_jerk_max_mps3 = map.number("emergency_jerk_max_mps3", p.stop_jerk_max_mps3, 30.0);
  p.emergency_grip_share = map.number("emergency_grip_share", p.stop_grip_share, 0.95);
}

void read_stop_control(yaml::StrictMap map, control::Params& control) {
  control.stop_steering = read_steering(map.map("steering"));
  control.stop_speed = read_speed(map.map("speed"));
}

control::LateralLaw read_law(yaml::StrictMap& map, const char* key) {
  const std::string name = map.text(key);
  if (name == "paper_lqr") return control::LateralLaw::kPaperLqr;
  if (name != "feed_forward")
    map.fail(key, "\"" + name + "\" is not one of: paper_lqr, feed_forward");
  return control::LateralLaw::kFeedForward;
}

}  // namespace pitwall::parameters
