// The limits are those that the plant itself reaches: it brakes as hard as stated and no harder,
// turns as hard as stated and no harder; a car at the limit uses all of its ellipse.
// SPDX-License-Identifier: Apache-2.0
#include "tests/hil/plant/family/grip_limit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/units.hpp"
#include "tests/hil/plant/family/car_family.hpp"
#include "tests/hil/plant/step.hpp"

namespace pitwall::plant {
namespace {

std::vector<FamilyCar> cars() {
  const PlantFile av21{.name = "av21", .params = {}, .spread = {}};
  return car_family({&av21, 1}, 3, 8);
}

// Specific force along the car, less that of the air: pressure up slowly until a wheel locks.
double hardest_braking_mps2(Params p, double speed_mps) {
  p.aero.drag_area_m2 = 0.0;
  State s = rolling(p, standing(p, 0.0, 0.0, 0.0), speed_mps, 0);
  double hardest = 0.0;
  for (double kpa = 0.0; kpa < p.brakes.pressure_max_kpa; kpa += 0.5) {
    s = step(p, s, {.brake_kpa = kpa}, {}, kStep_s);
    s.motion.vx_mps = speed_mps;
    if (std::any_of(s.locked.begin(), s.locked.end(), [](bool held) { return held; })) break;
    hardest = std::max(hardest, -observe(p, s, {}).specific_force_mps2[0]);
  }
  return hardest;
}

TEST(GripLimit, IsTheHardestBraking) {
  for (const FamilyCar& car : cars())
    for (const double speed_mps : {20.0, 45.0}) {
      const double stated = grip_limit(car.params, {.speed_mps = speed_mps}).braking_mps2;
      EXPECT_NEAR(hardest_braking_mps2(car.params, speed_mps), stated, 0.03 * stated)
          << to_string(car) << " at " << speed_mps;
    }
}

struct Hardest {
  double lateral_mps2 = 0.0, use = 0.0;
};

// Angle up slowly, speed kept.
Hardest hardest_turn(Params p, double speed_mps) {
  p.steering.angle_max_rad = 10.0;
  p.drivetrain.differential_nms_per_rad = 0.0;
  State s = rolling(p, standing(p, 0.0, 0.0, 0.0), speed_mps, 0);
  Hardest hardest;
  for (int i = 0; i < 12'000; ++i) {
    s = step(p, s, {.steering_motor_rad = 5e-4 * i}, {}, kStep_s);
    s.motion.vx_mps = speed_mps;
    const Truth t = observe(p, s, {});
    hardest.lateral_mps2 = std::max(hardest.lateral_mps2, t.specific_force_mps2[1]);
    hardest.use = std::max(hardest.use, axle_use(p, t));
    if (std::abs(s.motion.vy_mps) > 0.5 * speed_mps) break;
  }
  return hardest;
}

TEST(GripLimit, IsTheHardestTurn) {
  for (const FamilyCar& car : cars())
    for (const double speed_mps : {25.0, 45.0}) {
      const double stated = grip_limit(car.params, {.speed_mps = speed_mps}).lateral_mps2;
      const Hardest is = hardest_turn(car.params, speed_mps);
      EXPECT_NEAR(is.lateral_mps2, stated, 0.04 * stated) << to_string(car) << " at " << speed_mps;
      EXPECT_NEAR(is.use, 1.0, 0.04) << to_string(car) << " at " << speed_mps;
    }
}

TEST(GripLimit, GrowsWithSpeedGripAndBanking) {
  const Params p;
  const GripLimit slow = grip_limit(p, {}), fast = grip_limit(p, {.speed_mps = 60.0});
  EXPECT_GT(fast.lateral_mps2, slow.lateral_mps2);
  EXPECT_GT(fast.braking_mps2, slow.braking_mps2);
  const GripLimit wet = grip_limit(p, {}, 0.5);
  EXPECT_LT(wet.lateral_mps2, 0.55 * slow.lateral_mps2);
  const Turn flat{.speed_mps = 60.0, .curvature_per_m = 1.0 / 220.0};
  Turn banked = flat;
  banked.bank_rad = 0.35;
  EXPECT_GT(grip_limit(p, banked).lateral_mps2, grip_limit(p, flat).lateral_mps2);
  const Turn right{.speed_mps = 60.0, .curvature_per_m = -1.0 / 220.0, .bank_rad = -0.35};
  EXPECT_EQ(grip_limit(p, right).lateral_mps2, grip_limit(p, banked).lateral_mps2);
}

TEST(AxleUse, IsTheShareOfTheEllipse) {
  const Params p;
  Truth t = observe(p, standing(p, 0.0, 0.0, 0.0), {});
  EXPECT_EQ(axle_use(p, t), 0.0);
  // A force of 3 : 4 within an ellipse of the loads at rest.
  const Wheels load_n = t.load_n;
  const double half = 0.5;
  double along_n = 0.0, across_n = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    along_n += p.front.mu_long * load_n[i], across_n += p.front.mu_lat * load_n[i];
  }
  const double share = 1.0 - p.front.load_sensitivity * (load_n[0] - p.front.nominal_load_n) /
                                 p.front.nominal_load_n;
  t.force_long_n[0] = t.force_long_n[1] = -half * 0.3 * share * along_n;
  t.force_lat_n[0] = t.force_lat_n[1] = half * 0.4 * share * across_n;
  EXPECT_NEAR(axle_use(p, t), 0.5, 1e-9);
  EXPECT_NEAR(axle_use(p, t, 0.5), 1.0, 1e-9);
}

}  // namespace
}  // namespace pitwall::plant
