// SPDX-License-Identifier: Apache-2.0
#include "hil/scenario/perturbed.hpp"

#include <cmath>
#include <cstdint>

#include "protocol/rules/fuel_use.hpp"
#include "protocol/vocabulary/random.hpp"

namespace pitwall::plant {
namespace {

plant::Tyre stiffened(plant::Tyre tyre, double factor) {
  if (factor == 1.0) return tyre;  // asin(sin(x)) need not be x to the last bit
  tyre.peak_slip_ratio /= factor;
  tyre.peak_slip_angle_rad = std::asin(std::sin(tyre.peak_slip_angle_rad) / factor);
  return tyre;
}

// Of an own stream of the seed: what else is drawn does not change.
double drawn(double spread, std::uint64_t seed) {
  constexpr std::uint64_t kStream = 0xF7E1;
  if (spread == 0.0) return 0.0;
  return spread * (2.0 * Random{seed ^ kStream}.uniform() - 1.0);
}

}  // namespace

plant::Params plant_of(const scenario::Scenario& scenario) {
  scenario::Perturbations by = scenario.perturb;
  by.consumption *= 1.0 + drawn(by.consumption_spread, scenario.seed);
  plant::Fuel fuel = scenario.plant.fuel;
  if (!std::isnan(scenario.start.fuel_l))
    fuel.start_kg = scenario.start.fuel_l * rules::kFuelDensity_kgpl;
  by.mass_kg += fuel.start_kg - scenario.plant.fuel.start_kg;
  plant::Params p = perturbed(scenario.plant, by);
  p.fuel.start_kg = fuel.start_kg;
  return p;
}

plant::Params perturbed(const plant::Params& params, const scenario::Perturbations& by) {
  plant::Params p = params;
  const double mass_kg = params.chassis.mass_kg + by.mass_kg;
  p.chassis.yaw_inertia_kgm2 *= mass_kg / params.chassis.mass_kg;
  p.chassis.mass_kg = mass_kg;
  p.front = stiffened(p.front, by.tyre_stiffness);
  p.rear = stiffened(p.rear, by.tyre_stiffness);
  p.fuel.efficiency /= by.consumption;
  p.steering.delay_s += by.steering_delay_s;
  p.engine.throttle_delay_s += by.throttle_delay_s;
  p.brakes.delay_s += by.brake_delay_s;
  p.drivetrain.shift_delay_s += by.gear_delay_s;
  return p;
}

plant::Surface perturbed(const plant::Surface& road, const scenario::Perturbations& by) {
  plant::Surface s = road;
  s.bank_rad += by.bank_error_rad;
  s.grip *= by.friction;
  s.wind_east_mps += by.wind_mps * std::cos(by.wind_to_rad);
  s.wind_north_mps += by.wind_mps * std::sin(by.wind_to_rad);
  return s;
}

sensors::DetectionSensors detection_sensors_of(const scenario::Scenario& scenario) {
  sensors::DetectionSensors seeing = sensors::av21_detection_sensors();
  if (scenario.lidar_errors) seeing = with_detector_errors(seeing, *scenario.lidar_errors);
  return with_noise(seeing, scenario.perturb.detection_noise);
}

}  // namespace pitwall::plant
