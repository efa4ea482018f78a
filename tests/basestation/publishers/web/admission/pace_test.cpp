// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/admission/pace.hpp"

#include <gtest/gtest.h>

namespace pitwall::publishers::web {
namespace {

TEST(Pace, SoManyAtOnceThenSoManyASecond) {
  Pace pace;
  Instant now{seconds(1'000).ns};
  for (std::int64_t i = 0; i < Pace::kAtOnce; ++i) {
    EXPECT_LE(pace.rest(now), Duration{}) << i;
    pace.receive(now);
  }
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(pace.rest(now), Pace::kEach);
    now += Pace::kEach;
    EXPECT_LE(pace.rest(now), Duration{});
    pace.receive(now);
  }
  now += seconds(60);
  for (std::int64_t i = 0; i < Pace::kAtOnce; ++i) {
    EXPECT_LE(pace.rest(now), Duration{}) << "after a silence, " << i;
    pace.receive(now);
  }
  EXPECT_GT(pace.rest(now), Duration{}) << "silence is not saved up";
}

}  // namespace
}  // namespace pitwall::publishers::web
