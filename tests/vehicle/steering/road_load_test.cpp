// SPDX-License-Identifier: Apache-2.0
#include "vehicle/steering/road_load.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "protocol/vocabulary/random.hpp"

namespace pitwall::steering {
namespace {

// A car on a level circle: the road's force is what gravity leaves of the acceleration, seen along
// the road's own directions.
TEST(RoadLoad, IsTheForceOfTheRoadOnALevelCircle) {
  Random random{71};
  for (int i = 0; i < 1000; ++i) {
    const double v = random.between(0.0, 80.0), k = random.between(-0.01, 0.01),
                 bank = random.between(-0.4, 0.4), downforce = random.between(0.0, 0.002);
    const double left = v * v * k, up = kGravity_mps2;  // per mass
    const RoadLoad at{v, k, bank};
    const double across = left * std::cos(bank) - up * std::sin(bank);
    const double normal = left * std::sin(bank) + up * std::cos(bank);
    EXPECT_NEAR(lateral_demand_mps2(at), across, 1e-12);
    EXPECT_NEAR(normal_load_mps2(at, downforce), normal + downforce * v * v, 1e-12);
    EXPECT_NEAR(std::hypot(lateral_demand_mps2(at), normal_load_mps2(at, 0.0)),
                std::hypot(left, up), 1e-9);
  }
}

TEST(RoadLoad, GravityTurnsTheCarAtTheNeutralSpeed) {
  const double phi = from_deg(20.0), k = 1.0 / 220.0;
  const double v = std::sqrt(kGravity_mps2 * std::tan(phi) / k);
  EXPECT_NEAR(lateral_demand_mps2({v, k, phi}), 0.0, 1e-12);
  EXPECT_LT(lateral_demand_mps2({0.0, k, phi}), 0.0);  // standing: the tyres hold it up the bank
}

}  // namespace
}  // namespace pitwall::steering
