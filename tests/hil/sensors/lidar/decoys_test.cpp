// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/lidar/decoys.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "hil/sensors/lidar/random_scene.hpp"
#include "tests/hil/traffic/oval.hpp"

namespace pitwall::sensors {
namespace {

constexpr std::uint64_t kDecoyScenes = 12;

std::vector<LidarScene> scenes_with(DecoySet decoys) {
  SceneMaker maker{traffic::oval(), {av21_shape()}, {.decoys = decoys}};
  std::vector<LidarScene> scenes;
  for (std::uint64_t seed = 0; seed < kDecoyScenes; ++seed) scenes.push_back(maker.make(seed));
  return scenes;
}

// Of decoys: their numbers in the scene follow those of the cars.
std::vector<LidarReturn> returns_of_decoys(const LidarScene& scene) {
  std::vector<LidarReturn> of_decoys;
  for (const UnitSweep& sweep : scene.sweeps)
    std::ranges::copy_if(sweep.returns, std::back_inserter(of_decoys), [](const LidarReturn& back) {
      return back.car >= static_cast<std::int16_t>(kSceneCarsMost);
    });
  return of_decoys;
}

TEST(Decoys, AreOfTheSizeOfWhatTheyAre) {
  for (const DecoySet set : {DecoySet::kCommon, DecoySet::kRare})
    for (const CarShape& shape : decoy_shapes(set)) {
      EXPECT_GT(shape.height_m, 0.1) << shape.name;
      EXPECT_LT(shape.height_m, 1.8) << shape.name;
      EXPECT_LT(std::max(shape.length_m, shape.width_m), 2.1) << shape.name << " is no car";
    }
  EXPECT_TRUE(decoy_shapes(DecoySet::kNone).empty());
}

TEST(Decoys, CommonAndRareOnesDiffer) {
  for (const CarShape& common : decoy_shapes(DecoySet::kCommon))
    for (const CarShape& rare : decoy_shapes(DecoySet::kRare)) EXPECT_NE(common.name, rare.name);
}

TEST(Decoys, AreSeenAndAreNoCars) {
  std::size_t seen = 0;
  const std::vector<LidarScene> with = scenes_with(DecoySet::kCommon),
                                without = scenes_with(DecoySet::kNone);
  for (std::size_t i = 0; i < kDecoyScenes; ++i) {
    seen += !returns_of_decoys(with[i]).empty();
    EXPECT_TRUE(returns_of_decoys(without[i]).empty());
    ASSERT_EQ(with[i].cars.size(), without[i].cars.size()) << "the cars are the same";
    for (std::size_t car = 0; car < with[i].cars.size(); ++car)
      EXPECT_EQ(with[i].cars[car].x_m, without[i].cars[car].x_m);
  }
  EXPECT_GT(seen, kDecoyScenes / 2);
}

TEST(Decoys, StandOnTheRoadAwayFromCars) {
  for (const DecoySet set : {DecoySet::kCommon, DecoySet::kRare})
    for (const LidarScene& scene : scenes_with(set)) {
      for (const UnitSweep& sweep : scene.sweeps) {
        const Rotation mount = rotation(sweep.mount.attitude);
        for (const LidarReturn& back : sweep.returns) {
          if (back.car < static_cast<std::int16_t>(kSceneCarsMost)) continue;
          const Vector3 at = plus(sweep.mount.at_m, turned(mount, {back.x_m, back.y_m, back.z_m}));
          // What our own car has gone since the reference time is less than 4 m.
          EXPECT_GT(std::hypot(at[0], at[1]), 0.5) << "in our own car";
          EXPECT_LT(std::hypot(at[0], at[1]), 135.0);
        }
      }
    }
}

TEST(Decoys, TheSameSeedPutsThemWhereTheyWere) {
  SceneMaker maker{traffic::oval(), {av21_shape()}, {.decoys = DecoySet::kCommon}};
  const auto first = returns_of_decoys(maker.make(3)), between = returns_of_decoys(maker.make(4)),
             again = returns_of_decoys(maker.make(3));
  ASSERT_FALSE(first.empty());
  ASSERT_EQ(first.size(), again.size());
  EXPECT_EQ(first.front().x_m, again.front().x_m);
  EXPECT_TRUE(between.size() != first.size() || between.front().x_m != first.front().x_m);
}

}  // namespace
}  // namespace pitwall::sensors
