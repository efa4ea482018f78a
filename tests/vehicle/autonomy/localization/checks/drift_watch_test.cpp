// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/checks/drift_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::localization {
namespace {

// A car on a circle at 60 m/s and a unit that says where it is, 30 ms late, at 20 Hz.
struct DriftRig {
  CheckParams params{};
  DriftWatch watch{};
  int ms = 0;
  double error_x_m = 0.0;
  bool refused = false;
  double stray = kUnset;

  static constexpr double kRadius_m = 220.0, kSpeed_mps = 60.0;
  static double angle(int at_ms) { return kSpeed_mps / kRadius_m * at_ms * 1e-3; }

  void tick() {
    ms += 10;
    const double a = angle(ms);
    go(watch, -kSpeed_mps * std::sin(a), kSpeed_mps * std::cos(a), Instant{ms * 1'000'000LL});
    if (ms % 50 != 0) return;
    const int at = ms - 30;
    const double x = kRadius_m * std::cos(angle(at)) + error_x_m,
                 y = kRadius_m * std::sin(angle(at));
    const Instant when{at * 1'000'000LL};
    stray = stray_m(watch, 0, x, y, when);
    if (!refused) learn(params, watch, 0, x, y, when);
  }
  void run(double seconds_long) {
    for (const int end = ms + static_cast<int>(seconds_long * 1e3); ms < end;) tick();
  }
};

TEST(DriftWatch, KnowsNothingOfAUnitThatWasNotHeard) {
  DriftWatch watch{};
  EXPECT_TRUE(std::isnan(stray_m(watch, 1, 0.0, 0.0, Instant{})));
  go(watch, 1.0, 0.0, Instant{seconds(1).ns});
  EXPECT_TRUE(std::isnan(stray_m(watch, 1, 0.0, 0.0, Instant{})));
}

TEST(DriftWatch, AUnitThatGoesWithTheCarDoesNotStray) {
  DriftRig rig;
  rig.run(20.0);
  EXPECT_LT(rig.stray, 0.02);
}

TEST(DriftWatch, AStepIsSeenAtOnceAndStaysSeenWhileItIsRefused) {
  DriftRig rig;
  rig.run(10.0);
  rig.error_x_m = 0.3;
  rig.refused = true;
  rig.run(0.05);
  EXPECT_NEAR(rig.stray, 0.3, 0.03);
  rig.run(5.0);
  EXPECT_NEAR(rig.stray, 0.3, 0.05);
}

TEST(DriftWatch, ADriftShowsWithinItsMemory) {
  DriftRig rig;
  rig.run(10.0);
  for (int i = 0; i < 300; ++i) {
    rig.error_x_m += 0.0005;  // 5 cm/s
    rig.tick();
  }
  EXPECT_GT(rig.stray, 0.08);
  EXPECT_LT(rig.stray, 0.15);
}

TEST(DriftWatch, ForgottenMeansUnknown) {
  DriftRig rig;
  rig.run(1.0);
  forget(rig.watch);
  EXPECT_TRUE(std::isnan(stray_m(rig.watch, 0, 0.0, 0.0, Instant{})));
}

}  // namespace
}  // namespace pitwall::localization
