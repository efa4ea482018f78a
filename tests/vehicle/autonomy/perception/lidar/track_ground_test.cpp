// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/track_ground.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "tests/hil/traffic/oval.hpp"
#include "tests/support/draw.hpp"

namespace pitwall::perception {
namespace {

using Eigen::AngleAxisd, Eigen::Vector3d;

constexpr double kOverRoad_m = 0.3;

// Our car on the road at a station, with springs that gave way, and points of the road around it.
struct OnRoad {
  BodyPose pose;
  Eigen::Isometry3d body = Eigen::Isometry3d::Identity();  // in Map
  PointCloud points;

  LidarPoint seen(double s_m, double n_m, double over_m) const {
    const world::TrackPoint at = traffic::oval().offset(s_m, n_m);
    const double height_m = traffic::oval().road(s_m, n_m).height_m + over_m;
    const Vector3d p = body.inverse() * Vector3d{at.x_m, at.y_m, height_m};
    return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
  }
};

OnRoad on_road(double s_m, double n_m, double roll_rad, double pitch_rad, double sunk_m) {
  const world::TrackPoint at = traffic::oval().offset(s_m, n_m);
  const world::RoadPoint road = traffic::oval().road(s_m, n_m);
  OnRoad car{.pose = {at.x_m, at.y_m, at.yaw_rad, kOverRoad_m}, .points = {}};
  car.body.translate(Vector3d{at.x_m, at.y_m, road.height_m + kOverRoad_m - sunk_m});
  car.body.rotate(AngleAxisd(at.yaw_rad, Vector3d::UnitZ()) *
                  AngleAxisd(pitch_rad, Vector3d::UnitY()) *
                  AngleAxisd(roll_rad - road.bank_rad, Vector3d::UnitX()));
  std::mt19937_64 random{5};
  for (int i = 0; i < 20'000; ++i)
    car.points.push_back(car.seen(s_m + testing::draw_uniform(random, -50.0, 50.0),
                                  testing::draw_uniform(random, -7.5, 7.5),
                                  testing::draw_normal(random, 0.02)));
  return car;
}

TEST(TrackGround, FollowsTheSpringsToACentimetre) {
  const TrackGrid grid{traffic::oval()};
  for (const double s_m : {150.0, 600.0, 1'300.0}) {
    for (const double tilt_rad : {0.0, 0.012, -0.012}) {
      const OnRoad car = on_road(s_m, -2.0, tilt_rad, 0.7 * tilt_rad, 2.0 * std::abs(tilt_rad));
      const auto ground = TrackGround::fit(grid, car.pose, car.points);
      ASSERT_TRUE(ground);
      EXPECT_GT(ground->points(), 3'000U);
      for (const double ahead_m : {-80.0, -20.0, 5.0, 40.0, 80.0}) {
        for (const double over_m : {0.0, 0.5, 1.2}) {
          const auto at = ground->at(car.seen(s_m + ahead_m, 3.0, over_m));
          ASSERT_TRUE(at);
          EXPECT_NEAR(at->over_m, over_m, 0.03) << s_m << ' ' << ahead_m << ' ' << tilt_rad;
          EXPECT_NEAR(at->place.n_m, 3.0, 0.15);
          EXPECT_NEAR(ground->ahead_m(at->place), ahead_m, 0.2);
        }
      }
    }
  }
}

TEST(TrackGround, IsNotLiftedByCarsAndDust) {
  const TrackGrid grid{traffic::oval()};
  OnRoad car = on_road(150.0, 0.0, 0.005, 0.01, 0.01);
  std::mt19937_64 random{6};
  for (int i = 0; i < 6'000; ++i)
    car.points.push_back(car.seen(165.0 + testing::draw_uniform(random, -4.0, 4.0),
                                  testing::draw_uniform(random, -3.0, 3.0),
                                  testing::draw_uniform(random, 0.0, 1.5)));
  const auto ground = TrackGround::fit(grid, car.pose, car.points);
  ASSERT_TRUE(ground);
  for (const double ahead_m : {-60.0, 10.0, 60.0})
    EXPECT_NEAR(ground->at(car.seen(150.0 + ahead_m, 1.0, 0.0))->over_m, 0.0, 0.05) << ahead_m;
}

TEST(TrackGround, HeightIsTheInverse) {
  const TrackGrid grid{traffic::oval()};
  const OnRoad car = on_road(600.0, 1.0, 0.01, -0.01, 0.0);
  const auto ground = TrackGround::fit(grid, car.pose, car.points);
  ASSERT_TRUE(ground);
  for (const double x_m : {-30.0, 0.0, 25.0}) {
    const LidarPoint foot{static_cast<float>(x_m), 1.5F,
                          static_cast<float>(ground->height_m(x_m, 1.5))};
    EXPECT_NEAR(ground->at(foot)->over_m, 0.0, 0.002) << x_m;
  }
  EXPECT_TRUE(std::isnan(ground->height_m(0.0, 50.0))) << "beyond the walls";
}

TEST(TrackGround, APlaceOfTheRoadInBodyIsTheInverseToo) {
  const TrackGrid grid{traffic::oval()};
  for (const double s_m : {100.0, 480.0}) {  // on a straight, in a banked turn
    const OnRoad car = on_road(s_m, 1.0, 0.01, -0.008, 0.02);
    const auto ground = TrackGround::fit(grid, car.pose, car.points);
    ASSERT_TRUE(ground);
    for (const double ahead_m : {-90.0, -3.0, 0.0, 40.0, 110.0})
      for (const double n_m : {-4.0, 0.0, 3.5}) {
        const TrackGround::RoadInBody road = ground->in_body(ahead_m, n_m);
        const auto at = ground->at({static_cast<float>(road.x_m), static_cast<float>(road.y_m),
                                    static_cast<float>(road.z_m)});
        ASSERT_TRUE(at);
        EXPECT_NEAR(ground->ahead_m(at->place), ahead_m, 0.03) << s_m;
        EXPECT_NEAR(at->place.n_m, n_m, 0.03) << s_m;
        EXPECT_NEAR(at->over_m, 0.0, 0.03) << s_m;
        EXPECT_NEAR(road.yaw_rad, ground->yaw_rad(at->place), 0.01) << s_m;
      }
  }
}

TEST(TrackGround, WithoutPointsIsTheMapAsItStands) {
  const TrackGrid grid{traffic::oval()};
  const OnRoad car = on_road(600.0, 0.0, 0.0, 0.0, 0.0);
  const auto ground = TrackGround::fit(grid, car.pose, {});
  ASSERT_TRUE(ground);
  EXPECT_EQ(ground->points(), 0U);
  EXPECT_NEAR(ground->at(car.seen(620.0, 2.0, 0.7))->over_m, 0.7, 0.01);
}

TEST(TrackGround, OffTheTrackThereIsNone) {
  const TrackGrid grid{traffic::oval()};
  const world::TrackPoint beside = traffic::oval().offset(100.0, 30.0);
  EXPECT_FALSE(TrackGround::fit(grid, {beside.x_m, beside.y_m, 0.0, kOverRoad_m}, {}));
  EXPECT_FALSE(TrackGround::fit(grid, {}, {})) << "a pose that is not known";
}

}  // namespace
}  // namespace pitwall::perception
