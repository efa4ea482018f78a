// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/checks/trust.hpp"

#include <gtest/gtest.h>

namespace pitwall::localization {
namespace {

// A stream at 20 Hz.
struct TrustRig {
  CheckParams params{};
  Trust trust{};
  Instant now{seconds(5).ns};
  bool alone = false;

  bool good() {
    step();
    return trust.admit(params, alone, now);
  }
  void bad() {
    step();
    trust.refuse(params);
  }
  void step() {
    now += milliseconds(50);
    trust.receive(params.rate_window_s, now);
  }
};

TEST(Trust, IsThereFromTheStart) {
  TrustRig rig;
  EXPECT_TRUE(rig.good());
}

TEST(Trust, SurvivesASingleRefusal) {
  TrustRig rig;
  ASSERT_TRUE(rig.good());
  for (int i = 0; i < 20; ++i) {
    rig.bad();
    rig.bad();
    EXPECT_TRUE(rig.good()) << i;
  }
}

TEST(Trust, IsLostByRefusalsInARowAndComesBackAfterAWhileOfConsistency) {
  for (const bool alone : {false, true}) {
    TrustRig rig;
    rig.alone = alone;
    ASSERT_TRUE(rig.good());
    for (int i = 0; i < 3; ++i) rig.bad();
    const Instant first = rig.now + milliseconds(50);
    int waited = 0;
    while (!rig.good() && waited < 1000) ++waited;
    const double after_s = alone ? rig.params.readmit_alone_after_s : rig.params.readmit_after_s;
    EXPECT_NEAR((rig.now - first).seconds(), after_s, 0.051) << alone;
    EXPECT_GE((rig.now - first).seconds(), after_s) << alone;
  }
}

TEST(Trust, EveryRefusalBeginsTheWhileAnew) {
  TrustRig rig;
  for (int i = 0; i < 3; ++i) rig.bad();
  for (int round = 0; round < 5; ++round) {
    for (int i = 0; i < 15; ++i) EXPECT_FALSE(rig.good());
    rig.bad();
  }
}

TEST(Trust, ALongSilenceEndsIt) {
  TrustRig rig;
  ASSERT_TRUE(rig.good());
  rig.now += milliseconds(800);
  EXPECT_TRUE(rig.good()) << "a short one does not";
  rig.now += seconds(2);
  EXPECT_FALSE(rig.good());
}

}  // namespace
}  // namespace pitwall::localization
