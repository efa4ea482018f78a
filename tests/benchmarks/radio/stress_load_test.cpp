// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/stress_load.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace pitwall::radio {
namespace {

struct Scene {
  explicit Scene(Trouble trouble)
      : radio(std::make_unique<VirtualRadio>(RadioSetup{})), load(*radio, trouble) {}
  void run(int ms) {
    for (int i = 0; i < ms; ++i) {
      load.step();
      radio->step();
    }
  }

  std::unique_ptr<VirtualRadio> radio;
  StressLoad load;
};

TEST(StressLoad, CommandsAreGivenAndApplied) {
  Scene scene(Trouble::kCommands);
  scene.run(3'000);
  EXPECT_GT(scene.load.applied(), 20U);
  EXPECT_EQ(scene.load.openings(), 0U);
}

TEST(StressLoad, KnocksAreRefusedAndCounted) {
  Scene scene(Trouble::kOpenings);
  scene.run(3'000);
  EXPECT_GT(scene.load.openings(), 10'000U);
  const auto& refused = scene.radio->base_report().association.refused;
  std::uint64_t sum = 0;
  for (const std::uint64_t count : refused) sum += count;
  EXPECT_GT(sum, 5'000U);
  EXPECT_TRUE(scene.radio->base_report().established);
}

TEST(StressLoad, RestartsBeginNewSessions) {
  Scene scene(Trouble::kRestarts);
  scene.run(5'000);
  EXPECT_GT(scene.radio->arrivals(), 50U);
  EXPECT_LT(scene.radio->base_report().association.received, 60U);  // of its last life
}

TEST(StressLoad, NoneIsNone) {
  Scene scene(Trouble::kNone);
  scene.run(1'000);
  EXPECT_EQ(scene.load.applied() + scene.load.openings(), 0U);
  EXPECT_EQ(scene.radio->car_report().sessions, 1U);
  for (int i = 0; i < 4; ++i) EXPECT_NE(text_of(static_cast<Trouble>(i)), nullptr);
}

}  // namespace
}  // namespace pitwall::radio
