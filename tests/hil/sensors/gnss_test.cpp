// A receiver's noise has the size, the memory and the kinship that hil/sensors/README.md states.
// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/gnss.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/hil/sensors/sensor_log.hpp"

namespace pitwall::sensors {
namespace {

Params quick_wander(Params p) {  // so that a run holds many correlation times
  for (UnitParams& u : p.unit) u.noise.position.correlation_s = 1.0;
  return p;
}

std::vector<double> norths_m(const Params& p, const Log& log, int unit) {
  std::vector<double> north;
  for (const auto& s : of_unit(log.positions, unit)) north.push_back(north_m(p, s));
  return north;
}

TEST(Gnss, PositionIsOfItsSizeAndWanders) {
  const Params p = quick_wander(noisy());
  const PositionNoise& n = p.unit[0].noise.position;
  const Log log = run(p, standing_at(0, 0, 0), 1'000'000);
  const Moments m = moments(norths_m(p, log, 0));
  EXPECT_NEAR(m.sigma, n.sigma_m, 0.1 * n.sigma_m);
  EXPECT_NEAR(m.mean, 0.0, 0.2 * n.sigma_m);
  EXPECT_NEAR(m.lag_one, (1.0 - n.white_share) * std::exp(-0.05), 0.03);
  std::vector<double> height_m;
  for (const auto& s : of_unit(log.positions, 0)) height_m.push_back(s.height_m - 600.0);
  EXPECT_NEAR(moments(height_m).sigma, n.height_factor * n.sigma_m,
              0.1 * n.height_factor * n.sigma_m);
}

TEST(Gnss, UnitsSeeTheSameSky) {
  const Params p = quick_wander(noisy());
  const PositionNoise& n = p.unit[0].noise.position;
  const Log log = run(p, standing_at(0, 0, 0), 500'000);
  const double shared = (1.0 - n.white_share) * n.common_share;
  EXPECT_NEAR(correlation(norths_m(p, log, 0), norths_m(p, log, 1)), shared, 0.08);
  std::vector<double> east_0, north_0;
  for (const auto& s : of_unit(log.positions, 0))
    east_0.push_back(east_m(p, s)), north_0.push_back(north_m(p, s));
  EXPECT_NEAR(correlation(east_0, north_0), 0.0, 0.15);
  // Nothing else is shared.
  std::vector<double> v0, v1;
  for (const auto& s : of_unit(log.velocities, 0)) v0.push_back(s.vertical_mps);
  for (const auto& s : of_unit(log.velocities, 1)) v1.push_back(s.vertical_mps);
  EXPECT_NEAR(correlation(v0, v1), 0.0, 0.05);
}

TEST(Gnss, ReceiversReportAboutTheDeviationThatTheyHave) {
  const Params p = noisy();
  std::vector<double> sigma_m;
  for (const auto& s : run(p, standing_at(0, 0, 0), 300'000).positions) {
    EXPECT_NEAR(s.latitude_sigma_m, p.unit[0].noise.position.sigma_m, 0.0021);
    EXPECT_EQ(s.latitude_sigma_m, static_cast<double>(static_cast<float>(s.latitude_sigma_m)));
    EXPECT_GE(s.differential_age_s, 0.6);
    EXPECT_LT(s.differential_age_s, 1.6);
    sigma_m.push_back(s.latitude_sigma_m);
  }
  EXPECT_GT(moments(sigma_m).sigma, 0.0);
}

TEST(Gnss, VelocityIsWhite) {
  const Params p = noisy();
  std::vector<double> up_mps;
  for (const auto& s : of_unit(run(p, standing_at(0, 0, 0), 200'000).velocities, 0))
    up_mps.push_back(s.vertical_mps);
  const Moments m = moments(up_mps);
  EXPECT_NEAR(m.sigma, p.unit[0].noise.velocity.vertical_sigma_mps, 0.003);
  EXPECT_NEAR(m.lag_one, 0.0, 0.05);
}

TEST(Gnss, HeadingIsTheBetterTheLongerItsBaseline) {
  Params p = noisy();
  p.heading.period = milliseconds(10);
  for (UnitParams& u : p.unit) u.noise.heading.correlation_s = 0.2;
  const Log log = run(p, standing_at(0, 0, 0), 120'000);
  for (const int unit : {0, 1}) {
    std::vector<double> error;
    for (const auto& s : of_unit(log.headings, unit))
      error.push_back(wrap_pi(s.heading_rad - std::numbers::pi / 2.0 +
                              p.unit[static_cast<std::size_t>(unit)].baseline_yaw_rad));
    const double expected = 0.0028 / p.unit[static_cast<std::size_t>(unit)].baseline_m;
    EXPECT_NEAR(moments(error).sigma, expected, 0.05 * expected);
    EXPECT_NEAR(moments(error).lag_one, 0.5 * std::exp(-0.05), 0.05);
  }
}

}  // namespace
}  // namespace pitwall::sensors
