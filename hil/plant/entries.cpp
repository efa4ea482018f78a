// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/entries.hpp"

#include <vector>

namespace pitwall::plant {
namespace {

using plant::Aero;
using plant::Brakes;
using plant::Chassis;
using plant::Drivetrain;
using plant::Engine;
using plant::Fuel;
using plant::Params;
using plant::Steering;
using plant::TyreBody;
using plant::TyreThermal;
using TyreParams = plant::Tyre;

constexpr double kDelayMax_s = 0.1;

template <auto Part, auto Field>
double& of(Params& p, std::size_t) {
  return (p.*Part).*Field;
}

template <auto Field>
double& own(Params& p, std::size_t) {
  return p.*Field;
}

template <std::size_t Throttle>
double& share(Params& p, std::size_t row) {
  return p.engine.part_throttle[row].share[Throttle];
}

double& curve_rpm(Params& p, std::size_t i) { return p.engine.full_throttle[i].rpm; }
double& curve_nm(Params& p, std::size_t i) { return p.engine.full_throttle[i].torque_nm; }
double& part_rpm(Params& p, std::size_t i) { return p.engine.part_throttle[i].rpm; }
double& gear(Params& p, std::size_t i) { return p.drivetrain.gear[i]; }

template <auto Axle, auto Field>
double& body(Params& p, std::size_t) {
  return (p.thermal.*Axle).*Field;
}

using List = std::vector<Entry>;

void add(List& to, const List& more) { to.insert(to.end(), more.begin(), more.end()); }

List chassis_rows() {
  constexpr auto c = &Params::chassis;
  return {{"chassis", "mass_kg", of<c, &Chassis::mass_kg>, 400, 2000},
          {"chassis", "yaw_inertia_kgm2", of<c, &Chassis::yaw_inertia_kgm2>, 200, 5000},
          {"chassis", "front_axle_m", of<c, &Chassis::front_axle_m>, 0.3, 3},
          {"chassis", "rear_axle_m", of<c, &Chassis::rear_axle_m>, 0.3, 3},
          {"chassis", "height_m", of<c, &Chassis::height_m>, 0.05, 1},
          {"chassis", "track_front_m", of<c, &Chassis::track_front_m>, 0.8, 2.5},
          {"chassis", "track_rear_m", of<c, &Chassis::track_rear_m>, 0.8, 2.5},
          {"chassis", "roll_stiffness_front", of<c, &Chassis::roll_stiffness_front>, 0, 1},
          {"chassis", "length_m", of<c, &Chassis::length_m>, 2, 8},
          {"chassis", "width_m", of<c, &Chassis::width_m>, 1, 3},
          {"chassis", "load_lag_s", of<c, &Chassis::load_lag_s>, 0.01, 0.5}};
}

List aero_rows() {
  constexpr auto a = &Params::aero;
  return {{"aero", "air_density_kgpm3", of<a, &Aero::air_density_kgpm3>, 0.5, 1.6},
          {"aero", "drag_area_m2", of<a, &Aero::drag_area_m2>, 0.05, 3},
          {"aero", "front_lift_area_m2", of<a, &Aero::front_lift_area_m2>, -1, 5},
          {"aero", "rear_lift_area_m2", of<a, &Aero::rear_lift_area_m2>, -1, 5},
          {"aero", "side_area_m2", of<a, &Aero::side_area_m2>, 0, 10},
          {"aero", "side_arm_m", of<a, &Aero::side_arm_m>, -1.5, 1.5}};
}

template <auto T>
List tyre_rows(std::string_view section) {
  return {{section, "radius_m", of<T, &TyreParams::radius_m>, 0.2, 0.5},
          {section, "nominal_load_n", of<T, &TyreParams::nominal_load_n>, 500, 10'000},
          {section, "mu_long", of<T, &TyreParams::mu_long>, 0.1, 3},
          {section, "mu_lat", of<T, &TyreParams::mu_lat>, 0.1, 3},
          {section, "shape", of<T, &TyreParams::shape>, 1.1, 2},
          {section, "peak_slip_ratio", of<T, &TyreParams::peak_slip_ratio>, 0.03, 0.9},
          {section, "peak_slip_angle_rad", of<T, &TyreParams::peak_slip_angle_rad>, 0.02, 0.7},
          {section, "load_sensitivity", of<T, &TyreParams::load_sensitivity>, 0, 1},
          {section, "mu_min_share", of<T, &TyreParams::mu_min_share>, 0.05, 1},
          {section, "relaxation_m", of<T, &TyreParams::relaxation_m>, 0.08, 1},
          {section, "wheel_inertia_kgm2", of<T, &TyreParams::wheel_inertia_kgm2>, 0.4, 5},
          {section, "rolling_resistance", of<T, &TyreParams::rolling_resistance>, 0, 0.1}};
}

List actuator_rows() {
  constexpr auto s = &Params::steering;
  constexpr auto b = &Params::brakes;
  return {{"steering", "ratio", of<s, &Steering::ratio>, 5, 40},
          {"steering", "delay_s", of<s, &Steering::delay_s>, 0, kDelayMax_s},
          {"steering", "lag_s", of<s, &Steering::lag_s>, 0.005, 1},
          {"steering", "rate_max_rad_per_s", of<s, &Steering::rate_max_rad_per_s>, 0.5, 50},
          {"steering", "angle_max_rad", of<s, &Steering::angle_max_rad>, 0.5, 10},
          {"steering", "quantum_rad", of<s, &Steering::quantum_rad>, 0, 0.2},
          {"brakes", "lag_s", of<b, &Brakes::lag_s>, 0.005, 1},
          {"brakes", "delay_s", of<b, &Brakes::delay_s>, 0, kDelayMax_s},
          {"brakes", "pressure_max_kpa", of<b, &Brakes::pressure_max_kpa>, 500, 20'000},
          {"brakes", "front_nm_per_kpa", of<b, &Brakes::front_nm_per_kpa>, 0, 3},
          {"brakes", "rear_nm_per_kpa", of<b, &Brakes::rear_nm_per_kpa>, 0, 3}};
}

List engine_rows() {
  constexpr auto e = &Params::engine;
  constexpr std::size_t n = plant::kEnginePoints, m = plant::kPartThrottleRows;
  static_assert(plant::kDynoThrottles.size() == 6, "a share per throttle but the full one");
  return {{"engine", "full_throttle_rpm", curve_rpm, 0, 20'000, n, Order::kRising},
          {"engine", "full_throttle_nm", curve_nm, 0, 2000, n},
          {"engine", "part_throttle_rpm", part_rpm, 0, 20'000, m, Order::kRising},
          {"engine", "share_at_30_percent", share<0>, 0, 1, m},
          {"engine", "share_at_50_percent", share<1>, 0, 1, m},
          {"engine", "share_at_65_percent", share<2>, 0, 1, m},
          {"engine", "share_at_70_percent", share<3>, 0, 1, m},
          {"engine", "share_at_80_percent", share<4>, 0, 1, m},
          {"engine", "limiter_rpm", of<e, &Engine::limiter_rpm>, 1000, 20'000},
          {"engine", "limiter_width_rpm", of<e, &Engine::limiter_width_rpm>, 10, 1000},
          {"engine", "friction_nm", of<e, &Engine::friction_nm>, 0, 200},
          {"engine", "friction_nm_per_rpm", of<e, &Engine::friction_nm_per_rpm>, 0, 0.05},
          {"engine", "inertia_kgm2", of<e, &Engine::inertia_kgm2>, 0.01, 1},
          {"engine", "idle_rpm", of<e, &Engine::idle_rpm>, 300, 5000},
          {"engine", "launch_rpm", of<e, &Engine::launch_rpm>, 500, 10'000},
          {"engine", "throttle_lag_s", of<e, &Engine::throttle_lag_s>, 0.005, 1},
          {"engine", "throttle_delay_s", of<e, &Engine::throttle_delay_s>, 0, kDelayMax_s},
          {"engine", "crank_s", of<e, &Engine::crank_s>, 0, 10}};
}

List drivetrain_rows() {
  constexpr auto f = &Params::fuel;
  constexpr auto d = &Params::drivetrain;
  return {{"fuel", "start_kg", of<f, &Fuel::start_kg>, 0.1, 90},
          {"fuel", "heating_jpkg", of<f, &Fuel::heating_jpkg>, 10e6, 60e6},
          {"fuel", "efficiency", of<f, &Fuel::efficiency>, 0.05, 0.6},
          {"drivetrain", "gear", gear, 0.3, 8, plant::kGears, Order::kFalling},
          {"drivetrain", "final_drive", of<d, &Drivetrain::final_drive>, 1, 8},
          {"drivetrain", "efficiency", of<d, &Drivetrain::efficiency>, 0.3, 1},
          {"drivetrain", "shift_s", of<d, &Drivetrain::shift_s>, 0.005, 1},
          {"drivetrain", "lockout_s", of<d, &Drivetrain::lockout_s>, 0, 2},
          {"drivetrain", "shift_delay_s", of<d, &Drivetrain::shift_delay_s>, 0, kDelayMax_s},
          {"drivetrain", "differential_nms_per_rad", of<d, &Drivetrain::differential_nms_per_rad>,
           0, 200},
          {"drivetrain", "differential_max_nm", of<d, &Drivetrain::differential_max_nm>, 1, 2000}};
}

List thermal_rows() {
  constexpr auto t = &Params::thermal;
  constexpr auto heat = &TyreBody::heat_capacity_jpk, surface = &TyreBody::surface_m2;
  constexpr auto front = &TyreThermal::front, rear = &TyreThermal::rear;
  return {{"thermal", "ambient_c", of<t, &TyreThermal::ambient_c>, -20, 60},
          {"thermal", "working_c", of<t, &TyreThermal::working_c>, 0, 150},
          {"thermal", "hot_c", of<t, &TyreThermal::hot_c>, 20, 200},
          {"thermal", "ruined_c", of<t, &TyreThermal::ruined_c>, 40, 300},
          {"thermal", "front_heat_capacity_jpk", body<front, heat>, 1000, 100'000},
          {"thermal", "front_surface_m2", body<front, surface>, 0.1, 5},
          {"thermal", "rear_heat_capacity_jpk", body<rear, heat>, 1000, 100'000},
          {"thermal", "rear_surface_m2", body<rear, surface>, 0.1, 5},
          {"thermal", "still_air_w_per_m2k", of<t, &TyreThermal::still_air_w_per_m2k>, 0, 100},
          {"thermal", "moving_air_w_per_m2k", of<t, &TyreThermal::moving_air_w_per_m2k>, 0, 50},
          {"thermal", "rubber_m2k_per_w", of<t, &TyreThermal::rubber_m2k_per_w>, 0.001, 0.2},
          {"thermal", "slip_heat_share", of<t, &TyreThermal::slip_heat_share>, 0, 1},
          {"thermal", "rolling_heat_share", of<t, &TyreThermal::rolling_heat_share>, 0, 1},
          {"thermal", "rolling_fall_per_k", of<t, &TyreThermal::rolling_fall_per_k>, 0, 0.05},
          {"thermal", "cold_grip_loss", of<t, &TyreThermal::cold_grip_loss>, 0, 0.9},
          {"thermal", "hot_grip_loss", of<t, &TyreThermal::hot_grip_loss>, 0, 0.9}};
}

List compliant_rows() {
  constexpr auto b = &Params::brush;
  constexpr auto s = &Params::suspension;
  constexpr auto c = &Params::compliance;
  constexpr auto h = &Params::hydraulics;
  List rows{{"brush", "stiffest_load", of<b, &Brush::stiffest_load>, 1.5, 10},
            {"brush", "sliding_friction", of<b, &Brush::sliding_friction>, 0.3, 1},
            {"brush", "sliding_slips", of<b, &Brush::sliding_slips>, 0.5, 20},
            {"brush", "trail_m", of<b, &Brush::trail_m>, 0, 0.1},
            {"suspension", "roll_inertia_kgm2", of<s, &Suspension::roll_inertia_kgm2>, 100, 1000},
            {"suspension", "front_nm_per_rad", of<s, &Suspension::front_nm_per_rad>, 10e3, 1e6},
            {"suspension", "rear_nm_per_rad", of<s, &Suspension::rear_nm_per_rad>, 10e3, 1e6},
            {"suspension", "front_nms_per_rad", of<s, &Suspension::front_nms_per_rad>, 200, 20e3},
            {"suspension", "rear_nms_per_rad", of<s, &Suspension::rear_nms_per_rad>, 200, 20e3},
            {"suspension", "front_centre_m", of<s, &Suspension::front_centre_m>, -0.1, 0.2},
            {"suspension", "rear_centre_m", of<s, &Suspension::rear_centre_m>, -0.1, 0.2},
            {"compliance", "rad_per_nm", of<c, &SteeringCompliance::rad_per_nm>, 0, 3e-4},
            {"compliance", "caster_trail_m", of<c, &SteeringCompliance::caster_trail_m>, 0, 0.1},
            {"compliance", "lag_s", of<c, &SteeringCompliance::lag_s>, 0.01, 0.2},
            {"hydraulics", "dead_band_kpa", of<h, &BrakeHydraulics::dead_band_kpa>, 0, 490},
            {"hydraulics", "release_lag_s", of<h, &BrakeHydraulics::release_lag_s>, 0.005, 1}};
  for (Entry& row : rows) row.only_of = Structure::kCompliantBrush;
  return rows;
}

List all_rows() {
  List all = chassis_rows();
  add(all, aero_rows());
  add(all, tyre_rows<&Params::front>("front_tyre"));
  add(all, tyre_rows<&Params::rear>("rear_tyre"));
  add(all, actuator_rows());
  add(all, engine_rows());
  add(all, drivetrain_rows());
  add(all, thermal_rows());
  add(all, compliant_rows());
  add(all,
      {{"standstill", "low_speed_mps", own<&Params::low_speed_mps>, 0.5, 10},
       {"standstill", "low_speed_damping_nspm", own<&Params::low_speed_damping_nspm>, 500, 8000}});
  return all;
}

}  // namespace

std::span<const Entry> entries() {
  static const List rows = all_rows();
  return rows;
}

const double& value_of(const plant::Params& params, const Entry& entry, std::size_t index) {
  // The accessors write and read through one function; nothing is written here.
  return entry.at(const_cast<plant::Params&>(params), index);
}

}  // namespace pitwall::plant
