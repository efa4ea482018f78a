// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/camera/image_decoder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "vehicle/autonomy/perception/camera/camera_trunk.hpp"

namespace pitwall::perception {
namespace {

// What the trunk says of no car, and then of some.
class Planes {
 public:
  void add(const ImageBox& box) {
    const auto row = static_cast<std::size_t>(box.v_px / 4.0);
    const auto column = static_cast<std::size_t>(box.u_px / 4.0);
    set(CameraOutput::kCar, row, column, std::log(box.confidence / (1.0 - box.confidence)));
    set(CameraOutput::kRight, row, column, box.u_px / 4.0 - static_cast<double>(column) - 0.5);
    set(CameraOutput::kDown, row, column, box.v_px / 4.0 - static_cast<double>(row) - 0.5);
    set(CameraOutput::kWidth, row, column, std::log(box.width_px / 32.0));
    set(CameraOutput::kHeight, row, column, std::log(box.height_px / 16.0));
    set(CameraOutput::kUpright, row, column, std::log(box.upright_px / 16.0));
  }
  std::vector<ImageBox> decoded() const { return decode_image(planes_, 0.5); }

 private:
  void set(CameraOutput output, std::size_t row, std::size_t column, double value) {
    planes_[static_cast<std::size_t>(output) * CameraTrunk::kOutCells +
            row * CameraTrunk::kOutColumns + column] = static_cast<float>(value);
  }

  std::vector<float> planes_ = std::vector<float>(kCameraOutputs * CameraTrunk::kOutCells, -30.0F);
};

TEST(ImageDecoder, ReadsTheBoxesTheSurestFirst) {
  const ImageBox far{101.0, 140.5, 20.0, 12.0, 11.0, 0.7},
      near{500.25, 200.0, 150.0, 90.0, 80.0, 0.9};
  Planes planes;
  planes.add(far), planes.add(near);
  const auto boxes = planes.decoded();
  ASSERT_EQ(boxes.size(), 2U);
  for (const auto& [box, expected] : {std::pair{boxes[0], near}, std::pair{boxes[1], far}}) {
    EXPECT_NEAR(box.u_px, expected.u_px, 1e-4);
    EXPECT_NEAR(box.v_px, expected.v_px, 1e-4);
    EXPECT_NEAR(box.width_px, expected.width_px, 1e-4);
    EXPECT_NEAR(box.height_px, expected.height_px, 1e-4);
    EXPECT_NEAR(box.upright_px, expected.upright_px, 1e-4);
    EXPECT_NEAR(box.confidence, expected.confidence, 1e-6);
  }
}

TEST(ImageDecoder, OneCarIsFoundOnce) {
  Planes planes;
  planes.add({300.0, 150.0, 100.0, 60.0, 50.0, 0.9});
  planes.add({316.0, 150.0, 100.0, 60.0, 50.0, 0.8});
  EXPECT_EQ(planes.decoded().size(), 1U);
  planes.add({340.0, 150.0, 100.0, 60.0, 50.0, 0.8});
  EXPECT_EQ(planes.decoded().size(), 2U) << "its middle is in the outer half";
}

TEST(ImageDecoder, WhatIsNoNumberIsNoCar) {
  Planes planes;
  planes.add({300.0, 150.0, std::numeric_limits<double>::infinity(), 60.0, 50.0, 0.9});
  planes.add({100.0, 150.0, 20.0, std::nan(""), 50.0, 0.9});
  EXPECT_TRUE(planes.decoded().empty());
}

}  // namespace
}  // namespace pitwall::perception
