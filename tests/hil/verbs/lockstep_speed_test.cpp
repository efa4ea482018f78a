// SPDX-License-Identifier: Apache-2.0
#include "hil/verbs/lockstep_speed.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace pitwall::verbs {
namespace {

TEST(LockstepSpeed, IsScenarioTimeOverProcessorTime) {
  const std::string root = PITWALL_SOURCE_DIR;
  auto loaded = bench::load(root + "/" + kBenchScenario, root);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  loaded->scenario.duration = seconds(2);
  for (const bool with_log : {false, true}) {
    const auto speed = times_real_time(*loaded, with_log);
    ASSERT_TRUE(speed) << to_string(speed.error());
    EXPECT_TRUE(std::isfinite(*speed));
    EXPECT_GT(*speed, 0.0);
  }
}

}  // namespace
}  // namespace pitwall::verbs
