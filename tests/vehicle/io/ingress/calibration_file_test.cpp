// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/ingress/calibration_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <string>
#include <utility>

#include "protocol/transport/file.hpp"
#include "tests/support/replaced.hpp"

namespace pitwall::io {
namespace {

// As ROS 2's camera_calibration writes it.
const std::string kFile = R"(image_width: 2064
image_height: 960
camera_name: front_narrow
camera_matrix:
  rows: 3
  cols: 3
  data: [2010.5, 0., 1030.25, 0., 2011.75, 478.5, 0., 0., 1.]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.302, 0.096, 0.0011, -0.0007, 0.]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1., 0., 0., 0., 1., 0., 0., 0., 1.]
projection_matrix:
  rows: 3
  cols: 4
  data: [1985.125, 0., 1031.5, 0., 0., 1990.375, 479.25, 0., 0., 0., 1., 0.]
)";

auto calibration_in(const std::string& text, ImageKind kind = ImageKind::kRaw) {
  const std::string path = ::testing::TempDir() + "pitwall_camera_" + std::to_string(getpid());
  EXPECT_TRUE(transport::write_file(path, text));
  auto camera = read_calibration(path, kind);
  std::remove(path.c_str());
  return camera;
}

std::string mistake(const std::string& from, const std::string& to) {
  const auto camera = calibration_in(testing::replaced(kFile, from, to));
  return camera ? "taken" : camera.error().what;
}

TEST(CalibrationFile, HasTheModelOfTheRawImage) {
  const auto camera = calibration_in(kFile);
  ASSERT_TRUE(camera) << to_string(camera.error());
  EXPECT_EQ(camera->focal_x_px, 2010.5);
  EXPECT_EQ(camera->focal_y_px, 2011.75);
  EXPECT_EQ(camera->centre_x_px, 1030.25);
  EXPECT_EQ(camera->centre_y_px, 478.5);
  EXPECT_EQ(camera->distortion,
            (std::array<double, 8>{-0.302, 0.096, 0.0011, -0.0007, 0.0, 0.0, 0.0, 0.0}));
}

TEST(CalibrationFile, HasTheModelOfTheRectifiedImage) {
  const auto camera = calibration_in(kFile, ImageKind::kRectified);
  ASSERT_TRUE(camera) << to_string(camera.error());
  EXPECT_EQ(camera->focal_x_px, 1985.125);
  EXPECT_EQ(camera->focal_y_px, 1990.375);
  EXPECT_EQ(camera->centre_x_px, 1031.5);
  EXPECT_EQ(camera->centre_y_px, 479.25);
  EXPECT_EQ(camera->distortion, (std::array<double, 8>{}));
}

TEST(CalibrationFile, TheRationalModelHasThreeMore) {
  std::string text = testing::replaced(kFile, "plumb_bob", "rational_polynomial");
  EXPECT_FALSE(calibration_in(text));
  text = testing::replaced(text, "cols: 5", "cols: 8");
  text = testing::replaced(text, "-0.0007, 0.]", "-0.0007, 0.002, 0.86, 0.12, 0.009]");
  const auto camera = calibration_in(text);
  ASSERT_TRUE(camera) << to_string(camera.error());
  EXPECT_EQ(camera->distortion,
            (std::array<double, 8>{-0.302, 0.096, 0.0011, -0.0007, 0.002, 0.86, 0.12, 0.009}));
}

TEST(CalibrationFile, AMistakeIsNamed) {
  EXPECT_EQ(mistake("plumb_bob", "equidistant"),
            "distortion_model: expected plumb_bob or rational_polynomial");
  EXPECT_EQ(mistake("[2010.5, 0.,", "[2010.5, 0.3,"),
            "camera_matrix: expected [fx, 0, cx], [0, fy, cy], [0, 0, 1] on the left");
  EXPECT_EQ(mistake("[1985.125,", "[-1985.125,"),
            "projection_matrix: expected a focal length above 0 and below 50 widths of the image");
  EXPECT_EQ(mistake("1030.25,", "3030.25,"), "camera_matrix: expected a centre within the image");
  for (const auto& [from, to] : {std::pair{"image_width: 2064", "image_width: 0"},
                                 {"image_height: 960\n", ""},
                                 {"2010.5, 0.,", "2010.5,"},
                                 {"2010.5, 0.,", ".nan, 0.,"},
                                 {"rows: 1", "rows: 2"},
                                 {"cols: 4", "cols: 3"},
                                 {"camera_name", "camera"}})
    EXPECT_NE(mistake(from, to), "taken") << from << " -> " << to;
  EXPECT_FALSE(read_calibration("/nowhere.yaml", ImageKind::kRaw));
}

}  // namespace
}  // namespace pitwall::io
