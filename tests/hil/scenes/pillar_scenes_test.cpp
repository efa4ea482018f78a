// SPDX-License-Identifier: Apache-2.0
#include "hil/scenes/pillar_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hil/scenes/npy.hpp"
#include "hil/sensors/lidar/car_mesh.hpp"
#include "protocol/transport/file.hpp"
#include "tests/hil/traffic/oval.hpp"
#include "tests/support/draw.hpp"

namespace pitwall::scenes {
namespace {

using perception::kPillarFeatures, perception::Pillar, perception::PillarFeature;

PillarScene drawn_scene(std::mt19937_64& random, std::size_t pillars, std::size_t cars) {
  PillarScene scene;
  for (std::size_t i = 0; i < pillars; ++i) {
    Pillar& pillar = scene.pillars.emplace_back();
    pillar.cell = static_cast<std::uint32_t>(random() % perception::PillarGrid::kCells);
    for (float& feature : pillar.features)
      feature = static_cast<float>(testing::draw_uniform(random, 0.0, 1.0));
  }
  for (std::size_t i = 0; i < cars; ++i)
    scene.cars.push_back({{.ahead_m = testing::draw_uniform(random, -100.0, 125.0),
                           .n_m = testing::draw_uniform(random, -8.0, 8.0),
                           .yaw_rad = testing::draw_uniform(random, -3.0, 3.0),
                           .length_m = 5.0,
                           .width_m = 1.9},
                          random() % 500});
  return scene;
}

class PillarScenes : public ::testing::Test {
 protected:
  std::string folder() const { return folder_->path() + "/scenes"; }

  Result<transport::TemporaryFolder, Problem> folder_ =
      transport::TemporaryFolder::create("pitwall-scenes-");
};

TEST_F(PillarScenes, AreReadAsTheyWereWrittenToHalfAStep) {
  constexpr double kHalfStep = 0.5 * 3.04 / 254.0 + 1e-6;  // of the widest scale
  std::mt19937_64 random{5};
  std::vector<PillarScene> scenes;
  for (std::size_t k = 0; k < 4; ++k) scenes.push_back(drawn_scene(random, 200 * k, k));
  ASSERT_TRUE(write_scenes(scenes, folder()));
  const auto read = read_scenes(folder());
  ASSERT_TRUE(read) << to_string(read.error());
  ASSERT_EQ(read->size(), scenes.size());
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    const PillarScene& a = scenes[k];
    const PillarScene& b = (*read)[k];
    ASSERT_EQ(a.pillars.size(), b.pillars.size());
    for (std::size_t i = 0; i < a.pillars.size(); ++i) {
      EXPECT_EQ(a.pillars[i].cell, b.pillars[i].cell);
      for (std::size_t f = 0; f < kPillarFeatures; ++f)
        EXPECT_NEAR(a.pillars[i].features[f], b.pillars[i].features[f], kHalfStep) << f;
    }
    ASSERT_EQ(a.cars.size(), b.cars.size());
    for (std::size_t i = 0; i < a.cars.size(); ++i) {
      EXPECT_NEAR(a.cars[i].box.ahead_m, b.cars[i].box.ahead_m, 1e-5);
      EXPECT_NEAR(a.cars[i].box.yaw_rad, b.cars[i].box.yaw_rad, 1e-6);
      EXPECT_EQ(a.cars[i].returns, b.cars[i].returns);
    }
  }
}

TEST_F(PillarScenes, OfADrawnSceneHoldWhatStandsInTheTrueBoxes) {
  const perception::TrackGrid grid{traffic::oval()};
  sensors::SceneMaker maker{traffic::oval(), {sensors::av21_shape()}, {.dust = 0.0}};
  std::size_t judged = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const PillarScene scene = pillar_scene(maker.make(seed), grid);
    ASSERT_FALSE(scene.pillars.empty());
    for (const auto& [box, returns] : scene.cars) {
      if (returns < 20) continue;
      ++judged;
      std::size_t inside = 0;
      for (const Pillar& pillar : scene.pillars) {
        const std::size_t row = pillar.cell / perception::PillarGrid::kColumns;
        const std::size_t column = pillar.cell % perception::PillarGrid::kColumns;
        const double ahead_m = 0.4 * (static_cast<double>(row) + 0.5) - 102.4 - box.ahead_m;
        const double n_m = 0.25 * (static_cast<double>(column) + 0.5) - 12.0 - box.n_m;
        const bool is_high = pillar.features[static_cast<std::size_t>(PillarFeature::kHigh)] > 0.0F;
        inside += is_high && std::abs(ahead_m) < 3.2 && std::abs(n_m) < 1.4;
      }
      EXPECT_GE(inside, 5U) << seed << ": a car at " << box.ahead_m;
    }
  }
  EXPECT_GE(judged, 8U) << "or the test has seen next to nothing";
}

TEST_F(PillarScenes, ADamagedFolderIsRefusedWithTheFile) {
  std::mt19937_64 random{5};
  const std::vector<PillarScene> scenes{drawn_scene(random, 50, 2)};
  const auto refusal = [&](const std::string& array, const std::string& contents) {
    EXPECT_TRUE(write_scenes(scenes, folder()));
    EXPECT_TRUE(transport::write_file(folder() + "/" + array, contents));
    const auto read = read_scenes(folder());
    EXPECT_FALSE(read) << array;
    return read ? std::string() : to_string(read.error());
  };
  EXPECT_NE(refusal("cells.npy", "").find("cells.npy"), std::string::npos);
  const std::vector<std::uint32_t> one{3}, far(50, 768 * 96);
  EXPECT_NE(refusal("cells.npy", npy_text(std::span(one), 1)).find("counts.npy"),
            std::string::npos);
  EXPECT_NE(refusal("cells.npy", npy_text(std::span(far), 1)).find("grid"), std::string::npos);
  const std::vector<float> other(20, 1.0F);
  EXPECT_NE(refusal("scales.npy", npy_text(std::span(other), 2)).find("scale"), std::string::npos);
  EXPECT_FALSE(read_scenes(folder() + "/none"));
  EXPECT_FALSE(write_scenes(scenes, "/proc/none"));
}

}  // namespace
}  // namespace pitwall::scenes
