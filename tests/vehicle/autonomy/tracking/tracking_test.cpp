// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/tracking.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "tests/support/allocation_guard.hpp"
#include "tests/vehicle/autonomy/tracking/race.hpp"

namespace pitwall::tracking {
namespace {

using pitwall::testing::draw_uniform;
using testing::Car;
using testing::distance_m;
using testing::Loop;
using testing::Race;
using world::DetectionFrame;
using world::DetectionSource;

const world::Opponent* nearest_to(const Output& out, const testing::TruePose& p) {
  const world::Opponent* best = nullptr;
  for (const world::Opponent& o : out.opponents.cars)
    if (best == nullptr || distance_m(o, p) < distance_m(*best, p)) best = &o;
  return best;
}

TEST(Tracking, WithoutFramesNothingIsPublished) {
  Loop loop;
  for (int k = 0; k < 50; ++k) {
    const Output& out = loop.step(Race{}, 0.01 * k, {});
    EXPECT_FALSE(out.published);
    EXPECT_TRUE(out.opponents.cars.empty());
    EXPECT_EQ(out.opponents.at, at_s(0.01 * k));
  }
}

// Both methods: a car is published after two frames, at the time of the step.
TEST(Tracking, PublishesAfterTwoFrames) {
  for (const Method method : {Method::kPaper, Method::kRoad}) {
    const Race race{.cars = {{.s_m = 140.0, .n_m = 2.0}}, .noise = 0.0};
    const std::vector<DetectionFrame> frames = race.frames(0.0, 0.3, false, 1);
    Loop loop;
    loop.params.method = method;
    loop.drive(race, 0.0, 0.05, {frames[0]});
    EXPECT_TRUE(loop.last.opponents.cars.empty());
    EXPECT_TRUE(loop.step(race, 0.06, {&frames[1], 1}).published);
    ASSERT_EQ(loop.last.opponents.cars.size(), 1U);
    const world::Opponent& car = loop.last.opponents.cars[0];
    EXPECT_EQ(car.id, 1U);
    EXPECT_EQ(car.measured_at, frames[1].at);
    EXPECT_EQ(loop.last.opponents.at, at_ms(60));
    loop.drive(race, 0.07, 0.35, {frames.begin() + 2, frames.end()});
    EXPECT_LT(distance_m(loop.last.opponents.cars[0], race.cars[0].at(0.35)), 0.5);
    EXPECT_NEAR(loop.last.opponents.cars[0].speed_mps, 60.0, 1.0);
  }
}

// Root mean square of the errors at a distance over a minute. The bounds are those of the goals:
// 0.10 m below 60 m, 0.25 m at 100 m, 0.5 m/s.
void expect_accurate(double ahead_m, double within_m, bool all) {
  const Race race{
      .cars = {{.s_m = 100.0 + ahead_m, .n_m = 2.0, .speed_mps = 60.0, .swing_mps = 1.0}},
      .miss = 0.05};
  Loop loop;
  const std::vector<DetectionFrame> frames = race.frames(0.0, 60.0, all, 9);
  std::size_t next = 0;
  double place = 0.0, speed = 0.0;
  int count = 0;
  for (int k = 0; k < 6000; ++k) {
    const double t_s = 0.01 * k;
    const std::size_t first = next;
    while (next < frames.size() && frames[next].at + milliseconds(60) <= at_s(t_s)) ++next;
    loop.step(race, t_s, {frames.data() + first, next - first});
    if (k < 300) continue;
    const testing::TruePose truth = race.cars[0].at(t_s);
    const world::Opponent* car = nearest_to(loop.last, truth);
    ASSERT_NE(car, nullptr);
    place += std::pow(distance_m(*car, truth), 2),
        speed += std::pow(car->speed_mps - truth.speed_mps, 2);
    ++count;
  }
  EXPECT_LE(std::sqrt(place / count), within_m) << ahead_m;
  EXPECT_LE(std::sqrt(speed / count), 0.5) << ahead_m;
  std::printf("%.0f m ahead%s: %.3f m, %.3f m/s rms\n", ahead_m, all ? ", all sensors" : "",
              std::sqrt(place / count), std::sqrt(speed / count));
}

TEST(Tracking, IsAccurateNearby) { expect_accurate(30.0, 0.10, true); }
TEST(Tracking, IsAccurateAtSixtyMetres) { expect_accurate(55.0, 0.10, true); }
TEST(Tracking, IsAccurateAtAHundredMetres) { expect_accurate(100.0, 0.25, true); }
TEST(Tracking, LidarAloneIsAccurateAtAHundredMetres) { expect_accurate(100.0, 0.25, false); }

// Two cars side by side, 3 m apart, for a minute, with misses, false detections, and half a second
// without any detection every ten: each keeps its number.
TEST(Tracking, TwoCarsSideBySideKeepTheirNumbers) {
  const Race race{.cars = {{.s_m = 130.0, .n_m = 1.5, .speed_mps = 61.0, .swing_mps = 1.0},
                           {.s_m = 130.0, .n_m = -1.5, .speed_mps = 60.2, .swing_mps = 1.0}},
                  .miss = 0.1,
                  .false_detections = 0.05};
  for (const bool all : {false, true}) {
    Loop loop;
    std::vector<DetectionFrame> frames = race.frames(0.0, 60.0, all, 4);
    std::erase_if(frames,
                  [](const DetectionFrame& f) { return std::fmod(f.at.seconds(), 10.0) > 9.5; });
    std::size_t next = 0;
    std::array<std::set<std::uint32_t>, 2> ids;
    for (int k = 0; k <= 6000; ++k) {
      const double t_s = 0.01 * k;
      const std::size_t first = next;
      while (next < frames.size() && frames[next].at <= at_s(t_s)) ++next;
      loop.step(race, t_s, {frames.data() + first, next - first});
      if (k < 50) continue;
      for (std::size_t c = 0; c < 2; ++c) {
        const testing::TruePose truth = race.cars[c].at(t_s);
        const world::Opponent* car = nearest_to(loop.last, truth);
        ASSERT_NE(car, nullptr) << t_s;
        EXPECT_LT(distance_m(*car, truth), 1.5) << t_s << " " << c;
        ids[c].insert(car->id);
      }
    }
    EXPECT_EQ(ids[0].size(), 1U);
    EXPECT_EQ(ids[1].size(), 1U);
    EXPECT_NE(*ids[0].begin(), *ids[1].begin());
  }
}

// After 1.5 s in a blind spot the predicted place is within 1.5 m in 95 % of the seeds.
TEST(Tracking, BlindSpotOfOneAndAHalfSeconds) {
  int within = 0, within_three_sigmas = 0;
  constexpr int kSeeds = 100;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const Race race{.cars = {{.s_m = 115.0, .n_m = 1.0, .speed_mps = 60.5, .swing_mps = 1.0}}};
    Loop loop;
    loop.drive(race, 0.0, 6.5, race.frames(0.0, 5.0, true, static_cast<std::uint64_t>(seed)));
    ASSERT_EQ(loop.last.opponents.cars.size(), 1U);
    const world::Opponent& car = loop.last.opponents.cars[0];
    EXPECT_LT(car.measured_at, at_s(5.0));
    const double error_m = distance_m(car, race.cars[0].at(6.5));
    within += error_m <= 1.5 ? 1 : 0;
    within_three_sigmas +=
        error_m <= 3.0 * std::sqrt(car.covariance[0] + car.covariance[5]) ? 1 : 0;
  }
  EXPECT_GE(within, 95);
  EXPECT_GE(within_three_sigmas, 99);
  std::printf("within 1.5 m: %d of %d\n", within, kSeeds);
}

TEST(Tracking, CarEndsFiveSecondsAfterItsNewestDetection) {
  for (const Method method : {Method::kPaper, Method::kRoad}) {
    const Race race{.cars = {{.s_m = 115.0, .n_m = 1.0, .speed_mps = 60.5}}};
    Loop loop;
    loop.params.method = method;
    loop.drive(race, 0.0, 5.9, race.frames(0.0, 1.0, false, 1));
    ASSERT_EQ(loop.last.opponents.cars.size(), 1U);
    EXPECT_EQ(loop.last.opponents.cars[0].id, 1U);
    double sigma_before_m2 = 0.0;
    for (int k = 0; k < 4; ++k) {
      const world::Opponents& o = loop.step(race, 5.91 + 0.01 * k, {}).opponents;
      ASSERT_EQ(o.cars.size(), 1U);
      EXPECT_GT(o.cars[0].covariance[0] + o.cars[0].covariance[5], sigma_before_m2);
      sigma_before_m2 = o.cars[0].covariance[0] + o.cars[0].covariance[5];
    }
    loop.drive(race, 5.95, 6.0, {});
    EXPECT_TRUE(loop.last.opponents.cars.empty());
  }
}

// The same car after it has ended has another number.
TEST(Tracking, NumberIsNeverUsedAgain) {
  Race race{.cars = {{.s_m = 115.0, .n_m = 1.0}}};
  Loop loop;
  std::vector<DetectionFrame> frames = race.frames(0.0, 0.5, false, 1);
  for (const DetectionFrame& f : race.frames(6.0, 6.5, false, 2)) frames.push_back(f);
  loop.drive(race, 0.0, 7.0, frames);
  ASSERT_EQ(loop.last.opponents.cars.size(), 1U);
  EXPECT_EQ(loop.last.opponents.cars[0].id, 2U);
}

// Frames of anything: whatever the bytes are, the states stay finite, and every frame and detection
// has one count.
TEST(Tracking, NoInputBreaksIt) {
  std::mt19937_64 random(11);
  const std::array odd{
      0.0, -1.0, 1e-300, 1e300, -1e300, kUnset, 3.0, 50.0, std::numeric_limits<double>::infinity(),
      0.5};
  const auto any = [&] { return odd[random() % odd.size()]; };
  for (const Method method : {Method::kPaper, Method::kRoad})
    for (const world::TrackMap* track :
         {&testing::round_track(), static_cast<const world::TrackMap*>(nullptr)}) {
      const Race race{.cars = {{.s_m = 130.0}}};
      Loop loop{.track = track};
      loop.params.method = method;
      std::uint64_t frames = 0, detections = 0;
      for (int k = 0; k < 400; ++k) {
        std::vector<DetectionFrame> list(random() % 5);
        for (DetectionFrame& f : list) {
          f = race.frame(0.01 * k, DetectionSource::kLidar, 0, random);
          f.source = static_cast<DetectionSource>(random() % 4);
          f.unit = static_cast<std::uint8_t>(random());
          const std::array at{f.at, Instant{INT64_MIN}, Instant::max(), f.at - milliseconds(700),
                              Instant{static_cast<std::int64_t>(random())}};
          f.at = at[random() % at.size()];
          while (f.detections.size() < random() % 24)
            (void)f.detections.push(
                {any(), any(), any(), any(), any(), any(), any(), any(), any(), any()});
          ++frames;
        }
        const Output& out = loop.step(race, 0.01 * k, list);
        for (const world::Opponent& o : out.opponents.cars) {
          for (const double v : {o.x_m, o.y_m, o.yaw_rad, o.speed_mps, o.accel_mps2})
            ASSERT_TRUE(std::isfinite(v));
          for (const double v : o.covariance) ASSERT_TRUE(std::isfinite(v));
        }
      }
      const Counters& n = loop.last.counters;
      (void)detections;
      EXPECT_EQ(n.frames + n.frames_in_future + n.frames_too_old + n.frames_repeated +
                    n.frames_too_many + n.frames_unplaced + n.frames_unknown + n.frames_excluded,
                frames);
      EXPECT_GT(n.frames, 0U);
      EXPECT_GT(n.not_finite, 0U);
    }
}

// A thousand detections at once, in every tick of a second: the window has no more room.
TEST(Tracking, FloodIsRefusedAndCounted) {
  Race race;
  for (int i = 0; i < 24; ++i)
    race.cars.push_back({.s_m = 110.0 + 6.0 * i, .n_m = i % 2 == 0 ? 5.0 : -5.0});
  Loop loop;
  std::mt19937_64 random(12);
  for (int k = 0; k < 100; ++k) {
    std::vector<DetectionFrame> frames;
    for (std::uint8_t unit = 0; unit < 42; ++unit)
      frames.push_back(race.frame(0.01 * k, DetectionSource::kLidar, unit, random));
    loop.step(race, 0.01 * k, frames);
  }
  const Counters& n = loop.last.counters;
  EXPECT_GT(n.frames_too_many, 0U);
  EXPECT_EQ(n.frames + n.frames_too_many, 4200U);
  EXPECT_LE(loop.last.opponents.cars.size(), world::kOpponentsMax);
  // Later it goes on as before.
  race.cars.resize(3);
  loop.drive(race, 1.0, 9.0, race.frames(2.5, 9.0, false, 13));
  EXPECT_EQ(loop.last.opponents.cars.size(), 3U);
}

TEST(Tracking, AllocatesNothing) {
  if (!pitwall::testing::kAllocationsCounted) GTEST_SKIP() << "the sanitizer has its own heap";
  for (const Method method : {Method::kPaper, Method::kRoad}) {
    const Race race{.cars = {{.s_m = 140.0, .n_m = 2.0}, {.s_m = 170.0, .n_m = -2.0}}};
    std::vector<DetectionFrame> frames = race.frames(0.0, 3.0, true, 1);
    std::mt19937_64 random(1);
    std::ranges::shuffle(frames, random);
    Loop loop;
    loop.params.method = method;
    std::size_t count = 0;
    for (int k = 0; k < 300; ++k) {
      const std::array some{frames[static_cast<std::size_t>(k)],
                            frames[static_cast<std::size_t>(k + 50) % frames.size()]};
      count += pitwall::testing::allocations_of([&] { loop.step(race, 0.01 * k, some); });
    }
    EXPECT_EQ(count, 0U);
    EXPECT_GT(loop.last.counters.frames, 30U);
  }
}

// A copy goes on as the original.
TEST(Tracking, StateIsAValue) {
  const Race race{.cars = {{.s_m = 140.0, .n_m = 2.0}}};
  const std::vector<DetectionFrame> frames = race.frames(0.0, 2.0, true, 1);
  Loop one;
  one.drive(race, 0.0, 1.0, {frames.begin(), frames.begin() + 100});
  Loop two;
  *two.state = *one.state;
  one.drive(race, 1.01, 2.0, {frames.begin() + 100, frames.end()});
  two.drive(race, 1.01, 2.0, {frames.begin() + 100, frames.end()});
  ASSERT_EQ(one.last.opponents.cars.size(), two.last.opponents.cars.size());
  EXPECT_EQ(one.last.opponents.cars[0].x_m, two.last.opponents.cars[0].x_m);
}

}  // namespace
}  // namespace pitwall::tracking
