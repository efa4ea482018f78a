// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/camera/camera_model.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "tests/support/draw.hpp"

namespace pitwall::perception {
namespace {

constexpr double kFocalX_px = 1046.25, kFocalY_px = 1048.75;
constexpr double kCentreX_px = 1032.5, kCentreY_px = 471.25;

CameraModel with(const std::array<double, CameraModel::kCoefficients>& distortion) {
  return {kFocalX_px, kFocalY_px, kCentreX_px, kCentreY_px, distortion};
}
const CameraModel kPlumbBob = with({-0.302, 0.096, 0.0011, -0.0007, -0.0125, 0.0, 0.0, 0.0});
const CameraModel kRational = with({0.52, 0.031, -0.0004, 0.0009, 0.0021, 0.86, 0.12, 0.009});

struct Pair {
  Pixel at;
  NormalizedPoint point;
};

void expect_pairs(const CameraModel& camera, const std::array<Pair, 7>& pairs) {
  for (const Pair& pair : pairs) {
    const auto point = undistort(camera, pair.at);
    ASSERT_TRUE(point) << pair.at.u_px << " " << pair.at.v_px;
    EXPECT_NEAR(point->x, pair.point.x, 2e-9);
    EXPECT_NEAR(point->y, pair.point.y, 2e-9);
    const Pixel back = project(camera, pair.point);
    EXPECT_NEAR(back.u_px, pair.at.u_px, 2e-6);
    EXPECT_NEAR(back.v_px, pair.at.v_px, 2e-6);
  }
}

// What cv2.undistortPointsIter (500 steps) and cv2.projectPoints of OpenCV 4.6.0 say.
TEST(CameraModel, IsThatOfOpenCv) {
  expect_pairs(kPlumbBob, {{{{40.0, 30.0}, {-1.466072059, -0.655872687}},
                            {{1032.5, 471.25}, {0.0, 0.0}},
                            {{1500.25, 600.5}, {0.480766339, 0.132184499}},
                            {{700.0, 400.0}, {-0.328415525, -0.070352708}},
                            {{473.500062, 705.081362}, {-0.6, 0.25}},
                            {{1369.439952, 85.344521}, {0.35, -0.4}},
                            {{1136.719314, 523.503181}, {0.1, 0.05}}}});
  expect_pairs(kRational, {{{{40.0, 30.0}, {-1.687424158, -0.743595818}},
                            {{2050.0, 940.0}, {1.773107973, 0.820584984}},
                            {{1500.25, 600.5}, {0.482286763, 0.133124259}},
                            {{700.0, 400.0}, {-0.330056734, -0.070487789}},
                            {{478.473712, 702.634809}, {-0.6, 0.25}},
                            {{1369.103160, 85.827693}, {0.35, -0.4}},
                            {{1136.710058, 523.468390}, {0.1, 0.05}}}});
}

TEST(CameraModel, APixelOfADirectionIsThePixel) {
  std::mt19937_64 random{3};
  for (int i = 0; i < 2000; ++i) {
    const double u_px = testing::draw_uniform(random, 0.0, 2064.0);
    const Pixel at{u_px, testing::draw_uniform(random, 0.0, 960.0)};
    for (const CameraModel& camera :
         {CameraModel::pinhole(900.0, 1000.0), with({}), kPlumbBob, kRational}) {
      const auto point = undistort(camera, at);
      ASSERT_TRUE(point) << at.u_px << " " << at.v_px;
      const Pixel back = project(camera, *point);
      EXPECT_NEAR(back.u_px, at.u_px, 1e-6);
      EXPECT_NEAR(back.v_px, at.v_px, 1e-6);
    }
  }
}

TEST(CameraModel, WhereTheImageFoldsBackThereIsNoDirection) {
  // r (1 - r^2 / 2) is at most 0.544, at r = 0.816.
  const CameraModel camera = with({-0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  const auto to_the_right = [&](double x) {
    return undistort(camera, {kCentreX_px + kFocalX_px * x, kCentreY_px});
  };
  const auto inside = to_the_right(0.54);
  ASSERT_TRUE(inside);
  EXPECT_LT(inside->x, std::sqrt(2.0 / 3.0));
  EXPECT_FALSE(to_the_right(0.56));
  EXPECT_FALSE(to_the_right(5.0));
}

}  // namespace
}  // namespace pitwall::perception
