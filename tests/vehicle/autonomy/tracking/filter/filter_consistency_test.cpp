// SPDX-License-Identifier: Apache-2.0
// Whether the road filter knows how wrong it is: normalised estimation errors squared of 200 cars,
// against the bounds that chi-square gives them. The cars move at random as the parameters say, by
// an integration in small steps of its own.
//   source Bar-Shalom, Li and Kirubarajan, Estimation with Applications to Tracking and Navigation
//          (2001), section 5.4.2
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/support/instants.hpp"
#include "tests/vehicle/autonomy/tracking/filter/circle.hpp"
#include "vehicle/autonomy/tracking/filter/measurement.hpp"
#include "vehicle/autonomy/tracking/filter/modes.hpp"
#include "vehicle/autonomy/tracking/filter/motion.hpp"
#include "vehicle/autonomy/tracking/filter/road_filter.hpp"

namespace pitwall::tracking {
namespace {

using testing::circle;
using testing::draw_normal;
using testing::kRadius_m;
using testing::measured;
using testing::on_circle;
using testing::own_motion;
using testing::seen;
using testing::TruePose;
using world::DetectionSource;

constexpr int kCars = 200;
// Of the mean over 200 cars of a sum of 6 squares:
// scipy.stats.chi2.ppf([0.0005, 0.9995], 1200) / 200.
constexpr double kLeast = 5.227, kMost = 6.839;

// Gauss-Markov acceleration and turn rate, white velocity and turn: Euler-Maruyama at 1 kHz.
struct RandomCar {
  double s_m, n_m, heading_rad, speed_mps, accel_mps2, turn_rad_per_s;

  void move(const RoadParams& p, bool on_road, double dt_s, std::mt19937_64& random) {
    const double turn_sigma = on_road ? p.turn_sigma_rad_per_s : p.plane_turn_sigma_rad_per_s;
    const double turn_time_s = on_road ? p.turn_time_s : p.plane_turn_time_s;
    const double left = on_road ? 1.0 - n_m / kRadius_m : 1.0;
    const double wander_m = p.wander_m_per_sqrt_s * std::sqrt(dt_s);
    s_m += speed_mps * std::cos(heading_rad) / left * dt_s + wander_m * draw_normal(random);
    n_m += speed_mps * std::sin(heading_rad) * dt_s + wander_m * draw_normal(random);
    heading_rad += (turn_rad_per_s - (on_road ? heading_rad / p.heading_time_s : 0.0)) * dt_s +
                   p.heading_wander_rad_per_sqrt_s * std::sqrt(dt_s) * draw_normal(random);
    speed_mps += accel_mps2 * dt_s;
    accel_mps2 += -accel_mps2 / p.accel_time_s * dt_s +
                  p.accel_sigma_mps2 * std::sqrt(2.0 * dt_s / p.accel_time_s) * draw_normal(random);
    turn_rad_per_s += -turn_rad_per_s / turn_time_s * dt_s +
                      turn_sigma * std::sqrt(2.0 * dt_s / turn_time_s) * draw_normal(random);
  }

  TruePose pose(bool on_road) const {
    if (on_road) return on_circle(s_m, n_m, heading_rad, speed_mps);
    return {s_m, n_m, heading_rad, speed_mps};
  }
};

// x' P^-1 x by Gaussian elimination.
double normalised(StateVector x, StateMatrix p) {
  double sum = 0.0;
  for (std::size_t i = 0; i < kRoadStates; ++i) {
    sum += x[i] * x[i] / p[i][i];
    for (std::size_t r = i + 1; r < kRoadStates; ++r) {
      const double share = p[r][i] / p[i][i];
      x[r] -= share * x[i];
      for (std::size_t c = i; c < kRoadStates; ++c) p[r][c] -= share * p[i][c];
    }
  }
  return sum;
}

Measurement noisy(const RoadParams& p, DetectionSource source, const TruePose& own,
                  const TruePose& car, std::mt19937_64& random) {
  Measurement m = measured(source, seen(source, own, car));
  const auto add = [&](std::size_t i, double sigma) { m.value[i] += sigma * draw_normal(random); };
  if (source == DetectionSource::kLidar) {
    const double sigma_m = lidar_sigma_m(p, std::hypot(m.value[0], m.value[1]));
    add(0, sigma_m), add(1, sigma_m), add(2, p.lidar_yaw_sigma_rad);
  } else if (source == DetectionSource::kCamera) {
    const CameraSigma sigma = camera_sigma(p, 0, {}, kUnset);
    add(0, sigma.bearing_rad), add(1, sigma.inverse_depth_per_m);
  } else {
    add(0, p.radar_range_sigma_m), add(1, p.radar_bearing_sigma_rad);
    add(2, p.radar_rate_sigma_mps);
  }
  return m;
}

// Mean over the cars of the normalised error after 4 s; the mean over those still tracked.
double mean_error(bool on_road, const std::vector<DetectionSource>& sensors) {
  const world::TrackMap map = circle();
  RoadParams params;
  params.steady_accel_sigma_mps2 = params.accel_sigma_mps2 = 2.0;  // the modes are one
  params.steady_accel_time_s = params.accel_time_s;
  params.steady_turn_sigma_rad_per_s = params.speed_change_turn_sigma_rad_per_s =
      params.turn_sigma_rad_per_s = 0.01;  // or a car leaves the road within seconds
  params.plane_turn_sigma_rad_per_s = 0.1;
  params.gate_1 = params.gate_2 = params.gate_3 = 50.0;  // or the worst errors are left out
  const world::TrackMap* ground = on_road ? &map : nullptr;
  double sum = 0.0;
  int cars = 0;
  for (int seed = 0; seed < kCars; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed) + 1);
    RandomCar own{0, -3.0, 0, 60.0, 0, 0}, car{40.0, 2.0, 0.0, 60.0, 0, 0};
    const RoadParams still{.steady_accel_sigma_mps2 = 0,
                           .accel_sigma_mps2 = 0,
                           .steady_turn_sigma_rad_per_s = 0,
                           .turn_sigma_rad_per_s = 0,
                           .plane_turn_sigma_rad_per_s = 0,
                           .wander_m_per_sqrt_s = 0,
                           .heading_wander_rad_per_sqrt_s = 0};
    Tracks tracks;
    for (int ms = 0; ms <= 4000; ++ms) {
      if (ms % 50 == 0) {
        const DetectionSource source = sensors[static_cast<std::size_t>(ms / 50) % sensors.size()];
        const TruePose mine = own.pose(on_road);
        const std::vector<Measurement> one{noisy(params, source, mine, car.pose(on_road), random)};
        OwnMotion motion = own_motion(mine);
        filter_road(params, ground, seconds(5),
                    {.key = {at_ms(ms), source, 0}, .own = motion, .measurements = one}, tracks);
      }
      if (ms < 4000)
        car.move(params, on_road, 1e-3, random), own.move(still, on_road, 1e-3, random);
    }
    if (tracks.list.size() != 1) continue;
    Track t = tracks.list[0];
    join_modes(t);
    StateVector e{};
    const std::array truth{car.s_m,       car.n_m,        car.heading_rad,
                           car.speed_mps, car.accel_mps2, car.turn_rad_per_s};
    for (std::size_t i = 0; i < kRoadStates; ++i) e[i] = t.x[i] - truth[i];
    if (on_road) e[0] = std::remainder(e[0], map.length_m());
    e[2] = wrap_pi(e[2]);
    sum += normalised(e, t.p);
    ++cars;
  }
  EXPECT_EQ(cars, kCars) << "a car was lost";
  return sum / cars;
}

void expect_consistent(bool on_road, const std::vector<DetectionSource>& sensors) {
  const double mean = mean_error(on_road, sensors);
  EXPECT_GE(mean, kLeast);
  EXPECT_LE(mean, kMost);
  std::printf("mean of 200 normalised errors: %.2f (%.2f to %.2f)\n", mean, kLeast, kMost);
}

TEST(FilterConsistency, LidarOnTheRoad) { expect_consistent(true, {DetectionSource::kLidar}); }
TEST(FilterConsistency, LidarOnAPlane) { expect_consistent(false, {DetectionSource::kLidar}); }
TEST(FilterConsistency, AllSensorsOnTheRoad) {
  expect_consistent(true,
                    {DetectionSource::kLidar, DetectionSource::kRadar, DetectionSource::kCamera});
}

}  // namespace
}  // namespace pitwall::tracking
