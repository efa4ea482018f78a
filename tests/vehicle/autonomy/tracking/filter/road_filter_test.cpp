// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/road_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/instants.hpp"
#include "tests/vehicle/autonomy/tracking/filter/circle.hpp"
#include "vehicle/autonomy/tracking/filter/courses.hpp"
#include "vehicle/autonomy/tracking/filter/modes.hpp"
#include "vehicle/autonomy/tracking/filter/motion.hpp"

namespace pitwall::tracking {
namespace {

using testing::Car;
using testing::circle;
using testing::draw_normal;
using testing::measured;
using testing::own_motion;
using testing::seen;
using testing::TruePose;
using world::DetectionSource;

const Car kOwnCar{.s_m = 100.0, .n_m = -3.0, .speed_mps = 55.0};

// Frames of one sensor at 20 Hz, without noise but what `change` does to a detection.
struct Drive {
  const world::TrackMap map = circle();
  RoadParams params;
  bool with_map = true;
  Tracks tracks;

  const world::TrackMap* ground() const { return with_map ? &map : nullptr; }

  template <class Change>
  void see(double t_s, DetectionSource source, const std::vector<TruePose>& cars, Change&& change) {
    const TruePose own = kOwnCar.at(t_s);
    std::vector<Measurement> list;
    for (const TruePose& car : cars) {
      list.push_back(measured(source, seen(source, own, car)));
      change(list.back());
    }
    filter_road(params, ground(), seconds(5),
                {.key = {at_s(t_s), source, 0}, .own = own_motion(own), .measurements = list},
                tracks);
    for (Track& track : tracks.list) join_modes(track);
  }
  void see(double t_s, DetectionSource source, const std::vector<TruePose>& cars) {
    see(t_s, source, cars, [](Measurement&) {});
  }
};

void expect_at(const world::Opponent& o, const TruePose& truth, double within_m,
               double within_mps) {
  EXPECT_NEAR(std::hypot(o.x_m - truth.x_m, o.y_m - truth.y_m), 0.0, within_m);
  EXPECT_NEAR(o.speed_mps, truth.speed_mps, within_mps);
  EXPECT_NEAR(wrap_pi(o.yaw_rad - truth.yaw_rad), 0.0, 0.02);
}

// Each sensor alone, with a map and without: two frames confirm, two seconds find place and speed.
TEST(RoadFilter, EachSensorAloneFindsTheCar) {
  for (const bool with_map : {true, false})
    for (const DetectionSource source :
         {DetectionSource::kLidar, DetectionSource::kRadar, DetectionSource::kCamera}) {
      SCOPED_TRACE(with_map);
      SCOPED_TRACE(static_cast<int>(source));
      const Car car{.s_m = 150.0, .n_m = 4.0, .speed_mps = 58.0};
      Drive drive;
      drive.with_map = with_map;
      drive.see(0.0, source, {car.at(0.0)});
      ASSERT_EQ(drive.tracks.list.size(), 1U);
      EXPECT_FALSE(drive.tracks.list[0].confirmed);
      for (int i = 1; i <= 60; ++i) drive.see(0.05 * i, source, {car.at(0.05 * i)});
      ASSERT_EQ(drive.tracks.list.size(), 1U);
      EXPECT_TRUE(drive.tracks.list[0].confirmed);
      EXPECT_EQ(drive.tracks.list[0].born_at, at_ms(50));
      expect_at(road_opponent(drive.ground(), drive.tracks.list[0]), car.at(3.0), 0.3, 0.5);
    }
}

// Every second box is turned around, from the first on: the direction of motion is right.
TEST(RoadFilter, TurnedBoxesChangeNothing) {
  for (const bool with_map : {true, false}) {
    const Car car{.s_m = 150.0, .n_m = 4.0, .speed_mps = 58.0};
    Drive plain, turned;
    plain.with_map = turned.with_map = with_map;
    for (int i = 0; i < 40; ++i) {
      plain.see(0.05 * i, DetectionSource::kLidar, {car.at(0.05 * i)});
      turned.see(0.05 * i, DetectionSource::kLidar, {car.at(0.05 * i)}, [&](Measurement& m) {
        if (i % 2 == 0) m.value[2] = wrap_pi(m.value[2] + std::numbers::pi);
      });
    }
    ASSERT_EQ(turned.tracks.list.size(), 1U);
    for (std::size_t i = 0; i < kRoadStates; ++i)
      EXPECT_NEAR(turned.tracks.list[0].x[i], plain.tracks.list[0].x[i], 1e-9) << i;
  }
}

// On a plane a car that comes towards us is first taken for one that drives as we do.
TEST(RoadFilter, OncomingCarIsTurnedAround) {
  Drive drive;
  drive.with_map = false;
  const auto oncoming = [](double t_s) {
    return TruePose{250.0 - 20.0 * t_s, 40.0, std::numbers::pi, 20.0};
  };
  for (int i = 0; i < 40; ++i) drive.see(0.05 * i, DetectionSource::kLidar, {oncoming(0.05 * i)});
  ASSERT_EQ(drive.tracks.list.size(), 1U);
  expect_at(road_opponent(nullptr, drive.tracks.list[0]), oncoming(1.95), 0.1, 0.3);
}

TEST(RoadFilter, BearingAloneBeginsNoTrackButImprovesOne) {
  const Car car{.s_m = 190.0, .n_m = 4.0, .speed_mps = 58.0};
  const auto without_depth = [](Measurement& m) { m.value[1] = kUnset; };
  Drive drive;
  drive.see(0.0, DetectionSource::kCamera, {car.at(0.0)}, without_depth);
  EXPECT_EQ(drive.tracks.list.size(), 0U);
  drive.see(0.1, DetectionSource::kCamera, {car.at(0.1)});
  drive.see(0.2, DetectionSource::kCamera, {car.at(0.2)});
  Drive other = drive;
  drive.see(0.3, DetectionSource::kCamera, {car.at(0.3)}, without_depth);
  other.see(0.3, DetectionSource::kCamera, {});
  ASSERT_EQ(drive.tracks.list.size(), 1U);
  EXPECT_LT(drive.tracks.list[0].p[kAcross][kAcross], other.tracks.list[0].p[kAcross][kAcross]);
  EXPECT_EQ(drive.tracks.list[0].detections, 3U);
}

// Nothing else is at the place of a car, and a detection just outside of its gate is no second one.
TEST(RoadFilter, StrayDetectionOfAKnownCarBeginsNoTrack) {
  const Car car{.s_m = 150.0, .n_m = 0.0, .speed_mps = 58.0};
  Drive drive;
  for (int i = 0; i < 20; ++i) drive.see(0.05 * i, DetectionSource::kLidar, {car.at(0.05 * i)});
  Car stray = car;
  stray.n_m = 1.5;
  drive.see(1.0, DetectionSource::kLidar, {stray.at(1.0)});
  EXPECT_EQ(drive.tracks.list.size(), 1U);
  EXPECT_EQ(drive.tracks.list[0].detections, 20U) << "and it is not used";
}

// What is seen near a car that was out of sight may be something else: one detection changes
// nothing, two are the car.
TEST(RoadFilter, LostCarIsFoundByTwoDetections) {
  const Car car{.s_m = 150.0, .n_m = 0.0, .speed_mps = 58.0};
  Drive drive;
  for (int i = 0; i < 20; ++i) drive.see(0.05 * i, DetectionSource::kLidar, {car.at(0.05 * i)});
  const DetectionKey first = drive.tracks.list[0].first;
  drive.see(2.5, DetectionSource::kLidar, {});
  Drive unseen = drive;
  Car other = car;
  other.n_m = 1.0;
  drive.see(2.55, DetectionSource::kLidar, {other.at(2.55)});
  drive.see(2.6, DetectionSource::kLidar, {});
  unseen.see(2.55, DetectionSource::kLidar, {});
  unseen.see(2.6, DetectionSource::kLidar, {});
  ASSERT_EQ(drive.tracks.list.size(), 1U);
  for (std::size_t i = 0; i < kRoadStates; ++i)
    EXPECT_EQ(drive.tracks.list[0].x[i], unseen.tracks.list[0].x[i]) << i;
  for (const double t_s : {2.65, 2.7}) drive.see(t_s, DetectionSource::kLidar, {car.at(t_s)});
  ASSERT_EQ(drive.tracks.list.size(), 1U);
  EXPECT_TRUE(drive.tracks.list[0].confirmed);
  EXPECT_EQ(drive.tracks.list[0].first, first);
  EXPECT_EQ(drive.tracks.list[0].newest.frame.at, at_s(2.7));
}

// A car that brakes while nothing is seen of it is where no steady car can be; it keeps its name.
TEST(RoadFilter, CarThatBrakedOutOfSightIsTheSame) {
  const Car car{.s_m = 150.0, .n_m = 0.0, .speed_mps = 58.0};
  Drive drive;
  for (int i = 0; i <= 60; ++i) drive.see(0.05 * i, DetectionSource::kLidar, {car.at(0.05 * i)});
  const DetectionKey first = drive.tracks.list[0].first;
  const auto braked = [&](double t_s) {
    Car slower = car;
    slower.s_m -= 0.5 * 5.0 * (t_s - 3.0) * (t_s - 3.0), slower.speed_mps = 58.0;
    TruePose pose = slower.at(t_s);
    pose.speed_mps -= 5.0 * (t_s - 3.0);
    return pose;
  };
  drive.see(4.95, DetectionSource::kLidar, {});
  const Track& lost = drive.tracks.list[0];
  EXPECT_LT(6.0 * std::sqrt(lost.p[kAlong][kAlong]), 0.5 * 5.0 * 1.95 * 1.95);
  for (int i = 100; i < 104; ++i) drive.see(0.05 * i, DetectionSource::kLidar, {braked(0.05 * i)});
  ASSERT_EQ(drive.tracks.list.size(), 1U);
  EXPECT_EQ(drive.tracks.list[0].first, first);
  EXPECT_NEAR(drive.tracks.list[0].x[kSpeed], braked(5.15).speed_mps, 3.0);
}

// Two cars out of sight, one of them for longer than cars are shown. What is seen near its place
// is not the other one, whose gate is as wide.
TEST(RoadFilter, CarThatWasGoneForLongIsNoOther) {
  const Car near{.s_m = 150.0, .n_m = -5.0, .speed_mps = 58.0},
      far{.s_m = 165.0, .n_m = 5.0, .speed_mps = 58.0};
  Drive drive;
  for (int i = 0; i < 60; ++i)
    drive.see(0.05 * i, DetectionSource::kLidar, {near.at(0.05 * i), far.at(0.05 * i)});
  ASSERT_EQ(drive.tracks.list.size(), 2U);
  const DetectionKey first_near = drive.tracks.list[0].first;
  for (int i = 60; i < 120; ++i) drive.see(0.05 * i, DetectionSource::kLidar, {near.at(0.05 * i)});
  for (int i = 120; i < 180; ++i) drive.see(0.05 * i, DetectionSource::kLidar, {});
  for (int i = 180; i < 183; ++i) drive.see(0.05 * i, DetectionSource::kLidar, {far.at(0.05 * i)});
  ASSERT_EQ(drive.tracks.list.size(), 2U);
  EXPECT_EQ(drive.tracks.list[0].first, first_near);
  EXPECT_EQ(drive.tracks.list[1].first.frame.at, at_s(9.0)) << "six seconds later: a new name";
}

// A car just outside of the wide gate of one that has ended for the others is seen at once.
TEST(RoadFilter, CarThatWasGoneForLongHidesNoNewOne) {
  Drive drive;
  const Car gone{.s_m = 150.0, .n_m = -5.0, .speed_mps = 58.0};
  for (int i = 0; i < 60; ++i) drive.see(0.05 * i, DetectionSource::kLidar, {gone.at(0.05 * i)});
  drive.see(8.4, DetectionSource::kLidar, {});
  ASSERT_EQ(drive.tracks.list.size(), 1U);
  const Track unseen =
      courses_of(drive.params, from_seconds(5.45), drive.tracks.list[0]).track[kOtherLane];
  Car fresh = gone;
  fresh.s_m += 6.2 * std::sqrt(unseen.p[kAlong][kAlong]);  // the gate is 5.1, stray ones up to 7.2
  for (const double t_s : {8.4, 8.45, 8.5})
    drive.see(t_s + 0.01, DetectionSource::kLidar, {fresh.at(t_s + 0.01)});
  ASSERT_EQ(drive.tracks.list.size(), 2U);
  EXPECT_TRUE(drive.tracks.list[1].confirmed);
}

// A car that brakes is in a maneuver, one that goes on is not.
TEST(RoadFilter, BrakingIsAManeuver) {
  const Car car{.s_m = 150.0, .n_m = 0.0, .speed_mps = 58.0};
  Drive drive;
  const auto braking = [&](double t_s) {
    Car slower = car;
    const double for_s = std::max(0.0, t_s - 3.0);
    slower.s_m -= 0.5 * 5.0 * for_s * for_s;
    return slower.at(t_s);
  };
  for (int i = 0; i < 60; ++i) drive.see(0.05 * i, DetectionSource::kLidar, {braking(0.05 * i)});
  EXPECT_GT(drive.tracks.list[0].modes.share[kSteady], 0.9);
  for (int i = 60; i < 80; ++i) drive.see(0.05 * i, DetectionSource::kLidar, {braking(0.05 * i)});
  EXPECT_LT(drive.tracks.list[0].modes.share[kSteady], 0.1);
}

// The radar misses a car for 0.3 s in which it begins to brake: what was steady until then expects
// another range rate, but a car may have begun a maneuver.
TEST(RoadFilter, CarThatBrakesInAGapKeepsItsTrack) {
  const Car car{.s_m = 150.0, .n_m = 0.0, .speed_mps = 58.0};
  Drive drive;
  for (int i = 0; i < 100; ++i) drive.see(0.05 * i, DetectionSource::kRadar, {car.at(0.05 * i)});
  constexpr double kGap_s = 0.3, kAgain_s = 4.95 + kGap_s, kBrake_mps2 = 6.0;
  Car behind = car;
  behind.s_m -= 0.5 * kBrake_mps2 * kGap_s * kGap_s;
  TruePose slower = behind.at(kAgain_s);
  slower.speed_mps -= kBrake_mps2 * kGap_s;
  drive.see(kAgain_s, DetectionSource::kRadar, {slower});
  ASSERT_EQ(drive.tracks.list.size(), 1U);
  EXPECT_EQ(drive.tracks.list[0].newest.frame.at, at_s(kAgain_s));
}

TEST(RoadFilter, SecondCarBesideIsASecondTrack) {
  const Car left{.s_m = 150.0, .n_m = 1.3, .speed_mps = 58.0},
      right{.s_m = 150.0, .n_m = -1.3, .speed_mps = 58.0};
  Drive drive;
  for (int i = 0; i < 20; ++i) drive.see(0.05 * i, DetectionSource::kLidar, {left.at(0.05 * i)});
  for (int i = 20; i < 22; ++i)
    drive.see(0.05 * i, DetectionSource::kLidar, {left.at(0.05 * i), right.at(0.05 * i)});
  ASSERT_EQ(drive.tracks.list.size(), 2U);
  EXPECT_TRUE(drive.tracks.list[1].confirmed);
}

TEST(RoadFilter, SizeIsASlowAverage) {
  const Car car{.s_m = 150.0, .n_m = 4.0, .speed_mps = 58.0};
  Drive drive;
  for (int i = 0; i < 400; ++i)
    drive.see(0.05 * i, DetectionSource::kLidar, {car.at(0.05 * i)}, [&](Measurement& m) {
      m.value[3] = i % 2 == 0 ? 4.5 : 5.3;
      if (i == 399) m.value[3] = 12.0;
    });
  ASSERT_EQ(drive.tracks.list.size(), 1U);
  // 4.9, and 2 % of the last one's difference.
  EXPECT_NEAR(drive.tracks.list[0].length_m, 4.9 + 0.02 * 7.1, 0.02);
  EXPECT_NEAR(drive.tracks.list[0].width_m, 1.9, 1e-12);
}

// A radar's first detection knows the speed along the line of sight.
TEST(RoadFilter, RangeRateBeginsTheSpeed) {
  const Car car{.s_m = 160.0, .n_m = -3.0, .speed_mps = 75.0};
  Drive drive;
  drive.see(0.0, DetectionSource::kRadar, {car.at(0.0)});
  ASSERT_EQ(drive.tracks.list.size(), 1U);
  EXPECT_NEAR(drive.tracks.list[0].x[kSpeed], 75.0, 3.0);
  EXPECT_LT(drive.tracks.list[0].p[kSpeed][kSpeed], 100.0);
}

// As published: the covariance is that of x, y, yaw and speed, symmetric and positive.
TEST(RoadFilter, PublishedCovarianceIsOfMap) {
  const Car car{.s_m = 350.0, .n_m = 4.0, .speed_mps = 58.0};
  Drive drive;
  std::mt19937_64 random(3);
  for (int i = 0; i < 40; ++i)
    drive.see(0.05 * i, DetectionSource::kCamera, {car.at(0.05 * i)}, [&](Measurement& m) {
      m.value[0] += 0.003 * draw_normal(random), m.value[1] += 0.0005 * draw_normal(random);
    });
  ASSERT_GE(drive.tracks.list.size(), 1U);
  const Track& track = drive.tracks.list[0];
  const world::Opponent o = road_opponent(&drive.map, track);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_GT(o.covariance[5 * i], 0.0);
    for (std::size_t j = 0; j < 4; ++j)
      EXPECT_NEAR(o.covariance[4 * i + j], o.covariance[4 * j + i], 1e-9);
  }
  const double left = 1.0 - track.x[kAcross] / testing::kRadius_m;
  EXPECT_NEAR(o.covariance[0] + o.covariance[5],  // the trace does not depend on the direction
              left * left * track.p[kAlong][kAlong] + track.p[kAcross][kAcross], 1e-6);
  EXPECT_NEAR(o.covariance[15], track.p[kSpeed][kSpeed], 1e-12);
}

}  // namespace
}  // namespace pitwall::tracking
