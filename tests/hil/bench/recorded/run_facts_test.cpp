// The recorded drive stands at the beginning of a run; one that drives is in tests/system/recorded.
// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/recorded/run_facts.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/hil/bench/recorded/recorded_drive.hpp"

namespace pitwall::bench {
namespace {

RunFacts recorded_facts() {
  auto run = RecordedRun::open(recorded_folder());
  auto facts = facts_of(*run, pipeline::testing::setup());
  EXPECT_TRUE(facts) << to_string(facts.error());
  return *facts;
}

TEST(RunFacts, TimeBeginsWithTheFirstFrameThatTheCarHeard) {
  const RunFacts facts = recorded_facts();
  auto run = RecordedRun::open(recorded_folder());
  std::optional<Instant> first;
  Instant last{};
  while (const auto tick = *run->next()) {
    if (!first && !tick->received.empty()) first = tick->received.front().at;
    if (!tick->received.empty()) last = tick->now;
  }
  ASSERT_TRUE(first);
  EXPECT_EQ(facts.first_frame, *first - run->begun());
  EXPECT_EQ(facts.length, last - *first);
}

// By the states themselves, as the recording has them.
TEST(RunFacts, StartFlagsAndModesAreThoseOfTheStates) {
  const RunFacts facts = recorded_facts();
  auto run = RecordedRun::open(recorded_folder());
  bool placed = false;
  double flag = 0.0;
  std::size_t flags = 0;
  while (const auto tick = *run->next()) {
    if (!tick->state) continue;
    const telemetry::Values& v = tick->state->values;
    if (!placed && std::isfinite(v[telemetry::field("track.station")])) {
      placed = true;
      EXPECT_NEAR(facts.start.s_m, v[telemetry::field("track.station")], 1e-9);
      EXPECT_NEAR(facts.start.n_m, v[telemetry::field("track.offset")], 1e-9);
    }
    const double now = v[telemetry::field("flags.track")];
    if (std::isfinite(now) && now != flag) {
      flag = now;
      ASSERT_LT(flags, facts.flags.size());
      EXPECT_EQ(static_cast<double>(facts.flags[flags++].track), flag);
    }
  }
  EXPECT_TRUE(placed);
  EXPECT_EQ(facts.start.speed_mps, 0.0) << "it stands";
  EXPECT_GE(flags, 1U) << "race control shows one";
  ASSERT_FALSE(facts.modes.empty());
  EXPECT_LT(facts.speed_max_mps, 0.5);
}

TEST(RunFacts, TheOperatorsCommandsAndStopsAreTextsAndTheJoystickIsCounted) {
  const RunFacts facts = recorded_facts();
  ASSERT_EQ(facts.operator_texts.size(), 3U);
  EXPECT_EQ(facts.operator_texts[0].text, "command sensors_excluded 2 because recorded");
  EXPECT_EQ(facts.operator_texts[1].at - facts.operator_texts[0].at, kTick);
  EXPECT_EQ(facts.operator_texts[2].text, "stop controlled");
  EXPECT_EQ(facts.joystick_ticks, 40U);
  EXPECT_EQ(facts.guardian_ticks, 10U);
}

}  // namespace
}  // namespace pitwall::bench
