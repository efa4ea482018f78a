// The fit against drives whose numbers are known, made by a law that is not the fit's own model.
// SPDX-License-Identifier: Apache-2.0
#include "tests/hil/plant/lap_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hil/sensors/noise.hpp"
#include "tests/hil/plant/drive_period.hpp"

namespace pitwall::plant {
namespace {

constexpr double kWheelbase_m = 2.971;

double steered_rad(double t_s) {
  return 0.05 * std::sin(0.35 * t_s) + 0.04 * std::sin(0.13 * t_s + 1.0);
}
double speed_at(double t_s) { return 18.0 + 12.0 * std::sin(0.05 * t_s); }

// The steady turn at every instant: exact where steering is slow.
std::vector<DriveSample> steady_drive(const SteeringFit& truth, std::size_t count,
                                      double noise_rad_per_s = 0.0) {
  std::vector<DriveSample> samples;
  sensors::Noise noise(3, 1);
  for (std::size_t i = 0; i < count; ++i) {
    const double t_s = kPeriod_s * static_cast<double>(i), v = speed_at(t_s);
    const double angle = truth.ratio * steered_rad(t_s - truth.delay_s) + truth.offset_rad;
    const double rate =
        v * std::tan(angle) / (kWheelbase_m + truth.understeer_rad_per_mps2 * v * v);
    samples.push_back({v, steered_rad(t_s), rate + noise_rad_per_s * noise.normal()});
  }
  return samples;
}

plant::SingleTrackParams built_in_car() { return plant::single_track_of({}); }

TEST(LapFit, InASteadyTurnTheModelIsTheLawOfUndersteer) {
  for (const double understeer : {-0.0005, 0.0, 0.002, 0.006})
    for (const double speed_mps : {12.0, 25.0, 35.0}) {
      const std::vector<DriveSample> samples(150, {speed_mps, 0.01, 0.0});
      const Drive drive{samples, kPeriod_s};
      const auto rates = yaw_rates(drive, built_in_car(),
                                   {.offset_rad = 0.002, .understeer_rad_per_mps2 = understeer});
      const double law = speed_mps * 0.012 / (kWheelbase_m + understeer * speed_mps * speed_mps);
      EXPECT_NEAR(rates.back(), law, 1e-3 * law) << understeer << " " << speed_mps;
    }
}

TEST(LapFit, FindsTheNumbersThatMadeADrive) {
  for (const SteeringFit& truth :
       {SteeringFit{
            .offset_rad = 0.004, .ratio = 1.06, .delay_s = 0.3, .understeer_rad_per_mps2 = 0.002},
        SteeringFit{.offset_rad = -0.002,
        .ratio = 0.94,
        .delay_s = 0.1,
        .understeer_rad_per_mps2 = 0.0005}}) {
    const auto samples = steady_drive(truth, 4000, 0.005);
    const Drive drive{samples, kPeriod_s};
    const auto fit = fitted(drive, {0, samples.size()}, built_in_car(), {.delay_s = 0.2});
    ASSERT_TRUE(fit) << to_string(fit.error());
    EXPECT_NEAR(fit->offset_rad, truth.offset_rad, 2e-4);
    EXPECT_NEAR(fit->ratio, truth.ratio, 0.01);
    EXPECT_NEAR(fit->understeer_rad_per_mps2, truth.understeer_rad_per_mps2, 1.5e-4);
    // The car of the fit takes a moment of its own to turn in; the law does not.
    EXPECT_NEAR(fit->delay_s, truth.delay_s, 0.1);
    EXPECT_GT(explained(drive, {0, samples.size()}, yaw_rates(drive, built_in_car(), *fit)), 0.99);
  }
}

TEST(LapFit, AFitOfItsOwnDriveIsExact) {
  const SteeringFit truth{
      .offset_rad = 0.003, .ratio = 0.97, .delay_s = 0.25, .understeer_rad_per_mps2 = 0.001};
  auto samples = steady_drive(truth, 2500);
  const auto rates = yaw_rates({samples, kPeriod_s}, built_in_car(), truth);
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i].yaw_rate_rad_per_s = rates[i];
  const Drive drive{samples, kPeriod_s};
  const auto fit = fitted(drive, {500, 2500}, built_in_car(), {.delay_s = 0.15});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->offset_rad, truth.offset_rad, 1e-5);
  EXPECT_NEAR(fit->ratio, truth.ratio, 1e-3);
  EXPECT_NEAR(fit->delay_s, truth.delay_s, 2e-3);
  EXPECT_NEAR(fit->understeer_rad_per_mps2, truth.understeer_rad_per_mps2, 2e-5);
}

TEST(LapFit, ExplainedIsOneForTheTruthZeroForTheMeanAndLessForWorse) {
  const auto samples = steady_drive({}, 1000);
  const Drive drive{samples, kPeriod_s};
  std::vector<double> truth, mean(samples.size(), 0.0), wrong;
  for (const DriveSample& s : samples) {
    truth.push_back(s.yaw_rate_rad_per_s);
    mean[0] += s.yaw_rate_rad_per_s / static_cast<double>(samples.size());
    wrong.push_back(-s.yaw_rate_rad_per_s);
  }
  std::fill(mean.begin(), mean.end(), double{mean[0]});
  EXPECT_EQ(explained(drive, {0, samples.size()}, truth), 1.0);
  EXPECT_NEAR(explained(drive, {0, samples.size()}, mean), 0.0, 1e-9);
  EXPECT_LT(explained(drive, {0, samples.size()}, wrong), -2.0);
}

TEST(LapFit, ADriveThatSaysNothingIsRefused) {
  const auto few = steady_drive({}, 50);
  EXPECT_FALSE(fitted({few, kPeriod_s}, {0, few.size()}, built_in_car(), {}));
  const std::vector<DriveSample> slow(500, {3.0, 0.1, 0.0});
  EXPECT_FALSE(fitted({slow, kPeriod_s}, {0, slow.size()}, built_in_car(), {}));
  const std::vector<DriveSample> straight(500, {20.0, 0.0, 0.0});
  EXPECT_FALSE(fitted({straight, kPeriod_s}, {0, straight.size()}, built_in_car(), {}));
}

}  // namespace
}  // namespace pitwall::plant
