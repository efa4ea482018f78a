// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/tyre_gate.hpp"

#include <gtest/gtest.h>

namespace pitwall::state {
namespace {

TEST(TyreGate, ThePapersSpinWasFarBelowIt) {
  const TyreGate gate;
  EXPECT_DOUBLE_EQ(tyre_needed_c(gate, from_mph(140)), 79.0);
  EXPECT_LT(speed_allowed_mps(gate, 29.0), from_mph(100));
}

TEST(TyreGate, BothDirectionsAreOneRelation) {
  const TyreGate gate;
  for (double speed = gate.speed_mps.front(); speed < gate.speed_mps.back(); speed += 0.1) {
    EXPECT_NEAR(speed_allowed_mps(gate, tyre_needed_c(gate, speed)), speed, 1e-9);
  }
}

TEST(TyreGate, AFasterCarNeverNeedsColderTyres) {
  const TyreGate gate;
  double before = tyre_needed_c(gate, 0.0);
  for (double speed = 0.0; speed < 110.0; speed += 0.1) {
    const double needed = tyre_needed_c(gate, speed);
    EXPECT_GE(needed, before);
    before = needed;
  }
  EXPECT_DOUBLE_EQ(before, gate.temperature_c.back());
}

TEST(TyreGate, AnUnknownSpeedOrTemperatureIsTheWorst) {
  const TyreGate gate;
  EXPECT_DOUBLE_EQ(tyre_needed_c(gate, kUnset), gate.temperature_c.back());
  EXPECT_DOUBLE_EQ(speed_allowed_mps(gate, kUnset), gate.speed_mps.front());
}

}  // namespace
}  // namespace pitwall::state
