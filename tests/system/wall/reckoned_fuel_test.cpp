// SPDX-License-Identifier: Apache-2.0
// The fuel that the base reckons, against the engine of the bench.
#include <gtest/gtest.h>

#include "hil/plant/engine.hpp"
#include "protocol/rules/fuel_use.hpp"

namespace pitwall {
namespace {

// The bench has the whole sheet: within a tenth of it where a race is driven.
TEST(ReckonedFuel, IsWithinATenthOfTheBenchAtSpeed) {
  const plant::Engine engine;
  const plant::Fuel fuel;
  for (double rpm = 4'300; rpm <= 6'600; rpm += 100) {
    for (double throttle = 0.65; throttle <= 1.0; throttle += 0.01) {
      const double torque_nm = plant::engine_torque_nm(engine, rpm, throttle);
      const double bench_lps =
          plant::fuel_flow_kgps(engine, fuel, rpm, torque_nm) / rules::kFuelDensity_kgpl;
      const double ours_lps = rules::fuel_flow_lps({rpm, throttle, true});
      EXPECT_NEAR(ours_lps / bench_lps, 1.0, 0.1) << rpm << " rpm, throttle " << throttle;
    }
  }
}

}  // namespace
}  // namespace pitwall
