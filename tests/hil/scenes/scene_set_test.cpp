// SPDX-License-Identifier: Apache-2.0
#include "hil/scenes/scene_set.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/hil/traffic/oval.hpp"

namespace pitwall::scenes {
namespace {

constexpr std::size_t kScenes = kScenesOfBodies + 4;  // two blocks

TEST(SceneSet, IsTheSameOnAnyNumberOfThreads) {
  const SceneSet set{Bodies::kDrawn, {.spun_share = 0.3}, kScenes, 77};
  const auto one = make_scenes(set, traffic::oval(), 1), two = make_scenes(set, traffic::oval(), 2);
  ASSERT_EQ(one.size(), kScenes);
  ASSERT_EQ(two.size(), kScenes);
  std::size_t cars = 0, spun = 0;
  std::set<double> lengths_m;
  for (std::size_t i = 0; i < kScenes; ++i) {
    ASSERT_EQ(one[i].pillars.size(), two[i].pillars.size()) << i;
    for (std::size_t k = 0; k < one[i].pillars.size(); ++k)
      ASSERT_EQ(one[i].pillars[k].features, two[i].pillars[k].features) << i;
    for (const TrueCar& car : one[i].cars) {
      ++cars;
      spun += std::abs(car.box.yaw_rad) > 0.2;
      lengths_m.insert(car.box.length_m);
    }
  }
  EXPECT_GT(cars, kScenes);
  EXPECT_GT(10 * spun, cars) << "30 % were asked for";
  EXPECT_GT(lengths_m.size(), sensors::kSceneCarsMost) << "others in the second block";
}

TEST(SceneSet, ASceneOfItIsThatOfItsSeed) {
  const auto few = make_scenes({Bodies::kAv21, {}, 2, 41}, traffic::oval(), 2);
  const auto later = make_scenes({Bodies::kAv21, {}, 1, 42}, traffic::oval(), 2);
  ASSERT_EQ(few[1].pillars.size(), later[0].pillars.size());
  EXPECT_NE(few[0].pillars.size(), few[1].pillars.size());
  EXPECT_TRUE(make_scenes({}, traffic::oval(), 2).empty());
}

}  // namespace
}  // namespace pitwall::scenes
