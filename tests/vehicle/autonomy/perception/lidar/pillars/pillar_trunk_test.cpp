// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/pillars/pillar_trunk.hpp"

#include <gtest/gtest.h>

#include "hil/scenes/npy.hpp"
#include "hil/scenes/pillar_scenes.hpp"
#include "protocol/transport/file.hpp"
#include "tests/vehicle/autonomy/perception/network/onnx_text.hpp"
#include "vehicle/autonomy/perception/lidar/pillars/pillar_decoder.hpp"
#include "vehicle/autonomy/perception/lidar/pillars/pillar_detector.hpp"

namespace pitwall::perception {
namespace {

constexpr double kConfidenceOfRecipe = 0.5;  // training/decoding.py

std::string refusal(const std::string& onnx) {
  const auto trunk = PillarTrunk::load(onnx, "net.onnx");
  EXPECT_FALSE(trunk);
  return trunk ? std::string() : to_string(trunk.error());
}

std::string in_tree(const std::string& path) {
  return std::string(PITWALL_SOURCE_DIR) + "/" + path;
}

TEST(PillarTrunk, ANetworkOfAnotherShapeIsRefusedWithBothShapes) {
  const std::string why = refusal(onnx_text("Relu", {1, 10, 768, 96}));
  EXPECT_NE(why.find("1 x 7 x 384 x 48"), std::string::npos) << why;
  EXPECT_NE(why.find("1 x 10 x 768 x 96"), std::string::npos) << why;
}

// Boxes that the recipe found with the same weights, by another library and another decoder.
TEST(PillarTrunk, FindsTheCarsThatTheTrainedNetworkFound) {
  const auto onnx = transport::read_file(in_tree(kPillarNetworkFile));
  ASSERT_TRUE(onnx) << to_string(onnx.error());
  auto trunk = PillarTrunk::load(*onnx, kPillarNetworkFile);
  ASSERT_TRUE(trunk) << to_string(trunk.error());
  const std::string folder = in_tree("tests/vehicle/autonomy/perception/lidar/pillars/scenes");
  const auto stored = scenes::read_scenes(folder);
  ASSERT_TRUE(stored) << to_string(stored.error());
  const auto file = transport::read_file(folder + "/boxes.npy");
  ASSERT_TRUE(file);
  const auto boxes = scenes::read_npy<float>(*file, "boxes.npy", 7);  // scene, then a RoadBox
  ASSERT_TRUE(boxes) << to_string(boxes.error());
  ASSERT_GE(stored->size(), 50U);

  std::size_t next = 0;
  for (std::size_t i = 0; i < stored->size(); ++i) {
    std::vector<float> planes = planes_of((*stored)[i].pillars);
    for (const RoadBox& box : decode(trunk->run(planes), kConfidenceOfRecipe)) {
      ASSERT_LT(next, boxes->size());
      const float* const expected = boxes->data() + next;
      ASSERT_EQ(expected[0], static_cast<float>(i));
      EXPECT_NEAR(box.ahead_m, expected[1], 1e-3) << i;
      EXPECT_NEAR(box.n_m, expected[2], 1e-3) << i;
      EXPECT_NEAR(box.yaw_rad, expected[3], 1e-3) << i;
      EXPECT_NEAR(box.length_m, expected[4], 1e-3) << i;
      EXPECT_NEAR(box.width_m, expected[5], 1e-3) << i;
      EXPECT_NEAR(box.confidence, expected[6], 1e-3) << i;
      next += 7;
    }
  }
  EXPECT_EQ(next, boxes->size());
  EXPECT_GE(next / 7, 50U) << "or the test has seen next to nothing";
}

}  // namespace
}  // namespace pitwall::perception
