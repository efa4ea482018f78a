// SPDX-License-Identifier: Apache-2.0
// The order in which frames arrive changes no state, as long as they arrive within the window.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicle/autonomy/tracking/race.hpp"
#include "vehicle/autonomy/tracking/filter/modes.hpp"

namespace pitwall::tracking {
namespace {

using pitwall::testing::draw_uniform;
using testing::Loop;
using testing::Race;

constexpr double kEnd_s = 3.0, kWindow_s = 1.0, kBound = 1e-9;

// Cars that are there from the first frame on, one that comes within reach, false detections.
Race busy_race() {
  return {.cars = {{.s_m = 120.0, .n_m = 3.0, .speed_mps = 62.0, .swing_mps = 3.0},
                   {.s_m = 124.0, .n_m = 0.0, .speed_mps = 62.0},
                   {.s_m = 85.0, .n_m = 4.0, .speed_mps = 58.0},
                   {.s_m = 380.0, .n_m = -4.0, .speed_mps = 20.0},
                   {.s_m = 150.0, .n_m = -6.0, .speed_mps = 50.0}},
          .miss = 0.2,
          .false_detections = 0.3};
}

void expect_same(const Tracks& a, const Tracks& b) {
  ASSERT_EQ(a.list.size(), b.list.size());
  EXPECT_EQ(a.at, b.at);
  for (std::size_t t = 0; t < a.list.size(); ++t) {
    Track p = a.list[t], q = b.list[t];
    join_modes(p), join_modes(q);
    EXPECT_EQ(p.first, q.first);
    EXPECT_EQ(p.newest, q.newest);
    EXPECT_EQ(p.confirmed, q.confirmed);
    EXPECT_EQ(p.born_at, q.born_at);
    EXPECT_EQ(p.detections, q.detections);
    for (std::size_t i = 0; i < kStates; ++i) {
      EXPECT_NEAR(p.x[i], q.x[i], kBound);
      for (std::size_t j = 0; j < kStates; ++j) EXPECT_NEAR(p.p[i][j], q.p[i][j], kBound);
    }
    if (std::isfinite(p.length_m)) {
      EXPECT_NEAR(p.length_m, q.length_m, kBound);
    }
  }
}

void delay(std::vector<world::DetectionFrame>& frames, double most_s, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (world::DetectionFrame& f : frames)
    f.received = f.at + from_seconds(draw_uniform(random, 0.0, most_s));
}

void expect_order_is_nothing(const world::TrackMap* track, double most_s, int seeds) {
  const Race race = busy_race();
  for (int seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(seed);
    const auto number = static_cast<std::uint64_t>(seed);
    std::vector<world::DetectionFrame> frames = race.frames(0.05, kEnd_s, true, number);
    Loop in_order{.track = track}, shuffled{.track = track};
    in_order.drive(race, 0.0, kEnd_s + kWindow_s, frames);
    delay(frames, most_s, number);
    shuffled.drive(race, 0.0, kEnd_s + kWindow_s, frames);
    ASSERT_EQ(shuffled.last.counters.frames, frames.size()) << "every one was used";
    ASSERT_GE(in_order.last.opponents.cars.size(), 4U);
    expect_same(in_order.state->tracks, shuffled.state->tracks);
    EXPECT_EQ(in_order.last.opponents.cars.size(), shuffled.last.opponents.cars.size());
  }
}

// A tick more of age is over the window.
TEST(ArrivalOrder, IsNothingWithinTheWindow) {
  expect_order_is_nothing(&testing::round_track(), kWindow_s - 0.011, 20);
}
TEST(ArrivalOrder, IsNothingOnAPlane) { expect_order_is_nothing(nullptr, kWindow_s - 0.011, 10); }
TEST(ArrivalOrder, IsNothingForUsualDelays) {
  expect_order_is_nothing(&testing::round_track(), 0.15, 10);
}

// The second half of the frames first, the first half a second late, at once.
TEST(ArrivalOrder, IsNothingForABlock) {
  const Race race = busy_race();
  std::vector<world::DetectionFrame> frames = race.frames(0.05, 1.0, true, 5);
  Loop in_order, blocks;
  in_order.drive(race, 0.0, 2.0, frames);
  for (world::DetectionFrame& f : frames)
    if (f.at < at_ms(500)) f.received = at_ms(1040);
  blocks.drive(race, 0.0, 2.0, frames);
  expect_same(in_order.state->tracks, blocks.state->tracks);
}

// The number of a car stays the same when a late frame shows that it was there before.
TEST(ArrivalOrder, LateFirstDetectionKeepsTheNumber) {
  const Race race{.cars = {{.s_m = 140.0, .n_m = 2.0, .speed_mps = 60.0}}};
  std::vector<world::DetectionFrame> frames = race.frames(0.05, 1.0, false, 3);
  frames[0].received = at_ms(700);
  Loop loop;
  loop.drive(race, 0.0, 0.65, {frames.begin(), frames.begin() + 12});
  ASSERT_EQ(loop.last.opponents.cars.size(), 1U);
  const std::uint32_t id = loop.last.opponents.cars[0].id;
  const Instant born = loop.last.opponents.cars[0].born_at;
  Loop late;
  late.drive(race, 0.0, 1.0, frames);
  ASSERT_EQ(late.last.opponents.cars.size(), 1U);
  EXPECT_EQ(late.last.opponents.cars[0].id, id);
  EXPECT_EQ(late.state->names.given, 1U);
  EXPECT_LT(late.last.opponents.cars[0].born_at, born);
}

}  // namespace
}  // namespace pitwall::tracking
