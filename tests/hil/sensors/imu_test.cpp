// An inertial unit's errors are those that hil/sensors/README.md states.
// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/imu.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/hil/sensors/sensor_log.hpp"

namespace pitwall::sensors {
namespace {

// ---- Inertial unit.
std::vector<double> yaw_rates(const Params& p, const plant::Truth& t, int duration_ms, int unit,
                              std::uint64_t seed = 1) {
  std::vector<double> rate;
  for (const auto& s : of_unit(run(p, t, duration_ms, seed).imu, unit))
    rate.push_back(s.rate_rad_per_s[2] - t.rate_rad_per_s[2]);
  return rate;
}

TEST(Imu, ImuNoiseIsWhiteAroundABias) {
  const Params p = noisy();
  const ImuNoise& n = p.unit[1].noise.imu;
  const Moments m = moments(yaw_rates(p, standing_at(0, 0, 0), 200'000, 1));
  const double expected =
      std::hypot(n.gyro_vibration_rad_per_s, n.gyro_rad_per_sqrt_s * std::sqrt(125.0));
  EXPECT_NEAR(m.sigma, expected, 0.05 * expected);
  EXPECT_NEAR(m.lag_one, 0.0, 0.04);
}

TEST(Imu, TurnOnBiasIsDrawnForARun) {
  const Params p = noisy();
  const ImuNoise& n = p.unit[0].noise.imu;
  std::vector<double> bias;
  for (std::uint64_t seed = 0; seed < 60; ++seed)
    bias.push_back(moments(yaw_rates(p, standing_at(0, 0, 0), 3000, 0, seed)).mean);
  EXPECT_NEAR(moments(bias).sigma, n.gyro_turn_on_rad_per_s, 0.3 * n.gyro_turn_on_rad_per_s);
}

// Allan deviation at tau: root of half the mean square of the difference of neighbouring means.
double allan(const std::vector<double>& x, std::size_t bin) {
  std::vector<double> mean;
  for (std::size_t i = 0; i + bin <= x.size(); i += bin) {
    double sum = 0.0;
    for (std::size_t k = i; k < i + bin; ++k) sum += x[k];
    mean.push_back(sum / static_cast<double>(bin));
  }
  double squares = 0.0;
  for (std::size_t i = 1; i < mean.size(); ++i)
    squares += (mean[i] - mean[i - 1]) * (mean[i] - mean[i - 1]);
  return std::sqrt(0.5 * squares / static_cast<double>(mean.size() - 1));
}

TEST(Imu, AllanDeviationFallsWithTheRandomWalkAndEndsInTheBias) {
  Params p = noisy();
  ImuNoise& n = p.unit[0].noise.imu;
  n.gyro_vibration_rad_per_s = 0.0;     // the sensor's own
  n.gyro_instability_rad_per_s = 1e-4;  // larger and quicker, so that a short run shows it
  n.instability_correlation_s = 20.0;
  const std::vector<double> rate = yaw_rates(p, standing_at(0, 0, 0), 600'000, 0);
  const double walk = n.gyro_rad_per_sqrt_s;
  EXPECT_NEAR(allan(rate, 12), walk / std::sqrt(12 * 0.008), 0.1 * walk / std::sqrt(12 * 0.008));
  // A Gauss-Markov bias peaks near 1.89 correlation times at 0.437 of its root of 2 sigma squared.
  const double peak = allan(rate, 4725);
  EXPECT_NEAR(peak, 0.437 * std::sqrt(2.0) * 1e-4, 0.4e-4);
}

TEST(Imu, ImuEndsAtItsRange) {
  Params p = quiet();
  plant::Truth t = standing_at(0, 0, 0);
  t.rate_rad_per_s = {0.0, 0.0, 9.0};
  t.specific_force_mps2 = {-80.0, 0.0, 60.0};
  const auto s = run(p, t, 50).imu.front();
  EXPECT_EQ(s.rate_rad_per_s[2], 2.618);
  EXPECT_EQ(s.specific_force_mps2[0], -49.0);
  EXPECT_EQ(s.specific_force_mps2[2], 49.0);
}

}  // namespace
}  // namespace pitwall::sensors
