// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/lqr_gains.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <string>

#include "tests/vehicle/autonomy/control/single_track.hpp"

namespace pitwall::control {
namespace {

using testing::recommended;

LqrGains lqr_gains_of(const Params& p) { return design(p.lqr_ff, p.bicycle).value(); }

// The Riccati equation, the exponential and the prediction over the delay, written again in
// lqr_gains_oracle.py with SciPy.
TEST(LqrGains, AreThoseOfSciPy) {
  const Params p = recommended();
  const LqrGains gains = lqr_gains_of(p);
  ASSERT_EQ(gains.delay_ticks, 6U);
  const std::string asked = ::testing::TempDir() + "lqr_gains.in",
                    answered = ::testing::TempDir() + "lqr_gains.out";
  {
    std::ofstream question(asked);
    const BicycleParams& b = p.bicycle;
    question << std::setprecision(17) << b.mass_kg << ' ' << b.yaw_inertia_kg_m2 << ' '
             << b.cg_to_front_m << ' ' << b.cg_to_rear_m << ' ' << b.cornering_front_n_per_rad
             << ' ' << b.cornering_rear_n_per_rad << '\n'
             << gains.delay_ticks << ' ' << p.lqr_ff.lag_s << ' ' << p.lqr_ff.tyre_share << '\n';
    for (std::size_t i = 0; i < kLqrSpeeds; ++i)
      question << kLqrSpeed_mps[i] << ' ' << p.lqr_ff.weights[i].turn << ' '
               << p.lqr_ff.weights[i].angle << '\n';
  }
  const std::string command = "/usr/bin/python3 '" PITWALL_SOURCE_DIR
                              "/tests/vehicle/autonomy/control/lqr_gains_oracle.py' < '" +
                              asked + "' > '" + answered + "'";
  ASSERT_EQ(std::system(command.c_str()), 0)  // NOLINT: a test
      << "does /usr/bin/python3 have SciPy (python3-scipy)?";
  std::ifstream answer(answered);
  constexpr double kClose = 1e-9;  // of each gain
  for (std::size_t i = 0; i < kLqrSpeeds; ++i) {
    const auto expect = [&](double ours) {
      double theirs = 0.0;
      ASSERT_TRUE(answer >> theirs);
      EXPECT_NEAR(ours, theirs, kClose * std::abs(theirs)) << kLqrSpeed_mps[i] << " m/s";
    };
    const LqrGain& gain = gains.at_speed[i];
    for (const double k : gain.error) expect(k);
    expect(gain.wheel);
    for (std::size_t j = 0; j < gains.delay_ticks; ++j) expect(gain.sent[j]);
    for (std::size_t j = gains.delay_ticks; j < kLqrDelayTicks; ++j) EXPECT_EQ(gain.sent[j], 0.0);
  }
}

TEST(LqrGains, TheWheelsFollowAsTheLagSaysAndTheRearAxleSlipsAsItsTyresSay) {
  const Params p = recommended();
  EXPECT_NEAR(lqr_gains_of(p).wheel_share, 1.0 - std::exp(-0.01 / p.lqr_ff.lag_s), 1e-15);
  EXPECT_EQ(lqr_gains_of(p).trim_per_s, p.lqr_ff.trim_per_s);
  EXPECT_EQ(lqr_gains_of(p).slip_s, p.lqr_ff.slip_s);
  // 790 * 1.724 / 2.971 / 130e3.
  EXPECT_NEAR(lqr_gains_of(p).rear_slip_rad_per_mps2, 0.0035263, 1e-6);
}

// Between two speeds no gain jumps, and at a speed of the grid it is that of the design.
TEST(LqrGains, AreInterpolatedWithoutBumps) {
  const LqrGains gains = lqr_gains_of(recommended());
  const auto numbers = [](const LqrGain& g) {
    std::vector<double> all(g.error.begin(), g.error.end());
    all.push_back(g.wheel);
    all.insert(all.end(), g.sent.begin(), g.sent.end());
    return all;
  };
  for (std::size_t i = 0; i < kLqrSpeeds; ++i)
    EXPECT_EQ(numbers(gain_at(gains, kLqrSpeed_mps[i])), numbers(gains.at_speed[i]));
  EXPECT_EQ(numbers(gain_at(gains, 0.0)), numbers(gains.at_speed.front()));
  EXPECT_EQ(numbers(gain_at(gains, 120.0)), numbers(gains.at_speed.back()));
  constexpr double kStep_mps = 0.01;
  for (std::size_t i = 1; i < kLqrSpeeds; ++i) {
    const double from = kLqrSpeed_mps[i - 1], to = kLqrSpeed_mps[i];
    const auto low = numbers(gains.at_speed[i - 1]), high = numbers(gains.at_speed[i]);
    const auto middle = numbers(gain_at(gains, 0.5 * (from + to)));
    const auto before = numbers(gain_at(gains, to - kStep_mps)),
               after = numbers(gain_at(gains, from + kStep_mps));
    for (std::size_t k = 0; k < low.size(); ++k) {
      EXPECT_NEAR(middle[k], 0.5 * (low[k] + high[k]), 1e-12);
      const double slope = (high[k] - low[k]) / (to - from);
      EXPECT_NEAR(before[k], high[k] - kStep_mps * slope, 1e-12);
      EXPECT_NEAR(after[k], low[k] + kStep_mps * slope, 1e-12);
    }
  }
}

TEST(LqrGains, AProblemNamesTheSpeedOrTheParameter) {
  const auto place = [](auto change) {
    Params p = recommended();
    change(p);
    const auto gains = design(p.lqr_ff, p.bicycle);
    return gains ? std::string("legal") : gains.error().place;
  };
  EXPECT_EQ(place([](Params&) {}), "legal");
  EXPECT_EQ(place([](Params& p) { p.lqr_ff.delay_s = 0.0; }), "lqr_ff.delay_s");
  EXPECT_EQ(place([](Params& p) { p.lqr_ff.lag_s = kUnset; }), "lqr_ff.lag_s");
  EXPECT_EQ(place([](Params& p) { p.lqr_ff.weights[3].angle = 0.0; }), "lqr_ff.weights[3].angle");
  EXPECT_EQ(place([](Params& p) { p.lqr_ff.weights[8].turn = -1.0; }), "lqr_ff.weights[8].turn");
  // Front tyres without any force: the steering moves nothing, and no regulator exists.
  EXPECT_EQ(place([](Params& p) { p.bicycle.cornering_front_n_per_rad = 0.0; }),
            "lqr_ff.weights[0].");
}

}  // namespace
}  // namespace pitwall::control
