// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/detect/detect_command.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/vehicle/autonomy/perception/lidar/lidar_scene.hpp"

namespace pitwall::io {
namespace {

class DetectCommand : public ::testing::Test {
 protected:
  // The exit status; what it printed is in out() and err().
  int run(std::span<const char* const> words) {
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    const int code = detect_command(words);
    out_ = ::testing::internal::GetCapturedStdout();
    err_ = ::testing::internal::GetCapturedStderr();
    return code;
  }
  std::string out_, err_;
};

TEST_F(DetectCommand, PrintsTheCarsOfAFile) {
  const std::string file =
      std::filesystem::temp_directory_path() / ("pitwall_detect_" + std::to_string(::getpid()));
  const std::string name = file + ".bin";
  const perception::PointCloud sweep =
      perception::sweep_of({.boxes = {{.x_m = 25.0, .y_m = -3.0, .yaw_rad = 0.05},
                                      {.x_m = -20.0, .y_m = 0.0, .yaw_rad = 0.0}}},
                           1);
  std::ofstream out{name, std::ios::binary};
  for (const perception::LidarPoint& p : sweep) {
    const std::array row{p.x_m, p.y_m, p.z_m, p.intensity};
    out.write(reinterpret_cast<const char*>(row.data()), sizeof row);
  }
  out.close();
  const std::array words{name.c_str()};
  EXPECT_EQ(run(words), 0);
  std::filesystem::remove(name);
  EXPECT_TRUE(err_.empty()) << err_;
  EXPECT_NE(out_.find("\n1 cars; points: "), std::string::npos) << out_;
  double x_m = 0.0, y_m = 0.0;
  ASSERT_EQ(std::sscanf(out_.c_str() + out_.find('\n'), "%lf %lf", &x_m, &y_m), 2) << out_;
  EXPECT_NEAR(x_m, 25.0, 0.3);
  EXPECT_NEAR(y_m, -3.0, 0.3);
}

TEST_F(DetectCommand, RefusesWhatItCannotRead) {
  EXPECT_EQ(run(std::array{"/nonexistent.pcd"}), 2);
  EXPECT_NE(err_.find("/nonexistent.pcd"), std::string::npos) << err_;
  EXPECT_EQ(run(std::span<const char* const>{}), 2);
  EXPECT_NE(err_.find("FILE"), std::string::npos) << err_;
  EXPECT_EQ(run(std::array{"a.pcd", "--ahead", "-1"}), 2);
  EXPECT_NE(err_.find("--ahead"), std::string::npos) << err_;
  EXPECT_EQ(run(std::array{"--help"}), 0);
  EXPECT_NE(out_.find("--side"), std::string::npos) << out_;
}

}  // namespace
}  // namespace pitwall::io
