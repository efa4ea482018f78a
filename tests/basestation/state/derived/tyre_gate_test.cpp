// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/tyre_gate.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::state {
namespace {

TEST(TyreGate, ThePapersSpinWasFarBelowIt) {
  const TyreGate gate;
  EXPECT_DOUBLE_EQ(tyre_needed_c(gate, from_mph(140)), 79.0);
  EXPECT_GT(tyre_needed_c(gate, from_mph(100)), 29.0);
}

TEST(TyreGate, IsThatOfItsRowsAndLinearBetweenThem) {
  const TyreGate gate;
  for (std::size_t i = 0; i + 1 < TyreGate::kRows; ++i) {
    const double middle_mps = (gate.speed_mps[i] + gate.speed_mps[i + 1]) / 2.0;
    const double middle_c = (gate.temperature_c[i] + gate.temperature_c[i + 1]) / 2.0;
    EXPECT_DOUBLE_EQ(tyre_needed_c(gate, gate.speed_mps[i]), gate.temperature_c[i]);
    EXPECT_NEAR(tyre_needed_c(gate, middle_mps), middle_c, 1e-9);
  }
  EXPECT_EQ(tyre_needed_c(gate, std::nexttoward(gate.speed_mps.front(), 0.0)), kNoTyreGate_c);
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

TEST(TyreGate, AnUnknownSpeedIsTheWorst) {
  const TyreGate gate;
  EXPECT_DOUBLE_EQ(tyre_needed_c(gate, kUnset), gate.temperature_c.back());
}

}  // namespace
}  // namespace pitwall::state
