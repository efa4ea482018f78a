// SPDX-License-Identifier: Apache-2.0
#include "tests/hil/plant/family/car_family.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/random.hpp"
#include "protocol/vocabulary/units.hpp"
#include "tests/hil/plant/family/grip_limit.hpp"
#include "tests/hil/plant/family/steady_turn.hpp"

namespace pitwall::plant {
namespace {

CarTraits drawn_traits(std::uint64_t seed, std::uint64_t number) {
  CarTraits traits;
  std::uint64_t stream = 0;
  const auto next_stream = [&] {
    return Random{mix_bits(mix_bits(seed) + number) ^ mix_bits(++stream)};
  };
  for (const TraitRange& range : kFamilyRanges)
    traits.*range.trait = next_stream().between(range.low, range.high);
  if (next_stream().one_in(2)) traits.structure = Structure::kCompliantBrush;
  return traits;
}

std::string name_of(Structure structure) {
  for (const NamedStructure& one : kStructures)
    if (one.structure == structure) return std::string(one.name);
  CHECK(false);
}

double wheelbase_m(const Params& p) { return p.chassis.front_axle_m + p.chassis.rear_axle_m; }

double friction_of(const Params& p) { return grip_limit(p, {}).lateral_mps2 / kGravity_mps2; }

void set_body(const CarTraits& t, Params& p) {
  Chassis& c = p.chassis;
  const double longer = t.wheelbase_m / wheelbase_m(p);
  c.yaw_inertia_kgm2 *= t.mass_kg / c.mass_kg * longer * longer;
  c.length_m += t.wheelbase_m - wheelbase_m(p);
  c.front_axle_m *= longer;
  c.rear_axle_m *= longer;
  c.mass_kg = t.mass_kg;
}

void set_actuators(const CarTraits& t, Params& p) {
  p.steering.delay_s = t.steering_delay_s;
  p.brakes.delay_s = t.brake_delay_s;
  p.engine.throttle_delay_s = t.throttle_delay_s;
  const double nm_per_kpa = p.brakes.front_nm_per_kpa + p.brakes.rear_nm_per_kpa;
  p.brakes.front_nm_per_kpa = nm_per_kpa * t.brake_front_share;
  p.brakes.rear_nm_per_kpa = nm_per_kpa * (1.0 - t.brake_front_share);
  p.drivetrain.differential_nms_per_rad = t.differential_nms_per_rad;
}

void scale_friction(Tyre& tyre, double factor) {
  tyre.mu_long *= factor;
  tyre.mu_lat *= factor;
  tyre.peak_slip_ratio *= factor;
  tyre.peak_slip_angle_rad = std::asin(std::sin(tyre.peak_slip_angle_rad) * factor);
}

// Load transfer depends on friction, so this is not done in one step.
void set_friction(double friction, Params& p) {
  constexpr int kRounds = 8;
  for (int i = 0; i < kRounds; ++i) {
    const double factor = friction / friction_of(p);
    scale_friction(p.front, factor);
    scale_friction(p.rear, factor);
  }
}

// Steering compliance makes so much understeer: compliance times trail times the mass on the front
// axle (Pacejka 1.3.3).
void set_compliance(double rad_per_mps2, Params& p) {
  const Chassis& c = p.chassis;
  const double front_kg = c.mass_kg * c.rear_axle_m / wheelbase_m(p);
  const double load_n = 0.5 * front_kg * kGravity_mps2;
  const double trail_m = p.brush.trail_m * std::sqrt(load_n / p.front.nominal_load_n);
  p.compliance.rad_per_nm = rad_per_mps2 / (front_kg * (trail_m + p.compliance.caster_trail_m));
}

// Understeer is all but proportional to the slip that a force takes: the secant method.
void set_understeer(double rad_per_mps2, Params& p) {
  constexpr int kRounds = 6;
  constexpr double kClose = 1e-7;  // rad per m/s2
  const auto off = [&](double sine) {
    p.front.peak_slip_angle_rad = std::asin(sine);
    return understeer_of(p) - rad_per_mps2;
  };
  double before = std::sin(p.front.peak_slip_angle_rad), now = 1.1 * before;
  double off_before = off(before), off_now = off(now);
  for (int i = 0; i < kRounds && std::abs(off_now) > kClose; ++i) {
    const double next = now - off_now * (now - before) / (off_now - off_before);
    before = now, off_before = off_now;
    now = next, off_now = off(now);
  }
}

}  // namespace

CarTraits traits_of(const Params& p) {
  const Brakes& b = p.brakes;
  return {.friction = friction_of(p),
          .understeer_rad_per_mps2 = understeer_of(p),
          .mass_kg = p.chassis.mass_kg,
          .wheelbase_m = wheelbase_m(p),
          .steering_delay_s = p.steering.delay_s,
          .brake_delay_s = b.delay_s,
          .throttle_delay_s = p.engine.throttle_delay_s,
          .brake_front_share = b.front_nm_per_kpa / (b.front_nm_per_kpa + b.rear_nm_per_kpa),
          .relaxation_m = p.front.relaxation_m,
          .differential_nms_per_rad = p.drivetrain.differential_nms_per_rad,
          .structure = p.structure};
}

FamilyCar drawn_car(std::uint64_t seed, std::uint64_t number) {
  FamilyCar car{.name = "car " + std::to_string(seed) + "." + std::to_string(number),
                .params = {},
                .traits = drawn_traits(seed, number)};
  car.params.structure = car.traits.structure;
  if (car.traits.structure == Structure::kCompliantBrush)
    for (Tyre* tyre : {&car.params.front, &car.params.rear}) tyre->mu_long = tyre->mu_lat;
  set_body(car.traits, car.params);
  set_actuators(car.traits, car.params);
  car.params.front.relaxation_m = car.params.rear.relaxation_m = car.traits.relaxation_m;
  set_friction(car.traits.friction, car.params);
  if (car.traits.structure == Structure::kCompliantBrush)
    set_compliance(0.5 * car.traits.understeer_rad_per_mps2, car.params);
  set_understeer(car.traits.understeer_rad_per_mps2, car.params);
  return car;
}

std::vector<FamilyCar> car_family(std::span<const PlantFile> files, std::uint64_t seed,
                                  std::size_t count) {
  std::vector<FamilyCar> family;
  for (std::size_t i = 0; i < count; ++i)
    family.push_back(i < files.size() ? FamilyCar{.name = files[i].name,
                                                  .params = files[i].params,
                                                  .traits = traits_of(files[i].params)}
                                      : drawn_car(seed, i));
  return family;
}

std::string to_string(const FamilyCar& car) {
  const CarTraits& t = car.traits;
  constexpr double kMilli = 1e3, kPercent = 100.0;
  char line[300];
  std::snprintf(line, sizeof line,
                "%s: %s, friction %.3f, understeer %.2f mrad/(m/s2), %.0f kg, wheelbase %.3f m, "
                "delays steering %.0f brake %.0f throttle %.0f ms, brakes %.0f %% front, "
                "relaxation %.2f m, differential %.0f N m s/rad",
                car.name.c_str(), name_of(t.structure).c_str(), t.friction,
                kMilli * t.understeer_rad_per_mps2, t.mass_kg, t.wheelbase_m,
                kMilli * t.steering_delay_s, kMilli * t.brake_delay_s, kMilli * t.throttle_delay_s,
                kPercent * t.brake_front_share, t.relaxation_m, t.differential_nms_per_rad);
  return line;
}

}  // namespace pitwall::plant
