// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/sensors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <vector>

#include "tests/support/public_data.hpp"

namespace pitwall::sensors {
namespace {

constexpr double kPi = std::numbers::pi;
// Metres per degree at 36.27 N on WGS 84, good to 1e-4.
constexpr double kMetresPerDegreeNorth = 110'961.0, kMetresPerDegreeEast = 89'861.0;

Params quiet() {
  Params p;
  p.datum_latitude_deg = 36.2725, p.datum_longitude_deg = -115.0108, p.datum_height_m = 600.0;
  p.position_sigma_m = 1e-9, p.position_white_sigma_m = 0.0, p.height_sigma_m = 1e-9;
  p.velocity_sigma_mps = p.vertical_sigma_mps = p.heading_sigma_rad = 0.0;
  p.gyro_noise_rad_per_s = p.gyro_bias_rad_per_s = 0.0;
  p.accel_noise_mps2 = p.accel_bias_mps2 = 0.0;
  for (UnitParams& u : p.unit) u.antenna = {};
  return p;
}

Params noisy() {
  Params p = quiet();
  const Params real;
  p.position_sigma_m = real.position_sigma_m, p.height_sigma_m = real.height_sigma_m;
  p.position_white_sigma_m = real.position_white_sigma_m;
  p.velocity_sigma_mps = real.velocity_sigma_mps;
  p.heading_sigma_rad = real.heading_sigma_rad;
  p.gyro_noise_rad_per_s = real.gyro_noise_rad_per_s;
  p.accel_noise_mps2 = real.accel_noise_mps2;
  p.gyro_bias_rad_per_s = real.gyro_bias_rad_per_s;
  return p;
}

plant::Truth standing_at(double x_m, double y_m, double yaw_rad, double bank_rad = 0.0) {
  plant::Truth t;
  t.x_m = x_m, t.y_m = y_m, t.yaw_rad = yaw_rad, t.bank_rad = bank_rad;
  t.map_vx_mps = t.map_vy_mps = t.heading_rate_rad_per_s = 0.0;
  t.rate_rad_per_s = {0.01, -0.02, 0.3};
  t.specific_force_mps2 = {1.0, -2.0, 9.9};
  return t;
}

struct Log {
  std::vector<world::GnssPosition> positions;
  std::vector<world::GnssVelocity> velocities;
  std::vector<world::GnssHeading> headings;
  std::vector<world::ImuSample> imu;
  std::vector<Instant> position_arrivals;
  std::uint32_t overflows = 0;
};

void record(const Params& p, State& state, const plant::Truth& truth, Instant now, Log& log) {
  world::SensorInput in;
  step(p, state, truth, now, in);
  for (const auto& s : in.positions)
    log.positions.push_back(s), log.position_arrivals.push_back(now);
  for (const auto& s : in.velocities) log.velocities.push_back(s);
  for (const auto& s : in.headings) log.headings.push_back(s);
  for (const auto& s : in.imu) log.imu.push_back(s);
  log.overflows += in.overflows;
}

Log run(const Params& p, State& state, const plant::Truth& truth, int from_ms, int to_ms) {
  Log log;
  for (int ms = from_ms; ms < to_ms; ++ms)
    record(p, state, truth, Instant{} + milliseconds(ms), log);
  return log;
}

Log run(const Params& p, const plant::Truth& truth, int duration_ms, std::uint64_t seed = 1) {
  State state = make_state(p, seed, Instant{});
  return run(p, state, truth, 0, duration_ms);
}

template <class Sample>
std::vector<Sample> of_unit(const std::vector<Sample>& all, int unit) {
  std::vector<Sample> out;
  for (const Sample& s : all)
    if (s.unit == unit) out.push_back(s);
  return out;
}

TEST(Sensors, ComeAtTheirRatesWithTheirLatency) {
  const Params p = quiet();
  const Log log = run(p, standing_at(0, 0, 0), 10'000);
  for (const int unit : {0, 1}) {
    EXPECT_NEAR(static_cast<double>(of_unit(log.positions, unit).size()), 200.0, 1.0);
    EXPECT_NEAR(static_cast<double>(of_unit(log.velocities, unit).size()), 200.0, 1.0);
    EXPECT_NEAR(static_cast<double>(of_unit(log.headings, unit).size()), 10.0, 1.0);
    EXPECT_NEAR(static_cast<double>(of_unit(log.imu, unit).size()), 1250.0, 2.0);
    const auto positions = of_unit(log.positions, unit);
    for (std::size_t i = 1; i < positions.size(); ++i)
      EXPECT_EQ(positions[i].at - positions[i - 1].at, p.position_period);
  }
  for (std::size_t i = 0; i < log.positions.size(); ++i)
    EXPECT_EQ(log.position_arrivals[i] - log.positions[i].at, p.position_latency);
  EXPECT_EQ(log.overflows, 0U);
}

TEST(Sensors, ASampleIsValidWhenItWasTaken) {
  const Params p = quiet();
  State state = make_state(p, 1, Instant{});
  Log log;
  for (int ms = 0; ms < 2000; ++ms)  // 50 m/s to the east
    record(p, state, standing_at(0.05 * ms, 0, 0), Instant{} + milliseconds(ms), log);
  ASSERT_GT(log.positions.size(), 50U);
  for (const auto& s : log.positions)
    EXPECT_NEAR((s.longitude_deg - p.datum_longitude_deg) * kMetresPerDegreeEast,
                50.0 * (s.at - Instant{}).seconds(), 0.02);
}

// An independent oracle: GeographicLib's own program computed these points.
TEST(Sensors, GeodesyAgreesWithCartConvert) {
  std::ifstream file(recordings::folder() / "ltp/ltp_LVMS.txt");
  if (!file) GTEST_SKIP() << "the table of local tangent plane points is not on this machine";
  int rows = 0;
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    double latitude_deg, longitude_deg, height_m, east_m, north_m, up_m;
    if (!(fields >> latitude_deg >> longitude_deg >> height_m >> east_m >> north_m >> up_m))
      continue;
    Params p = quiet();
    for (UnitParams& u : p.unit) u.antenna = {0.0, 0.0, up_m};
    const Log log = run(p, standing_at(east_m, north_m, 1.0), 100);
    ASSERT_FALSE(log.positions.empty());
    const auto& s = log.positions.front();
    EXPECT_NEAR(s.latitude_deg, latitude_deg, 2e-11);
    EXPECT_NEAR(s.longitude_deg, longitude_deg, 2e-11);
    EXPECT_NEAR(s.height_m, height_m, 2e-4);
    ++rows;
  }
  EXPECT_GT(rows, 20);
}

TEST(Sensors, PositionIsThatOfTheAntenna) {
  Params p = quiet();
  p.unit[1].antenna = {2.0, -0.5, 0.4};
  constexpr double kYaw_rad = 0.6, kBank_rad = 0.3;
  const Log log = run(p, standing_at(10, 20, kYaw_rad, kBank_rad), 100);
  const auto a = of_unit(log.positions, 0).front(), b = of_unit(log.positions, 1).front();
  const double east_m = (b.longitude_deg - a.longitude_deg) * kMetresPerDegreeEast;
  const double north_m = (b.latitude_deg - a.latitude_deg) * kMetresPerDegreeNorth;
  const double along_m = east_m * std::cos(kYaw_rad) + north_m * std::sin(kYaw_rad);
  const double left_m = north_m * std::cos(kYaw_rad) - east_m * std::sin(kYaw_rad);
  EXPECT_NEAR(along_m, 2.0, 1e-3);
  // The right antenna of a car whose left side is low is higher and, seen from above, moved left.
  EXPECT_NEAR(left_m, -0.5 * std::cos(kBank_rad) + 0.4 * std::sin(kBank_rad), 1e-3);
  EXPECT_NEAR(b.height_m - a.height_m, 0.5 * std::sin(kBank_rad) + 0.4 * std::cos(kBank_rad), 1e-3);
}

TEST(Sensors, VelocityIsThatOfTheAntennaFromNorthClockwise) {
  Params p = quiet();
  plant::Truth t = standing_at(0, 0, 0);
  t.map_vx_mps = 30.0, t.map_vy_mps = -30.0;
  auto s = of_unit(run(p, t, 200).velocities, 0).front();
  EXPECT_NEAR(s.horizontal_mps, 30.0 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(s.track_over_ground_rad, 0.75 * kPi, 1e-12);  // south-east
  // Turning on the spot, an antenna in front moves to the left: north for a car that looks east.
  p.unit[0].antenna = {2.0, 0.0, 0.0};
  t.map_vx_mps = t.map_vy_mps = 0.0, t.heading_rate_rad_per_s = 0.5;
  s = of_unit(run(p, t, 200).velocities, 0).front();
  EXPECT_NEAR(s.horizontal_mps, 1.0, 1e-12);
  EXPECT_NEAR(wrap_pi(s.track_over_ground_rad), 0.0, 1e-12);
}

TEST(Sensors, HeadingIsThatOfTheBaselineFromNorthClockwise) {
  Params p = quiet();
  p.unit[0].baseline_yaw_rad = 0.0, p.unit[1].baseline_yaw_rad = kPi / 2.0;
  for (const double yaw_rad : {-3.0, -1.0, 0.0, 0.5, 3.1}) {
    const Log log = run(p, standing_at(0, 0, yaw_rad, 0.3), 1200);
    const double car_rad = kPi / 2.0 - yaw_rad;
    const double a = of_unit(log.headings, 0).front().heading_rad;
    const double b = of_unit(log.headings, 1).front().heading_rad;
    EXPECT_NEAR(wrap_pi(a - car_rad), 0.0, 1e-12);
    EXPECT_NEAR(wrap_pi(b - (car_rad - kPi / 2.0)), 0.0, 1e-12);
    EXPECT_GE(a, 0.0);
    EXPECT_LT(a, 2.0 * kPi);
  }
}

TEST(Sensors, ImuRepeatsTheTruthWhenItHasNoNoise) {
  const plant::Truth t = standing_at(0, 0, 0);
  for (const auto& s : run(quiet(), t, 500).imu) {
    EXPECT_EQ(s.rate_rad_per_s, t.rate_rad_per_s);
    EXPECT_EQ(s.specific_force_mps2, t.specific_force_mps2);
  }
}

// ---- Noise.
struct Moments {
  double mean = 0.0, sigma = 0.0, lag_one = 0.0;
};

Moments moments(const std::vector<double>& x) {
  Moments m;
  const auto n = static_cast<double>(x.size());
  for (const double v : x) m.mean += v / n;
  for (const double v : x) m.sigma += (v - m.mean) * (v - m.mean) / n;
  for (std::size_t i = 1; i < x.size(); ++i)
    m.lag_one += (x[i] - m.mean) * (x[i - 1] - m.mean) / n / m.sigma;
  m.sigma = std::sqrt(m.sigma);
  return m;
}

TEST(Sensors, PositionNoiseIsOfItsSizeAndWanders) {
  Params p = noisy();
  p.position_correlation_s = 1.0;  // so that a run holds many of them
  std::vector<double> north_m;
  for (const auto& s : of_unit(run(p, standing_at(0, 0, 0), 1'000'000).positions, 0))
    north_m.push_back((s.latitude_deg - p.datum_latitude_deg) * kMetresPerDegreeNorth);
  const Moments m = moments(north_m);
  EXPECT_NEAR(m.sigma, p.position_sigma_m, 0.1 * p.position_sigma_m);
  EXPECT_NEAR(m.mean, 0.0, 0.2 * p.position_sigma_m);
  const double white_share = std::pow(p.position_white_sigma_m / p.position_sigma_m, 2);
  EXPECT_NEAR(m.lag_one, (1.0 - white_share) * std::exp(-0.05), 0.03);
}

TEST(Sensors, ImuNoiseIsWhiteAroundAConstantBias) {
  const Params p = noisy();
  std::vector<double> rate;
  const plant::Truth t = standing_at(0, 0, 0);
  for (const auto& s : of_unit(run(p, t, 200'000).imu, 1))
    rate.push_back(s.rate_rad_per_s[2] - t.rate_rad_per_s[2]);
  const Moments m = moments(rate);
  EXPECT_NEAR(m.sigma, p.gyro_noise_rad_per_s, 0.05 * p.gyro_noise_rad_per_s);
  EXPECT_NEAR(m.lag_one, 0.0, 0.04);
  EXPECT_NE(m.mean, 0.0);
  EXPECT_LT(std::abs(m.mean), 5.0 * p.gyro_bias_rad_per_s);
}

TEST(Sensors, HeadingNoiseIsOfItsSize) {
  Params p = noisy();
  p.heading_period = milliseconds(10);
  std::vector<double> error;
  for (const auto& s : of_unit(run(p, standing_at(0, 0, 0), 60'000).headings, 0))
    error.push_back(wrap_pi(s.heading_rad - kPi / 2.0));
  EXPECT_NEAR(moments(error).sigma, p.heading_sigma_rad, 0.05 * p.heading_sigma_rad);
}

TEST(Sensors, RepeatForASeedAndDifferForAnother) {
  const Params p = noisy();
  const plant::Truth t = standing_at(5, 5, 1);
  const Log a = run(p, t, 3000, 9), b = run(p, t, 3000, 9), c = run(p, t, 3000, 10);
  ASSERT_EQ(a.positions.size(), b.positions.size());
  int same = 0;
  for (std::size_t i = 0; i < a.positions.size(); ++i) {
    EXPECT_EQ(a.positions[i].latitude_deg, b.positions[i].latitude_deg);
    same += a.positions[i].latitude_deg == c.positions[i].latitude_deg ? 1 : 0;
  }
  EXPECT_EQ(same, 0);
}

TEST(Sensors, ACopyOfTheStateIsASnapshot) {
  const Params p = noisy();
  const plant::Truth t = standing_at(5, 5, 1);
  State state = make_state(p, 3, Instant{});
  run(p, state, t, 0, 1000);
  State copy = state;
  const Log a = run(p, state, t, 1000, 2000), b = run(p, copy, t, 1000, 2000);
  ASSERT_EQ(a.imu.size(), b.imu.size());
  for (std::size_t i = 0; i < a.imu.size(); ++i)
    EXPECT_EQ(a.imu[i].rate_rad_per_s, b.imu[i].rate_rad_per_s);
}

// ---- Faults. Between 1 s and 2 s of 3 s.
Log with_fault(const Params& p, const UnitFault& fault) {
  const plant::Truth t = standing_at(5, 5, 1);
  State state = make_state(p, 3, Instant{});
  Log log = run(p, state, t, 0, 1000);
  const auto add = [&](const Log& more) {
    log.positions.insert(log.positions.end(), more.positions.begin(), more.positions.end());
    log.headings.insert(log.headings.end(), more.headings.begin(), more.headings.end());
    log.velocities.insert(log.velocities.end(), more.velocities.begin(), more.velocities.end());
    log.imu.insert(log.imu.end(), more.imu.begin(), more.imu.end());
  };
  state.fault[0] = fault;
  add(run(p, state, t, 1000, 2000));
  state.fault[0] = {};
  add(run(p, state, t, 2000, 3000));
  return log;
}

bool faulty(Instant at) { return at >= Instant{} + seconds(1) && at < Instant{} + seconds(2); }

TEST(Faults, OfOneUnitChangeNothingElse) {
  const Params p = noisy();
  const Log good = with_fault(p, {}), bad = with_fault(p, {.outage = true});
  for (const int unit : {0, 1}) {
    std::vector<world::GnssPosition> expected;
    for (const auto& s : of_unit(good.positions, unit))
      if (unit == 1 || !faulty(s.at)) expected.push_back(s);
    const auto got = of_unit(bad.positions, unit);
    ASSERT_EQ(got.size(), expected.size());
    for (std::size_t i = 0; i < got.size(); ++i) {
      EXPECT_EQ(got[i].at, expected[i].at);
      EXPECT_EQ(got[i].latitude_deg, expected[i].latitude_deg);
    }
  }
  for (const auto& s : of_unit(bad.imu, 0)) EXPECT_FALSE(faulty(s.at));
  EXPECT_EQ(of_unit(bad.imu, 1).size(), of_unit(good.imu, 1).size());
}

TEST(Faults, AnOffsetIsSilent) {
  const Params p = noisy();
  const Log good = with_fault(p, {}), bad = with_fault(p, {.offset_east_m = 0.3});
  ASSERT_EQ(good.positions.size(), bad.positions.size());
  int moved = 0;
  for (std::size_t i = 0; i < good.positions.size(); ++i) {
    const double east_m =
        (bad.positions[i].longitude_deg - good.positions[i].longitude_deg) * kMetresPerDegreeEast;
    const bool expected = bad.positions[i].unit == 0 && faulty(bad.positions[i].at);
    EXPECT_NEAR(east_m, expected ? 0.3 : 0.0, 1e-3);
    moved += expected ? 1 : 0;
    EXPECT_EQ(bad.positions[i].latitude_sigma_m, good.positions[i].latitude_sigma_m);
    EXPECT_EQ(bad.positions[i].position_type, world::kPositionNarrowInt);
  }
  EXPECT_GT(moved, 15);
}

TEST(Faults, ADegradedFixSaysSo) {
  const Params p = noisy();
  for (const auto& [fix, type] : {std::pair{Fix::kRtkFloat, world::kPositionNarrowFloat},
                                  std::pair{Fix::kSingle, world::kPositionSingle}})
    for (const auto& s : of_unit(with_fault(p, {.fix = fix}).positions, 0)) {
      EXPECT_EQ(s.position_type, faulty(s.at) ? type : world::kPositionNarrowInt);
      EXPECT_EQ(s.latitude_sigma_m > 0.1, faulty(s.at));
    }
  for (const auto& s : of_unit(with_fault(p, {.sigma_scale = 30.0}).positions, 0))
    EXPECT_EQ(s.latitude_sigma_m > 0.1, faulty(s.at));
}

TEST(Faults, NoFixIsSentAsTheReceiverSendsIt) {
  for (const auto& s : of_unit(with_fault(noisy(), {.fix = Fix::kNone}).positions, 0)) {
    EXPECT_EQ(s.solution_status == world::kSolutionComputed, !faulty(s.at));
    EXPECT_EQ(s.latitude_deg == 0.0, faulty(s.at));
  }
}

TEST(Faults, AFrozenUnitRepeatsItsLastPosition) {
  const auto positions = of_unit(with_fault(noisy(), {.position_frozen = true}).positions, 0);
  for (std::size_t i = 1; i < positions.size(); ++i) {
    EXPECT_EQ(positions[i].latitude_deg == positions[i - 1].latitude_deg, faulty(positions[i].at));
    EXPECT_GT(positions[i].at, positions[i - 1].at);
  }
}

TEST(Faults, HeadingAndImuFailAlone) {
  const Log log = with_fault(noisy(), {.imu_outage = true, .heading_outage = true});
  for (const auto& s : of_unit(log.imu, 0)) EXPECT_FALSE(faulty(s.at));
  for (const auto& s : of_unit(log.headings, 0)) EXPECT_FALSE(faulty(s.at));
  EXPECT_EQ(of_unit(log.positions, 0).size(), of_unit(with_fault(noisy(), {}).positions, 0).size());
}

TEST(Sensors, CountWhatDoesNotFit) {
  const Params p = quiet();
  State state = make_state(p, 1, Instant{});
  world::SensorInput in;  // never emptied
  for (int ms = 0; ms < 5000; ++ms)
    step(p, state, standing_at(0, 0, 0), Instant{} + milliseconds(ms), in);
  EXPECT_TRUE(in.positions.full());
  EXPECT_GT(in.overflows, 100U);
}

}  // namespace
}  // namespace pitwall::sensors
