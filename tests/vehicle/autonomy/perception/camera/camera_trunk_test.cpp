// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/camera/camera_trunk.hpp"

#include <gtest/gtest.h>

#include "tests/vehicle/autonomy/perception/network/onnx_text.hpp"

namespace pitwall::perception {
namespace {

constexpr std::size_t kPlane = CameraTrunk::kRows * CameraTrunk::kColumns;

// Red grows to the right, green downwards, blue is even.
Image ramps(std::size_t width_px, std::size_t height_px) {
  Image image{width_px, height_px, {}};
  for (std::size_t v = 0; v < height_px; ++v)
    for (std::size_t u = 0; u < width_px; ++u) {
      image.rgb.push_back(static_cast<std::uint8_t>(255 * u / (width_px - 1)));
      image.rgb.push_back(static_cast<std::uint8_t>(255 * v / (height_px - 1)));
      image.rgb.push_back(64);
    }
  return image;
}

TEST(CameraTrunk, PlanesAreTheColoursAboutMidGrey) {
  const Image image = ramps(CameraTrunk::kColumns, CameraTrunk::kRows);
  const std::vector<float> planes = planes_of(image);
  ASSERT_EQ(planes.size(), 3 * kPlane);
  for (const std::size_t v : {0U, 7U, 319U})
    for (const std::size_t u : {0U, 100U, 671U})
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_EQ(planes[c * kPlane + v * CameraTrunk::kColumns + u],
                  (static_cast<float>(image.pixel(u, v)[c]) - 128.0F) / 64.0F);
}

TEST(CameraTrunk, AnImageOfAnotherSizeIsScaledToItsOwn) {
  const std::vector<float> expected = planes_of(ramps(CameraTrunk::kColumns, CameraTrunk::kRows));
  for (const auto& [width_px, height_px] :
       {std::pair{1'344U, 640U}, std::pair{2'064U, 960U}, std::pair{336U, 160U}}) {
    const std::vector<float> planes = planes_of(ramps(width_px, height_px));
    ASSERT_EQ(planes.size(), expected.size());
    for (std::size_t i = 0; i < planes.size(); ++i)
      ASSERT_NEAR(planes[i], expected[i], 0.05) << width_px << ": " << i;
  }
}

TEST(CameraTrunk, ANetworkOfAnotherShapeIsRefused) {
  const auto trunk = CameraTrunk::load(onnx_text("Relu", {1, 3, 320, 672}), "net.onnx");
  ASSERT_FALSE(trunk);
  EXPECT_NE(to_string(trunk.error()).find("1 x 6 x 80 x 168"), std::string::npos)
      << to_string(trunk.error());
}

}  // namespace
}  // namespace pitwall::perception
