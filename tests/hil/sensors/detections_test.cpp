// Statistics of the modelled detections against their parameters. A bound follows from the
// distribution and the number of draws: 5 sigma of a count or a mean, the 1e-6 quantiles of
// chi-square for a sum of squares.
// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/detections.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace pitwall::sensors {
namespace {

using plant::CarPose;
using world::Detection, world::DetectionFrame, world::DetectionSource;

constexpr double kSigmas = 5.0;
constexpr int kFrames = 4000;
constexpr double kChiSquareLeast = 3589.1, kChiSquareMost = 4439.7;  // of kFrames, by SciPy
constexpr Duration kStep = milliseconds(10);

// Sees everything without any error.
DetectionSensor exact(DetectionSource source) {
  DetectionSensor s;
  s.source = source;
  s.cadence = {milliseconds(50), {}, 0.0};
  s.view.most_m = 1000.0;
  s.hit_rate = {{{0.0, 1.0}, {1.0, 1.0}, {2.0, 1.0}}};
  s.lidar = {.position_sigma_m = {{{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}}},
             .yaw_sigma_rad = 0.0,
             .flip = 0.0,
             .length_sigma_m = 0.0,
             .width_sigma_m = 0.0};
  s.camera.bearing_sigma_rad = s.camera.height_sigma_px = 0.0;
  s.radar = {.range_sigma_m = 0.0, .bearing_sigma_rad = 0.0, .rate_sigma_mps = 0.0};
  return s;
}

// Velocity in Map.
CarPose car_at(double x_m, double y_m, double yaw_rad = 0.0, double east_mps = 0.0,
               double north_mps = 0.0) {
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  return {.x_m = x_m,
          .y_m = y_m,
          .yaw_rad = yaw_rad,
          .vx_mps = c * east_mps + s * north_mps,
          .vy_mps = c * north_mps - s * east_mps,
          .length_m = 4.92,
          .width_m = 1.89};
}

struct Sight {
  CarPose ours = car_at(0.0, 0.0);
  std::vector<CarPose> others{};
};

std::vector<DetectionFrame> frames_of(const std::vector<DetectionSensor>& sensors,
                                      const Sight& sight, int frames, std::uint64_t seed = 1) {
  DetectionSensors all;
  for (const DetectionSensor& s : sensors) EXPECT_TRUE(all.push(s));
  DetectionState state = make_detections(all, seed, Instant{});
  std::vector<DetectionFrame> received;
  const Duration span = frames * sensors[0].cadence.period;
  for (Instant now{}; now < Instant{} + span; now += kStep) {
    Arrivals out;
    step_detections(all, state, {sight.ours, sight.others}, now, out);
    received.insert(received.end(), out.begin(), out.end());
  }
  EXPECT_EQ(state.overflows, 0U);
  return received;
}

std::vector<Detection> detections_of(const DetectionSensor& sensor, const Sight& sight,
                                     int frames = kFrames) {
  std::vector<Detection> all;
  for (const DetectionFrame& f : frames_of({sensor}, sight, frames))
    all.insert(all.end(), f.detections.begin(), f.detections.end());
  return all;
}

// Of errors that should have this sigma and be independent of each other.
void expect_white(const std::vector<Detection>& all, double sigma,
                  const std::function<double(const Detection&)>& error) {
  ASSERT_EQ(all.size(), static_cast<std::size_t>(kFrames));
  double sum = 0.0, squares = 0.0, products = 0.0, last = 0.0;
  for (const Detection& d : all) {
    const double e = error(d) / sigma;
    sum += e, squares += e * e, products += e * last;
    last = e;
  }
  EXPECT_NEAR(sum / kFrames, 0.0, kSigmas / std::sqrt(kFrames));
  EXPECT_GT(squares, kChiSquareLeast);
  EXPECT_LT(squares, kChiSquareMost);
  EXPECT_NEAR(products / kFrames, 0.0, kSigmas / std::sqrt(kFrames));
}

void expect_share(double count, double n, double probability) {
  EXPECT_NEAR(count / n, probability, kSigmas * std::sqrt(probability * (1 - probability) / n));
}

TEST(Detections, AreTheTruthInBodyWithoutErrors) {
  const Sight sight{.ours = car_at(100.0, 50.0, 0.5, 40.0, 10.0),
                    .others = {car_at(130.0, 90.0, 0.7, 60.0, -20.0)}};
  // GIVEN the same car in the axes of ours
  const double c = std::cos(0.5), s = std::sin(0.5);
  const double x_m = 30.0 * c + 40.0 * s, y_m = -30.0 * s + 40.0 * c;
  // WHEN each kind of sensor sees it THEN each says it in its own quantities, and no other
  const Detection box = detections_of(exact(DetectionSource::kLidar), sight, 1).at(0);
  EXPECT_NEAR(box.x_m, x_m, 1e-9);
  EXPECT_NEAR(box.y_m, y_m, 1e-9);
  EXPECT_NEAR(box.yaw_rad, 0.2, 1e-9);
  EXPECT_NEAR(box.length_m, 4.92, 1e-9);
  EXPECT_NEAR(box.width_m, 1.89, 1e-9);
  EXPECT_TRUE(std::isnan(box.bearing_rad) && std::isnan(box.range_m));
  const Detection image = detections_of(exact(DetectionSource::kCamera), sight, 1).at(0);
  EXPECT_NEAR(image.bearing_rad, std::atan2(y_m, x_m), 1e-9);
  EXPECT_NEAR(image.inverse_depth_per_m, 1.0 / 50.0, 1e-9);
  EXPECT_TRUE(std::isnan(image.x_m) && std::isnan(image.range_m) && std::isnan(image.yaw_rad));
  const Detection echo = detections_of(exact(DetectionSource::kRadar), sight, 1).at(0);
  EXPECT_NEAR(echo.range_m, 50.0, 1e-9);
  // Relative velocity (20, -30) along (0.6, 0.8).
  EXPECT_NEAR(echo.range_rate_mps, 20.0 * 0.6 - 30.0 * 0.8, 1e-9);
  EXPECT_TRUE(std::isnan(echo.x_m) && std::isnan(echo.inverse_depth_per_m));
}

TEST(Detections, PositionErrorsOfTheLidarGrowWithTheRange) {
  DetectionSensor lidar = exact(DetectionSource::kLidar);
  lidar.lidar.position_sigma_m = LidarNoise{}.position_sigma_m;
  const double yaw_sigma_rad = lidar.lidar.yaw_sigma_rad = LidarNoise{}.yaw_sigma_rad;
  struct Row {
    double range_m, sigma_m;
  };
  for (const auto& [range_m, sigma_m] :
       {Row{20.0, 0.15}, Row{60.0, 0.15}, Row{80.0, 0.225}, Row{100.0, 0.30}, Row{130.0, 0.375}}) {
    const auto all = detections_of(lidar, {.others = {car_at(range_m, 0.0)}});
    expect_white(all, sigma_m, [&](const Detection& d) { return d.x_m - range_m; });
    expect_white(all, sigma_m, [&](const Detection& d) { return d.y_m; });
    expect_white(all, yaw_sigma_rad, [&](const Detection& d) { return d.yaw_rad; });
  }
}

TEST(Detections, FrontAndBackAreExchangedAtTheirRate) {
  DetectionSensor lidar = exact(DetectionSource::kLidar);
  lidar.lidar.flip = 0.05;
  const auto all = detections_of(lidar, {.others = {car_at(30.0, 0.0, 1.0)}});
  const auto flipped = std::ranges::count_if(
      all, [](const Detection& d) { return std::abs(d.yaw_rad - 1.0) > 1.0; });
  expect_share(static_cast<double>(flipped), kFrames, 0.05);
  for (const Detection& d : all) EXPECT_NEAR(std::sin(2.0 * d.yaw_rad), std::sin(2.0), 1e-9);
}

// sigma of the depth Z = Z^2 / (f H) sigma_h, to first order in sigma_h.
TEST(Detections, DepthErrorsOfTheCameraGrowWithItsSquare) {
  DetectionSensor camera = exact(DetectionSource::kCamera);
  camera.camera = {
      .bearing_sigma_rad = 0.001, .focal_px = 2000.0, .height_m = 1.2, .height_sigma_px = 1.0};
  for (const double range_m : {30.0, 60.0, 100.0}) {
    const auto all = detections_of(camera, {.others = {car_at(range_m, 0.0)}});
    expect_white(all, range_m * range_m / (2000.0 * 1.2), [&](const Detection& d) {
      return range_m * range_m * (1.0 / range_m - d.inverse_depth_per_m);
    });
    expect_white(all, 0.001, [](const Detection& d) { return d.bearing_rad; });
  }
}

TEST(Detections, TheRadarScattersInRangeBearingAndRate) {
  DetectionSensor radar = exact(DetectionSource::kRadar);
  radar.radar = {.range_sigma_m = 0.5, .bearing_sigma_rad = 0.02, .rate_sigma_mps = 0.15};
  const auto all =
      detections_of(radar, {.ours = car_at(0, 0, 0, 50.0), .others = {car_at(0.0, 40.0)}});
  expect_white(all, 0.5, [](const Detection& d) { return d.range_m - 40.0; });
  expect_white(all, 0.02, [](const Detection& d) { return d.bearing_rad - std::numbers::pi / 2; });
  expect_white(all, 0.15, [](const Detection& d) { return d.range_rate_mps; });
}

TEST(Detections, TheHitRateFallsWithTheRange) {
  DetectionSensor lidar = exact(DetectionSource::kLidar);
  lidar.hit_rate = {{{60.0, 0.98}, {100.0, 0.90}, {120.0, 0.50}}};
  struct Row {
    double range_m, rate;
  };
  for (const auto& [range_m, rate] :
       {Row{30.0, 0.98}, Row{80.0, 0.94}, Row{110.0, 0.70}, Row{200.0, 0.50}}) {
    const auto all = detections_of(lidar, {.others = {car_at(range_m, 0.0)}});
    expect_share(static_cast<double>(all.size()), kFrames, rate);
  }
}

TEST(Detections, OnlyWhatIsInViewAndNotInABlindSectorIsSeen) {
  DetectionSensor camera = exact(DetectionSource::kCamera);
  camera.view = {.facing_rad = 3.0, .width_rad = 1.6, .least_m = 5.0, .most_m = 60.0};
  ASSERT_TRUE(camera.view.blind.push({-3.0, -2.9}));
  ASSERT_TRUE(camera.view.blind.push({3.1, -3.12}));  // across the cut of the angles
  int seen = 0;
  for (double bearing_rad = -3.1415; bearing_rad < 3.1415; bearing_rad += 0.0101) {
    const bool is_in_view = std::abs(std::remainder(bearing_rad - 3.0, 6.283185307)) <= 0.8;
    const bool is_blind =
        (bearing_rad >= -3.0 && bearing_rad <= -2.9) || bearing_rad >= 3.1 || bearing_rad <= -3.12;
    for (const double range_m : {4.0, 10.0, 59.0, 61.0}) {
      const bool in_range = range_m > 5.0 && range_m < 60.0;
      const Sight sight{
          .others = {car_at(range_m * std::cos(bearing_rad), range_m * std::sin(bearing_rad))}};
      const auto all = detections_of(camera, sight, 1);
      ASSERT_EQ(!all.empty(), is_in_view && !is_blind && in_range) << bearing_rad << ' ' << range_m;
      seen += all.empty() ? 0 : 1;
    }
  }
  EXPECT_GT(seen, 100);
}

TEST(Detections, ANearerCarHidesTheOneBehindIt) {
  DetectionSensor lidar = exact(DetectionSource::kLidar);
  lidar.view.visible_share = 0.3;
  const auto seen = [&](double aside_m, double share) {
    lidar.view.visible_share = share;
    return detections_of(lidar, {.others = {car_at(60.0, aside_m), car_at(30.0, 0.0)}}, 1).size();
  };
  EXPECT_EQ(seen(0.0, 0.3), 1U);
  EXPECT_EQ(seen(0.0, 0.0), 2U);  // a sensor that needs nothing of it free
  // The nearer hides 0.945 m at 27.54 m (its back), which is 1.97 m at 57.54 m: the farther one,
  // 1.89 m wide, is free by half when its middle is there, and quite free from 2.92 m on.
  EXPECT_EQ(seen(1.4, 0.5), 1U);
  EXPECT_EQ(seen(2.2, 0.5), 2U);
  EXPECT_EQ(seen(2.6, 0.95), 1U);
  EXPECT_EQ(seen(3.2, 0.95), 2U);
}

TEST(Detections, WhatIsInSightIsWhatIsDetected) {
  DetectionSensor lidar = exact(DetectionSource::kLidar);
  lidar.view.visible_share = 0.3, lidar.view.most_m = 100.0;
  const Sight sight{.others = {car_at(60.0, 0.0), car_at(30.0, 0.0), car_at(0.0, 110.0)}};
  const sensors::TrueCars cars{sight.ours, sight.others};
  EXPECT_FALSE(is_in_sight(lidar, cars, 0));
  EXPECT_TRUE(is_in_sight(lidar, cars, 1));
  EXPECT_FALSE(is_in_sight(lidar, cars, 2));
  EXPECT_EQ(detections_of(lidar, sight, 1).size(), 1U);
}

TEST(Detections, FramesComeAtTheirRateWithTheirLatency) {
  DetectionSensor lidar = exact(DetectionSource::kLidar);
  lidar.cadence = {milliseconds(50), milliseconds(90), 0.010};
  lidar.phase = milliseconds(20);
  const auto all = frames_of({lidar}, {}, kFrames);
  double sum_s = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ((all[i].at - Instant{}).ns % milliseconds(50).ns, milliseconds(20).ns);
    EXPECT_GE(all[i].received - all[i].at, milliseconds(90));
    sum_s += (all[i].received - all[i].at).seconds();
  }
  const auto n = static_cast<double>(all.size());
  EXPECT_NEAR(n, kFrames, 4.0);  // the last are under way
  EXPECT_NEAR(sum_s / n, 0.090 + 0.010 * (1.0 - std::exp(-6.0)), kSigmas * 0.010 / std::sqrt(n));
}

TEST(Detections, FramesArriveInOrderOfArrivalAndOnce) {
  std::vector<DetectionSensor> sensors(2, exact(DetectionSource::kLidar));
  sensors[0].cadence = {milliseconds(50), milliseconds(20), 0.040};
  sensors[1].source = DetectionSource::kRadar;
  sensors[1].cadence = {milliseconds(50), milliseconds(90), 0.0};
  const auto all = frames_of(sensors, {.others = {car_at(20.0, 0.0)}}, 1000);
  std::size_t lidar_overtakes = 0, radar_after_younger = 0;
  Instant newest_lidar{};
  std::vector<Instant> measured;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i > 0) {
      EXPECT_GE(all[i].received, all[i - 1].received);
    }
    if (all[i].source == DetectionSource::kRadar) {
      radar_after_younger += all[i].at < newest_lidar;
      continue;
    }
    lidar_overtakes += all[i].at < newest_lidar;
    newest_lidar = std::max(newest_lidar, all[i].at);
    measured.push_back(all[i].at);
  }
  EXPECT_GT(lidar_overtakes, 50U);
  EXPECT_GT(radar_after_younger, 200U);
  std::ranges::sort(measured);
  EXPECT_TRUE(std::ranges::adjacent_find(measured) == measured.end());
  EXPECT_GE(measured.size(), 994U);
}

// Alternating exponential times of means a (free) and b (burst): the share b / (a + b) of a time T
// has the variance 2 a^2 b^2 / ((a + b)^3 T).
TEST(Detections, OutagesAndMissesComeInBursts) {
  constexpr int kMany = 3 * kFrames;
  const double free_s = 1.0, burst_s = 0.25, total_s = kMany * 0.05;
  const double share = burst_s / (free_s + burst_s);
  const double sigma =
      free_s * burst_s * std::sqrt(2.0 / (total_s * std::pow(free_s + burst_s, 3)));
  DetectionSensor lidar = exact(DetectionSource::kLidar);
  lidar.outage = {1.0 / free_s, burst_s};
  const Sight sight{.others = {car_at(20.0, 0.0), car_at(20.0, 30.0)}};
  const auto frames = frames_of({lidar}, sight, kMany);
  EXPECT_NEAR(1.0 - static_cast<double>(frames.size()) / kMany, share, kSigmas * sigma);
  lidar.outage = {}, lidar.miss = {1.0 / free_s, burst_s};
  std::size_t first = 0, second = 0, both = 0, stays_hidden = 0, hidden = 0;
  bool was_hidden = false;
  for (const DetectionFrame& f : frames_of({lidar}, sight, kMany)) {
    bool sees_first = false, sees_second = false;
    for (const Detection& d : f.detections) (d.y_m < 1.0 ? sees_first : sees_second) = true;
    first += sees_first, second += sees_second, both += sees_first && sees_second;
    hidden += was_hidden, stays_hidden += was_hidden && !sees_first;
    was_hidden = !sees_first;
  }
  for (const std::size_t seen : {first, second})
    EXPECT_NEAR(1.0 - static_cast<double>(seen) / kMany, share, kSigmas * sigma);
  // Independent of each other: (1 - share)^2 of the frames show both.
  EXPECT_NEAR(static_cast<double>(both) / kMany, (1 - share) * (1 - share), 2.0 * kSigmas * sigma);
  // A burst goes on for another 50 ms with exp(-0.05 / 0.25) = 0.82.
  EXPECT_GT(static_cast<double>(stays_hidden), 0.7 * static_cast<double>(hidden));
}

TEST(Detections, FramesAreLostAtTheirRate) {
  DetectionSensor lidar = exact(DetectionSource::kLidar);
  lidar.frame_loss = 0.1;
  const auto frames = frames_of({lidar}, {}, kFrames);
  expect_share(static_cast<double>(frames.size()), kFrames, 0.9);
}

TEST(Detections, FalseOnesAreOfPoissonAndStandStill) {
  DetectionSensor radar = exact(DetectionSource::kRadar);
  radar.false_per_frame = 0.4, radar.view.width_rad = 1.5, radar.view.facing_rad = 1.0;
  std::size_t count = 0, empty = 0;
  for (const DetectionFrame& f :
       frames_of({radar}, {.ours = car_at(0, 0, 0.3, 60.0 * std::cos(0.3), 60.0 * std::sin(0.3))},
                 kFrames)) {
    count += f.detections.size(), empty += f.detections.empty();
    for (const Detection& d : f.detections) {
      EXPECT_LE(std::abs(d.bearing_rad - 1.0), 0.75);
      EXPECT_NEAR(d.range_rate_mps, -60.0 * std::cos(d.bearing_rad), 1e-9);
      EXPECT_LE(d.confidence, 0.75);
    }
  }
  EXPECT_NEAR(static_cast<double>(count) / kFrames, 0.4, kSigmas * std::sqrt(0.4 / kFrames));
  expect_share(static_cast<double>(empty), kFrames, std::exp(-0.4));
}

bool are_equal(const DetectionFrame& a, const DetectionFrame& b) {
  return a.at == b.at && a.received == b.received && a.unit == b.unit && a.source == b.source &&
         std::ranges::equal(
             a.detections.span(), b.detections.span(), {},
             [](const Detection& d) { return d.confidence; },
             [](const Detection& d) { return d.confidence; });
}

TEST(Detections, ASeedRepeatsAndOneSensorChangesNoOther) {
  const DetectionSensors shipped = av21_detection_sensors();
  std::vector<DetectionSensor> sensors(shipped.begin(), shipped.end());
  const Sight sight{.others = {car_at(20.0, 0.0), car_at(-30.0, 5.0)}};
  const auto first = frames_of(sensors, sight, 200), again = frames_of(sensors, sight, 200);
  EXPECT_TRUE(std::ranges::equal(first, again, are_equal));
  EXPECT_FALSE(std::ranges::equal(first, frames_of(sensors, sight, 200, 2), are_equal));
  sensors[0].false_per_frame = 3.0, sensors[0].cadence.latency = milliseconds(10);
  auto changed = frames_of(sensors, sight, 200);
  const auto without_lidar = [](std::vector<DetectionFrame> all) {
    std::erase_if(all, [](const auto& f) { return f.source == DetectionSource::kLidar; });
    return all;
  };
  EXPECT_FALSE(std::ranges::equal(first, changed, are_equal));
  EXPECT_TRUE(std::ranges::equal(without_lidar(first), without_lidar(changed), are_equal));
}

TEST(Detections, ACopyOfTheStateGoesOnAlike) {
  const DetectionSensors sensors = av21_detection_sensors();
  DetectionState state = make_detections(sensors, 3, Instant{});
  const CarPose ours = car_at(0, 0);
  const std::vector<CarPose> others{car_at(20.0, 0.0)};
  Arrivals out;
  for (int i = 0; i < 100; ++i, out.clear())
    step_detections(sensors, state, {ours, others}, Instant{} + i * kStep, out);
  DetectionState copy = state;
  std::size_t compared = 0;
  for (int i = 100; i < 300; ++i) {
    Arrivals one, other;
    step_detections(sensors, state, {ours, others}, Instant{} + i * kStep, one);
    step_detections(sensors, copy, {ours, others}, Instant{} + i * kStep, other);
    ASSERT_TRUE(std::ranges::equal(one.span(), other.span(), are_equal));
    compared += one.size();
  }
  EXPECT_GT(compared, 300U);
}

TEST(Detections, WhatFindsNoRoomArrivesWithTheNextCall) {
  DetectionSensors sensors;
  DetectionSensor fast = exact(DetectionSource::kLidar);
  fast.cadence = {milliseconds(10), milliseconds(5), 0.0};
  ASSERT_TRUE(sensors.push(fast));
  DetectionState state = make_detections(sensors, 3, Instant{});
  const CarPose ours = car_at(0, 0);
  Arrivals out;
  for (int i = 0; i < 26; ++i)
    step_detections(sensors, state, {ours, {}}, Instant{} + i * kStep, out);
  EXPECT_TRUE(out.full());
  EXPECT_EQ(state.overflows, 0U);
  out.clear();
  step_detections(sensors, state, {ours, {}}, Instant{} + 26 * kStep, out);
  EXPECT_EQ(out.size(), 2U);
  EXPECT_EQ(out[0].at, Instant{} + 24 * kStep);
}

}  // namespace
}  // namespace pitwall::sensors
