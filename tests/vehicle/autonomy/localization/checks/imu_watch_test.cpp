// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/checks/imu_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::localization {
namespace {

constexpr std::size_t kRateZ = 2, kForceX = 3, kForceY = 4;

// Two units at 125 Hz, a receiver's course at 20 Hz and 35 ms late, in a steady turn.
struct ImuRig {
  CheckParams params{};
  ImuWatch watch{};
  ImuReference reference{.speed_mps = 60.0, .accel_mps2 = 0.0};
  std::array<ImuAxes, 2> error{};
  double yaw_rate = 0.25;
  bool has_course = true;
  std::array<bool, 2> silent{};
  int ms = 0;

  Instant now() const { return Instant{1'000'000'000LL + ms * 1'000'000LL}; }

  void tick() {
    for (const int end = ms + 10; ms < end;) {
      ++ms;
      if (ms % 8 != 0) continue;
      for (std::uint8_t unit = 0; unit < 2; ++unit) {
        if (silent[unit]) continue;
        world::ImuSample s{.unit = unit, .at = now()};
        s.rate_rad_per_s = {error[unit][0], error[unit][1], yaw_rate + error[unit][kRateZ]};
        s.specific_force_mps2 = {error[unit][kForceX],
                                 reference.speed_mps * yaw_rate + error[unit][kForceY],
                                 9.8 + error[unit][5]};
        note(watch, s);
      }
    }
    if (has_course && ms % 50 == 0) {
      const int at = ms - 35;
      note_course(watch, 0, now() - milliseconds(35), wrap_pi(yaw_rate * at * 1e-3));
    }
    watch_imu(params, watch, reference, now());
  }
  void run(double for_s) {
    for (int i = 0; i < static_cast<int>(for_s * 100); ++i) tick();
  }
  // Time until one unit is found faulty.
  double faulty_after_s() {
    for (int i = 0; i < 300; ++i) {
      tick();
      if (watch.faulty) return 0.01 * (i + 1);
    }
    return kUnset;
  }
};

TEST(ImuWatch, TwoThatAgreeAreNotApart) {
  ImuRig rig;
  rig.error[1][kRateZ] = 0.004;  // an ordinary bias
  for (int i = 0; i < 1000; ++i) {
    rig.tick();
    ASSERT_FALSE(rig.watch.apart);
    ASSERT_FALSE(rig.watch.faulty);
  }
  EXPECT_NEAR(rig.watch.offset[kRateZ], 0.004, 0.001);
}

// For each unit, sign and axis that has a reference: the faulty unit is found within 200 ms, and
// exchanging the units exchanges the result.
TEST(ImuWatch, WhoLiesIsBlamedInTime) {
  for (const std::size_t faulty_unit : {0U, 1U}) {
    for (const double sign : {-1.0, 1.0}) {
      for (const auto& [axis, size] :
           {std::pair{kRateZ, 0.05}, {kRateZ, 0.5}, {kForceX, 3.0}, {kForceY, 3.0}}) {
        ImuRig rig;
        rig.run(5.0);
        rig.error[faulty_unit][axis] = sign * size;
        EXPECT_LE(rig.faulty_after_s(), 0.20)
            << faulty_unit << " axis " << axis << " " << sign * size;
        EXPECT_EQ(rig.watch.faulty, faulty_unit) << axis << " " << sign * size;
      }
    }
  }
}

TEST(ImuWatch, TheBlameEndsAfterAWhileTogether) {
  ImuRig rig;
  rig.run(3.0);
  rig.error[0][kRateZ] = 0.1;
  rig.run(0.5);
  ASSERT_EQ(rig.watch.faulty, 0U);
  rig.run(20.0);
  ASSERT_EQ(rig.watch.faulty, 0U) << "it is not learned away";
  rig.error[0][kRateZ] = 0.0;
  rig.run(0.5);
  EXPECT_EQ(rig.watch.faulty, 0U);
  rig.run(rig.params.readmit_after_s);
  EXPECT_FALSE(rig.watch.faulty);
}

TEST(ImuWatch, WithoutAWitnessNobodyIsBlamed) {
  ImuRig rig;
  rig.has_course = false;
  rig.run(3.0);
  rig.error[0][kRateZ] = 0.1;
  EXPECT_TRUE(std::isnan(rig.faulty_after_s()));
  EXPECT_TRUE(rig.watch.apart) << "but it is seen";
}

TEST(ImuWatch, AtRestAUnitThatTurnsIsBlamed) {
  ImuRig rig;
  rig.yaw_rate = 0.0;
  rig.has_course = false;
  rig.reference = {.speed_mps = 0.0, .accel_mps2 = 0.0, .stands = true};
  rig.run(3.0);
  rig.error[1][kRateZ] = -0.1;
  rig.faulty_after_s();
  EXPECT_EQ(rig.watch.faulty, 1U);
}

TEST(ImuWatch, OneThatIsSilentIsNotComparedWith) {
  ImuRig rig;
  rig.run(3.0);
  rig.silent[1] = true;
  rig.run(0.2);
  rig.error[0][kRateZ] = 0.3;
  rig.run(1.0);
  EXPECT_FALSE(rig.watch.apart);
  EXPECT_FALSE(rig.watch.faulty);
}

TEST(ImuWatch, EnteringATurnBlamesNobody) {
  ImuRig rig;
  rig.yaw_rate = 0.0;
  rig.run(3.0);
  for (int i = 0; i < 200; ++i) {
    rig.yaw_rate = std::min(0.3, rig.yaw_rate + 0.005);
    rig.tick();
    ASSERT_FALSE(rig.watch.apart);
  }
}

}  // namespace
}  // namespace pitwall::localization
