// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/storm.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace pitwall::radio {
namespace {

struct Scene {
  explicit Scene(Trouble trouble)
      : radio(std::make_unique<VirtualRadio>(RadioSetup{})), storm(*radio, trouble) {}
  void run(int ms) {
    for (int i = 0; i < ms; ++i) {
      storm.step();
      radio->step();
    }
  }

  std::unique_ptr<VirtualRadio> radio;
  Storm storm;
};

TEST(Storm, CommandsAreGivenAndApplied) {
  Scene scene(Trouble::kCommands);
  scene.run(3'000);
  EXPECT_GT(scene.storm.applied(), 20U);
  EXPECT_EQ(scene.storm.knocks(), 0U);
}

TEST(Storm, KnocksAreRefusedAndCounted) {
  Scene scene(Trouble::kKnocks);
  scene.run(3'000);
  EXPECT_GT(scene.storm.knocks(), 10'000U);
  const auto& refused = scene.radio->base_report().association.refused;
  std::uint64_t sum = 0;
  for (const std::uint64_t count : refused) sum += count;
  EXPECT_GT(sum, 5'000U);
  EXPECT_TRUE(scene.radio->base_report().established);
}

TEST(Storm, RestartsBeginNewSessions) {
  Scene scene(Trouble::kRestarts);
  scene.run(5'000);
  EXPECT_GT(scene.radio->arrivals(), 50U);
  EXPECT_LT(scene.radio->base_report().association.received, 60U);  // of its last life
}

TEST(Storm, NoneIsNone) {
  Scene scene(Trouble::kNone);
  scene.run(1'000);
  EXPECT_EQ(scene.storm.applied() + scene.storm.knocks(), 0U);
  EXPECT_EQ(scene.radio->car_report().sessions, 1U);
  for (int i = 0; i < 4; ++i) EXPECT_NE(text_of(static_cast<Trouble>(i)), nullptr);
}

}  // namespace
}  // namespace pitwall::radio
