// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/reidentification.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/instants.hpp"
#include "tests/vehicle/autonomy/tracking/filter/circle.hpp"
#include "vehicle/autonomy/tracking/filter/life.hpp"
#include "vehicle/autonomy/tracking/filter/modes.hpp"
#include "vehicle/autonomy/tracking/filter/motion.hpp"

namespace pitwall::tracking {
namespace {

using testing::circle;

constexpr std::int64_t kNow_ms = 10'000;

Frame lidar_frame_at(std::int64_t ms) {
  static const Measurement one{.confidence = 0.8};
  return {
      .key = {at_ms(ms), world::DetectionSource::kLidar, 0}, .own = {}, .measurements = {&one, 1}};
}

// Confirmed, with first and newest detection, and the same sigma of place and speed.
Track track_of(std::int64_t first_ms, std::int64_t newest_ms, double s_m, double speed_mps,
               double sigma) {
  Track t;
  note_first(lidar_frame_at(first_ms), 0, t);
  note_detection(lidar_frame_at(newest_ms), 0, t);
  t.x = {s_m, 2.0, 0.0, speed_mps, 0.0, 0.0};
  const std::array<double, kRoadStates> variance{sigma * sigma, 0.1, 1e-3,
                                                 sigma * sigma, 1.0, 1e-3};
  for (std::size_t i = 0; i < kRoadStates; ++i) t.p[i][i] = variance[i];
  begin_modes(RoadParams{}, t);
  join_modes(t);
  return t;
}

Track lost_at(double s_m, double speed_mps, std::int64_t newest_ms = 8'000) {
  return track_of(newest_ms - 5'000, newest_ms, s_m, speed_mps, 3.0);
}

Track seen_at(double s_m, double speed_mps, std::int64_t first_ms = kNow_ms - 50) {
  Track t = track_of(first_ms, kNow_ms, s_m, speed_mps, 0.3);
  t.undecided = true;
  return t;
}

struct Cars {
  const world::TrackMap map = circle();
  RoadParams params;
  Tracks tracks;

  explicit Cars(std::initializer_list<Track> list) {
    for (const Track& t : list) add_track(t, tracks);
  }
  void identify_all() { identify(params, &map, seconds(5), lidar_frame_at(kNow_ms), tracks); }
};

TEST(Reidentification, CarThatCameBackHasItsName) {
  const Track lost = lost_at(300.0, 60.0), seen = seen_at(302.0, 61.0);
  Cars cars{lost, seen};
  cars.identify_all();
  ASSERT_EQ(cars.tracks.list.size(), 1U);
  const Track& t = cars.tracks.list[0];
  EXPECT_FALSE(t.undecided);
  EXPECT_EQ(t.first, lost.first);
  EXPECT_EQ(t.born_at, lost.born_at);
  EXPECT_EQ(t.newest, seen.newest);
}

TEST(Reidentification, CarThatIsNoneOfThemIsNew) {
  const Track seen = seen_at(500.0, 60.0);
  Cars cars{lost_at(300.0, 60.0), seen};
  cars.identify_all();
  ASSERT_EQ(cars.tracks.list.size(), 2U);
  EXPECT_FALSE(cars.tracks.list[1].undecided);
  EXPECT_EQ(cars.tracks.list[1].first, seen.first);
}

// Nearer to the place of one car, but slower than it could be there; the other one sped up.
TEST(Reidentification, SpeedCountsToo) {
  const Track fast = lost_at(300.0, 74.0), slow = lost_at(295.0, 52.0);
  Cars cars{fast, slow, seen_at(302.0, 58.0)};
  cars.identify_all();
  ASSERT_EQ(cars.tracks.list.size(), 2U);
  EXPECT_EQ(cars.tracks.list[0].first, fast.first);
  EXPECT_EQ(cars.tracks.list[1].first, slow.first);
}

// The first one alone is nearer to the car that only the second one can be.
TEST(Reidentification, TwoCarsAreAssignedTogether) {
  const Track a = lost_at(300.0, 60.0), b = lost_at(320.0, 60.0, 7'900);
  Cars cars{a, b, seen_at(312.0, 60.0, kNow_ms - 600), seen_at(331.0, 60.0, kNow_ms - 600)};
  cars.identify_all();
  ASSERT_EQ(cars.tracks.list.size(), 2U);
  EXPECT_EQ(cars.tracks.list[0].first, a.first);
  EXPECT_EQ(cars.tracks.list[1].first, b.first);
}

TEST(Reidentification, CarThatWasSeenAfterItIsAnother) {
  Cars cars{lost_at(300.0, 60.0, 9'500), seen_at(300.0, 60.0, 9'400)};
  cars.identify_all();
  EXPECT_EQ(cars.tracks.list.size(), 2U);
}

// After `coast` it is new for all others; it ends all the same.
TEST(Reidentification, CarThatWasGoneForLongGetsANewName) {
  for (const std::int64_t newest_ms : {4'951, 4'949}) {
    const Track lost = lost_at(300.0, 60.0, newest_ms), seen = seen_at(301.0, 60.0);
    Cars cars{lost, seen};
    cars.identify_all();
    ASSERT_EQ(cars.tracks.list.size(), 1U);
    EXPECT_EQ(cars.tracks.list[0].first, newest_ms == 4'951 ? lost.first : seen.first);
  }
}

// One mode and diagonal covariances: every state is the mean by the inverse variances.
TEST(Reidentification, StatesAreThoseOfBoth) {
  const Track lost = lost_at(300.0, 60.0), seen = seen_at(301.0, 61.0);
  Cars cars{lost, seen};
  cars.params.other_speed_share = cars.params.other_lane_share = 0.001;
  cars.params.lane_sigma_share = 1.0;
  cars.identify_all();
  ASSERT_EQ(cars.tracks.list.size(), 1U);
  const Track& t = cars.tracks.list[0];
  const double share = 9.0 / (9.0 + 0.09);
  EXPECT_NEAR(t.x[kAlong], 300.0 + share, 1e-9);
  EXPECT_NEAR(t.x[kSpeed], 60.0 + share, 1e-9);
  EXPECT_NEAR(t.p[kAlong][kAlong], share * 0.09, 1e-9);
  EXPECT_NEAR(t.p[kAccel][kAccel], 0.5, 1e-9);
}

}  // namespace
}  // namespace pitwall::tracking
