// That images reach a car is tested in tests/system/dds.
// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/publishers/image_publisher.hpp"

#include <gtest/gtest.h>

#include "tests/hil/traffic/oval.hpp"
#include "vehicle/io/ingress/sensor_ingress.hpp"
#include "vehicle/io/perception/image_codec.hpp"

namespace pitwall::bench {
namespace {

TEST(ImagePublisher, AnImageIsReadAsItsPixels) {
  sensors::CameraImage image{4, 2, {}, {}};
  for (std::uint8_t k = 0; k < 24; ++k) image.rgb.push_back(static_cast<std::uint8_t>(9 * k));
  const ros::Image message = message_of(image);
  EXPECT_EQ(io::contradiction_of(message), nullptr);
  perception::Image read;
  ASSERT_EQ(io::read_image(message, read), nullptr);
  EXPECT_EQ(read.width_px, 4U);
  EXPECT_EQ(read.height_px, 2U);
  EXPECT_EQ(read.rgb, image.rgb);
}

TEST(ImagePublisher, WithoutAMountThereIsNoneAndOfJpegItIsRefused) {
  io::SensorFile file{.domain = {.domain = 68},
                      .sensors = {{"front", "/front", io::SensorType::kImage, 10.0, {}}}};
  const auto none = ImagePublisher::open(file, traffic::oval(), 1, 1, {});
  ASSERT_TRUE(none) << to_string(none.error());
  EXPECT_EQ(*none, nullptr);
  file.sensors[0].type = io::SensorType::kCompressedImage;
  file.sensors[0].camera = io::CameraRow{};
  const auto refused = ImagePublisher::open(file, traffic::oval(), 1, 1, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().place, "front");
}

}  // namespace
}  // namespace pitwall::bench
