// SPDX-License-Identifier: Apache-2.0
// Cost of a step in reference units of the same run: the least of several runs, the rest is
// disturbance by the machine.
#include <gtest/gtest.h>

#include <algorithm>

#include "protocol/transport/clock.hpp"
#include "tests/benchmarks/cost/cost_gates.hpp"
#include "tests/benchmarks/cost/reference_cost.hpp"
#include "tests/vehicle/autonomy/tracking/race.hpp"

namespace pitwall::tracking {
namespace {

using testing::Loop;
using testing::Race;

Race six_cars() {
  Race race;
  for (int i = 0; i < 6; ++i)
    race.cars.push_back({.s_m = 110.0 + 12.0 * i, .n_m = i % 2 == 0 ? 3.0 : -3.0});
  return race;
}

// Least cost of the step at `t_s` with the given frames, from the same state every time, beside a
// limit on the reference machine.
cost::CostGate least_cost(const char* what, double limit_us, const Race& race, const Loop& loop,
                          double t_s, std::span<const world::DetectionFrame> frames) {
  double least_us = 1e9;
  cost::ReferenceCost reference;
  for (int run = 0; run < 50; ++run) {
    reference.again();
    reference.take();
    Loop copy;
    *copy.state = *loop.state;
    const Duration before = transport::thread_time();
    copy.step(race, t_s, frames);
    least_us = std::min(least_us, cost::microseconds_of(transport::thread_time() - before));
  }
  std::printf("%s: %.1f us, a reference unit %.1f us\n", what, least_us, reference.unit_us());
  return {.what = what, .cost_us = least_us, .unit_us = reference.unit_us(), .limit_us = limit_us};
}

TEST(TrackingCost, FrameWithSixCars) {
  const Race race = six_cars();
  const std::vector<world::DetectionFrame> frames = race.frames(0.0, 2.05, false, 1);
  Loop loop;
  loop.drive(race, 0.0, 2.0, {frames.begin(), frames.end() - 1});
  ASSERT_EQ(loop.last.opponents.cars.size(), 6U);
  EXPECT_TRUE(
      least_cost("frame with six cars", 30.0, race, loop, 2.01, {&frames.back(), 1}).held());
}

// The frame of one second ago comes last: 20 LiDAR frames are filtered again.
TEST(TrackingCost, FrameThatIsASecondLate) {
  const Race race = six_cars();
  std::vector<world::DetectionFrame> frames = race.frames(0.0, 2.0, false, 1);
  const auto late = std::ranges::find_if(
      frames, [](const world::DetectionFrame& f) { return f.at > at_s(1.03); });
  const world::DetectionFrame last = *late;
  frames.erase(late);
  Loop loop;
  loop.drive(race, 0.0, 2.0, frames);
  ASSERT_EQ(loop.last.opponents.cars.size(), 6U);
  EXPECT_TRUE(least_cost("a second late", 150.0, race, loop, 2.01, {&last, 1}).held());
}

// A thousand detections in one tick of 10 ms, after a second without any: half of it at most.
TEST(TrackingCost, AThousandDetectionsAtOnce) {
  Race race;
  for (int i = 0; i < 24; ++i)
    race.cars.push_back({.s_m = 110.0 + 6.0 * i, .n_m = i % 2 == 0 ? 5.0 : -5.0});
  Loop loop;
  loop.drive(race, 0.0, 2.0, race.frames(0.0, 1.0, false, 1));
  std::mt19937_64 random(12);
  std::vector<world::DetectionFrame> frames;
  for (std::uint8_t unit = 0; unit < 42; ++unit)
    frames.push_back(race.frame(2.0, world::DetectionSource::kLidar, unit, random));
  EXPECT_TRUE(least_cost("a thousand detections at once", 5000.0, race, loop, 2.01, frames).held());
}

}  // namespace
}  // namespace pitwall::tracking
