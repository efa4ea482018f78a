// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/perception/camera_score.hpp"

#include <gtest/gtest.h>

namespace pitwall::perception_bench {
namespace {

sensors::SeenCar shown_at(double x_m, double y_m, std::size_t pixels = 200) {
  return {.u_px = 300.0, .v_px = 150.0, .x_m = x_m, .y_m = y_m, .pixels = pixels};
}

world::Detection seen_at(double x_m, double y_m) {
  world::Detection d;
  d.bearing_rad = std::atan2(y_m, x_m), d.inverse_depth_per_m = 1.0 / std::hypot(x_m, y_m);
  return d;
}

CameraScore score_shown(const std::vector<sensors::SeenCar>& cars,
                        const std::vector<world::Detection>& detections) {
  sensors::CameraScene scene{.unit = {}, .image = {672, 320, {}, {}}, .cars = cars};
  world::DetectionFrame frame;
  for (const world::Detection& d : detections) EXPECT_TRUE(frame.detections.push(d));
  CameraScore sums;
  score(scene, frame, sums);
  return sums;
}

TEST(CameraScore, CountsByDistance) {
  const CameraScore sums = score_shown({shown_at(30, 0), shown_at(50, 2), shown_at(90, 0)},
                                       {seen_at(33, 0), seen_at(90, 0.18)});
  EXPECT_EQ(sums.by_range[1].found, 1U);
  EXPECT_NEAR(sums.by_range[1].distance_rms_share(), 0.1, 1e-9);
  EXPECT_EQ(sums.by_range[2].cars, 1U);
  EXPECT_EQ(sums.by_range[2].found, 0U);
  EXPECT_NEAR(sums.by_range[4].bearing_rms_rad(), 0.002, 1e-6);
  EXPECT_NEAR(sums.to(60.0).found_share(), 0.5, 1e-12);
  EXPECT_EQ(sums.false_cars, 0U);
}

TEST(CameraScore, EachDetectionIsOfOneCarAtMost) {
  EXPECT_EQ(score_shown({shown_at(50, 0), shown_at(52, 1)}, {seen_at(50, 0.1)}).to(100.0).found,
            1U);
  EXPECT_EQ(score_shown({shown_at(50, 0)}, {seen_at(50, 0), seen_at(51, 0.5)}).false_cars, 1U);
  EXPECT_EQ(score_shown({shown_at(50, 0)}, {seen_at(80, 0)}).false_cars, 1U)
      << "as far off as another";
}

TEST(CameraScore, ACarThatIsHardlyThereIsNotAskedFor) {
  const CameraScore hidden = score_shown({shown_at(50, 0, kPixelsLeast - 1)}, {seen_at(50, 0)});
  EXPECT_EQ(hidden.to(100.0).cars + hidden.to(100.0).found + hidden.false_cars, 0U);
  sensors::SeenCar beside = shown_at(50, 0);
  beside.u_px = -3.0;
  EXPECT_EQ(score_shown({beside}, {}).to(100.0).cars, 0U);
}

}  // namespace
}  // namespace pitwall::perception_bench
