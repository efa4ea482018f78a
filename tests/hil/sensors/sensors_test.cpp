// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/sensors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hil/sensors/geometry.hpp"
#include "tests/hil/sensors/sensor_log.hpp"

namespace pitwall::sensors {
namespace {

TEST(Sensors, ComeAtTheirRatesWithTheirLatency) {
  const Params p = quiet();
  const Log log = run(p, standing_at(0, 0, 0), 10'000);
  for (const int unit : {0, 1}) {
    const auto expect = [&](const auto& all, double count, double off) {
      EXPECT_NEAR(static_cast<double>(of_unit(all, unit).size()), count, off);
    };
    expect(log.positions, 200.0, 1.0);
    expect(log.velocities, 200.0, 1.0);
    expect(log.attitudes, 200.0, 1.0);
    expect(log.headings, 10.0, 1.0);
    expect(log.receivers, 10.0, 1.0);
    expect(log.imu, 1250.0, 2.0);
    const auto positions = of_unit(log.positions, unit);
    for (std::size_t i = 1; i < positions.size(); ++i)
      EXPECT_EQ(positions[i].at - positions[i - 1].at, p.position.period);
  }
  for (std::size_t i = 0; i < log.positions.size(); ++i)
    EXPECT_EQ(log.position_arrivals[i] - log.positions[i].at, p.position.latency);
  EXPECT_EQ(log.overflows, 0U);
}

TEST(Sensors, AreSometimesLateButNeverOvertakeThemselves) {
  const Params p = noisy();
  const Log log = run(p, standing_at(0, 0, 0), 100'000);
  double mean_s = 0.0, latest_s = 0.0;
  for (std::size_t i = 0; i < log.positions.size(); ++i) {
    const double late_s =
        (log.position_arrivals[i] - log.positions[i].at - p.position.latency).seconds();
    EXPECT_GE(late_s, 0.0);
    mean_s += late_s / static_cast<double>(log.positions.size());
    latest_s = std::max(latest_s, late_s);
  }
  EXPECT_NEAR(mean_s, p.position.jitter_mean_s + 0.0005, 0.0002);  // seen at whole milliseconds
  EXPECT_GT(latest_s, 3.0 * p.position.jitter_mean_s);
  for (const int unit : {0, 1}) {
    const auto imu = of_unit(log.imu, unit);
    for (std::size_t i = 1; i < imu.size(); ++i) EXPECT_GT(imu[i].at, imu[i - 1].at);
  }
}

TEST(Sensors, ASampleIsValidWhenItWasTaken) {
  const Params p = quiet();
  State state = make_state(p, 1, Instant{});
  Log log;
  for (int ms = 0; ms < 2000; ++ms)  // 50 m/s to the east
    record(p, state, standing_at(0.05 * ms, 0, 0), Instant{} + milliseconds(ms), log);
  ASSERT_GT(log.positions.size(), 50U);
  for (const auto& s : log.positions)
    EXPECT_NEAR(east_m(p, s), 50.0 * (s.at - Instant{}).seconds(), 0.02);
}

// An independent oracle: CartConvert of GeographicLib 2.1.2, round 36.2725 N, 115.0108 W, 600 m.
struct PlanePoint {
  double latitude_deg, longitude_deg, height_m, east_m, north_m, up_m;
};
constexpr PlanePoint kPlanePoints[]{
    {36.272500000000, -115.008565102662, 592.9533, 200.829711916, 0.002317291, -7.049857784},
    {36.274747693955, -114.997683643188, 606.0374, 1178.615225844, 249.516882833, 5.923744108},
    {36.274698576449, -115.004674959067, 601.4353, 550.386511670, 244.003497506, 1.406901078},
    {36.273559072527, -115.008991930073, 582.3200, 162.472185106, 117.531278392, -17.683152992},
    {36.280533998113, -115.001827370736, 581.4998, 806.203780744, 891.604531669, -18.613601052},
    {36.277181218399, -115.007447653994, 582.7942, 301.226104772, 519.500032334, -17.234126636},
    {36.274213615345, -115.010109378742, 596.9808, 62.058476941, 190.167819308, -3.022345323},
    {36.283251588058, -115.009398337694, 584.9521, 125.937098159, 1193.151609169, -15.161089682},
    {36.277875794029, -115.011500831153, 605.0973, -62.973065774, 596.577200803, 5.069002485},
    {36.274213615345, -115.011490621258, 603.0841, -62.058536250, 190.168001848, 3.080954674},
    {36.281862436798, -115.017504692013, 619.0502, -602.419657228, 1039.016819184, 18.936894456},
    {36.276516999057, -115.015286314632, 614.3387, -403.124618378, 445.795082976, 14.310348947},
    {36.273559072527, -115.012608069927, 585.7702, -162.472272882, 117.531342168, -14.232952994},
    {36.276897152898, -115.023050081867, 592.3393, -1100.740584562, 488.041194226, -7.774292869},
    {36.273623846977, -115.017358178406, 587.2291, -589.314327273, 124.738107400, -12.799314279},
    {36.272500000000, -115.013034897338, 605.5565, -200.830108253, 0.002317295, 5.553342210},
    {36.270252306045, -115.023916356812, 601.9098, -1178.682030144, -249.356994058, 1.796137949},
    {36.270301423551, -115.016925040933, 582.3840, -550.415732010, -243.967865846, -17.644400164},
    {36.271440927473, -115.012608069927, 607.2160, -162.477207022, -117.528684346, 7.212846940},
    {36.264466001887, -115.019772629264, 592.5659, -806.370384988, -891.530180757, -7.547511567},
    {36.267818781601, -115.014152346006, 598.1274, -301.262793484, -519.490449799, -1.900927532},
    {36.270786384655, -115.011490621258, 611.7752, -62.061332973, -190.167764614, 11.772054656},
    {36.261748411942, -115.012201662306, 589.7639, -125.971730751, -1193.148539553, -10.349289842},
    {36.267124205971, -115.010099168847, 601.0079, 62.981659890, -596.575823974, 0.979602495}};

TEST(Sensors, GeodesyAgreesWithCartConvert) {
  for (const PlanePoint& point : kPlanePoints) {
    plant::Truth there = standing_at(point.east_m, point.north_m, 1.0);
    there.z_m = point.up_m;
    const Log log = run(quiet(), there, 100);
    ASSERT_FALSE(log.positions.empty());
    const auto& s = log.positions.front();
    EXPECT_NEAR(s.latitude_deg, point.latitude_deg, 2e-11);
    EXPECT_NEAR(s.longitude_deg, point.longitude_deg, 2e-11);
    EXPECT_NEAR(s.height_m, point.height_m, 2e-4);
  }
}

TEST(Sensors, PositionIsThatOfTheAntenna) {
  Params p = quiet();
  p.unit[1].antenna = {2.0, -0.5, 0.4};
  constexpr double kYaw_rad = 0.6, kBank_rad = 0.3;
  const Log log = run(p, standing_at(10, 20, kYaw_rad, -kBank_rad), 100);
  const auto a = of_unit(log.positions, 0).front(), b = of_unit(log.positions, 1).front();
  const double dx_m = east_m(p, b) - east_m(p, a), dy_m = north_m(p, b) - north_m(p, a);
  const double along_m = dx_m * std::cos(kYaw_rad) + dy_m * std::sin(kYaw_rad);
  const double left_m = dy_m * std::cos(kYaw_rad) - dx_m * std::sin(kYaw_rad);
  EXPECT_NEAR(along_m, 2.0, 1e-3);
  // The right antenna of a car whose left side is low is higher and, seen from above, moved left.
  EXPECT_NEAR(left_m, -0.5 * std::cos(kBank_rad) + 0.4 * std::sin(kBank_rad), 1e-3);
  EXPECT_NEAR(b.height_m - a.height_m, 0.5 * std::sin(kBank_rad) + 0.4 * std::cos(kBank_rad), 1e-3);
}

TEST(Sensors, AnAntennaInFrontOfACarThatClimbsIsHigher) {
  Params p = quiet();
  p.unit[1].antenna = {2.0, 0.0, 0.0};
  const Log log = run(p, standing_at(0, 0, 1.0, 0.0, -0.1), 100);
  const auto a = of_unit(log.positions, 0).front(), b = of_unit(log.positions, 1).front();
  EXPECT_NEAR(b.height_m - a.height_m, 2.0 * std::sin(0.1), 1e-6);
}

TEST(Sensors, VelocityIsThatOfTheAntennaFromNorthClockwise) {
  Params p = quiet();
  plant::Truth t = standing_at(0, 0, 0);
  t.rate_rad_per_s = {};
  t.map_vx_mps = 30.0, t.map_vy_mps = -30.0, t.map_vz_mps = 1.5;
  auto s = of_unit(run(p, t, 200).velocities, 0).front();
  EXPECT_NEAR(s.horizontal_mps, 30.0 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(s.track_over_ground_rad, 0.75 * std::numbers::pi, 1e-12);  // south-east
  EXPECT_NEAR(s.vertical_mps, 1.5, 1e-12);
  // Turning on the spot, an antenna in front moves to the left: north for a car that looks east.
  p.unit[0].antenna = {2.0, 0.0, 0.0};
  t.map_vx_mps = t.map_vy_mps = t.map_vz_mps = 0.0, t.rate_rad_per_s = {0.0, 0.0, 0.5};
  s = of_unit(run(p, t, 200).velocities, 0).front();
  EXPECT_NEAR(s.horizontal_mps, 1.0, 1e-12);
  EXPECT_NEAR(wrap_pi(s.track_over_ground_rad), 0.0, 1e-12);
  // Its nose goes down: so does the antenna.
  t.rate_rad_per_s = {0.0, 0.5, 0.0};
  EXPECT_NEAR(of_unit(run(p, t, 200).velocities, 0).front().vertical_mps, -1.0, 1e-12);
}

TEST(Sensors, HeadingIsThatOfTheBaselineFromNorthClockwise) {
  Params p = quiet();
  p.unit[0].baseline_yaw_rad = 0.0, p.unit[1].baseline_yaw_rad = std::numbers::pi / 2.0;
  for (const double yaw_rad : {-3.0, -1.0, 0.0, 0.5, 3.1}) {
    const Log log = run(p, standing_at(0, 0, yaw_rad, 0.3), 1200);
    const double car_rad = std::numbers::pi / 2.0 - yaw_rad;
    const auto a = of_unit(log.headings, 0).front(), b = of_unit(log.headings, 1).front();
    EXPECT_NEAR(wrap_pi(a.heading_rad - car_rad), 0.0, 1e-12);
    EXPECT_NEAR(wrap_pi(b.heading_rad - (car_rad - std::numbers::pi / 2.0)), 0.0, 1e-12);
    EXPECT_GE(a.heading_rad, 0.0);
    EXPECT_LT(a.heading_rad, 2.0 * std::numbers::pi);
    EXPECT_NEAR(a.baseline_m, p.unit[0].baseline_m, 1e-12);
  }
}

TEST(Sensors, TheInertialSolutionIsTheAttitudeOnceTheCarHasMoved) {
  const Params p = quiet();
  plant::Truth t = standing_at(0, 0, 0.5, -0.3, 0.02);
  EXPECT_EQ(run(p, t, 200).attitudes.front().status, world::InsStatus::kAligning);
  t.speed_mps = 20.0;
  const auto s = run(p, t, 200).attitudes.front();
  EXPECT_EQ(s.status, world::InsStatus::kGood);
  EXPECT_NEAR(s.roll_rad, -0.3, 1e-12);
  EXPECT_NEAR(s.pitch_rad, 0.02, 1e-12);
  EXPECT_NEAR(wrap_pi(s.heading_rad - (std::numbers::pi / 2.0 - 0.5)), 0.0, 1e-12);
}

TEST(Sensors, ImuRepeatsTheTruthWhenItHasNoErrorAndNoArm) {
  const plant::Truth t = standing_at(0, 0, 0);
  for (const auto& s : run(quiet(), t, 500).imu) {
    EXPECT_EQ(s.rate_rad_per_s, t.rate_rad_per_s);
    EXPECT_EQ(s.specific_force_mps2, t.specific_force_mps2);
  }
}

// A point of a body that turns about z feels what it takes to keep it on its circle, and what it
// takes to speed it up.
TEST(Sensors, ImuFeelsWhatItsPlaceAdds) {
  const Inertial turning{.rate_rad_per_s = {0.0, 0.0, 2.0},
                         .change_rad_per_s2 = {0.0, 0.0, 3.0},
                         .specific_force_mps2 = {0.0, 0.0, 9.8}};
  const Vector3 felt = specific_force_at(turning, {.x_m = 0.5});
  EXPECT_NEAR(felt[0], -0.5 * 4.0, 1e-12);
  EXPECT_NEAR(felt[1], 0.5 * 3.0, 1e-12);
  EXPECT_NEAR(felt[2], 9.8, 1e-12);
}

TEST(Sensors, AngularAccelerationIsTheChangeOfTheRate) {
  Params p = quiet();
  p.unit[0].imu = {.x_m = 1.0};
  State state = make_state(p, 1, Instant{});
  Log log;
  for (int ms = 0; ms < 100; ++ms) {
    plant::Truth t = standing_at(0, 0, 0);
    t.rate_rad_per_s = {0.0, 0.0, 0.004 * ms};  // 4 rad/s^2
    t.specific_force_mps2 = {};
    record(p, state, t, Instant{} + milliseconds(ms), log);
  }
  for (const auto& s : of_unit(log.imu, 0))
    if (s.at > Instant{} + milliseconds(1)) {
      EXPECT_NEAR(s.specific_force_mps2[1], 4.0, 1e-9);
    }
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
  Log before, a, b;
  run(p, state, t, 0, 1000, before);
  State copy = state;
  run(p, state, t, 1000, 2000, a);
  run(p, copy, t, 1000, 2000, b);
  ASSERT_EQ(a.imu.size(), b.imu.size());
  for (std::size_t i = 0; i < a.imu.size(); ++i)
    EXPECT_EQ(a.imu[i].rate_rad_per_s, b.imu[i].rate_rad_per_s);
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
