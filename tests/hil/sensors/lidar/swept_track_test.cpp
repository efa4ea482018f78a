// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/lidar/swept_track.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "hil/sensors/lidar/body_motion.hpp"
#include "hil/sensors/lidar/car_mesh.hpp"
#include "hil/sensors/lidar/track_mesh.hpp"
#include "tests/hil/traffic/oval_cars.hpp"

namespace pitwall::sensors {
namespace {

using traffic::kOrigin_m;

LidarUnit coarse() {
  LidarUnit unit = av21_lidars()[0];
  unit.pattern.rings = 30, unit.pattern.ring_step_rad *= 2.0, unit.pattern.ring_period_s *= 2.0;
  unit.pattern.ray_step_rad *= 3.0;
  unit.errors.range_sigma_m = 0.0, unit.errors.lost_share = 0.0;
  return unit;
}

const SweptTrack& swept() {
  static const SweptTrack made =
      SweptTrack::make(traffic::oval(), {coarse()}, car_meshes(av21_shape()),
                       {.step_m = 25.0, .offset_m = [](double) { return 1.0; }});
  return made;
}

BodyMotion body_at(double s_m, double n_m, double origin_m, double turned_rad = 0.0) {
  plant::CarPose pose = traffic::pose_on_oval(s_m, n_m, 60.0);
  pose.yaw_rad += turned_rad;
  return motion_on_road(traffic::oval(), pose, origin_m);
}

std::vector<LidarReturn> sweep_at(double s_m, double n_m, double turned_rad,
                                  const std::vector<BodyMotion>& others) {
  Noise noise{3, 0};
  return swept().sweep(0, body_at(s_m, n_m, kOrigin_m, turned_rad), s_m, others, noise);
}

// Between two of the places, in another lane, at an angle to the road and at speed.
TEST(SweptTrack, WhatStandsStillIsWhereItStands) {
  const BodyMotion ours = body_at(112.0, -2.0, kOrigin_m, 0.03);
  std::size_t on_road = 0, on_walls = 0;
  for (const LidarReturn& back : sweep_at(112.0, -2.0, 0.03, {})) {
    const SensorFrame pose = frame_of(coarse().mount, after(ours, back.after_s));
    const Vector3 at = plus(pose.at_m, turned(pose.axes, {back.x_m, back.y_m, back.z_m}));
    const world::Curvilinear place = traffic::oval().project(at[0], at[1]);
    const double over_m = at[2] - traffic::oval().road(place.s_m, place.n_m).height_m;
    if (std::abs(place.n_m) < traffic::kWall_m - 0.3) {
      EXPECT_NEAR(over_m, 0.0, 0.05) << place.s_m << ' ' << place.n_m;
      ++on_road;
    } else if (over_m > 0.2 && over_m < 1.0 && std::abs(place.n_m) < traffic::kWall_m + 0.7) {
      ++on_walls;
    }
  }
  EXPECT_GT(on_road, 1000U);
  EXPECT_GT(on_walls, 100U);
}

// As if all were shot anew.
TEST(SweptTrack, CarsSendBackAsManyRaysAsInAWholeSweepAndHideWhatIsBehind) {
  const std::vector<BodyMotion> others{body_at(127.0, -3.0, 0.0), body_at(150.0, 1.5, 0.0),
                                       body_at(118.0, 3.0, 0.0)};
  RayScene whole{track_meshes(traffic::oval())};
  for (std::size_t i = 0; i < others.size(); ++i) whole.add_car(car_meshes(av21_shape()));
  Noise noise{3, 0};
  std::map<int, double> anew, made;
  for (const auto& back :
       lidar_sweep(coarse(), whole, {body_at(112.0, -2.0, kOrigin_m), others, {}}, noise))
    ++anew[back.car];
  for (const auto& back : sweep_at(112.0, -2.0, 0.0, others)) ++made[back.car];
  for (int car = 0; car < 3; ++car) {
    ASSERT_GT(anew[car], 10.0) << car;
    EXPECT_NEAR(made[car], anew[car], 0.05 * anew[car] + 3.0) << car;
  }
  EXPECT_NEAR(made[-1], anew[-1], 0.05 * anew[-1]);
}

TEST(SweptTrack, ACarRightBesideIsMetToo) {
  const auto returns = sweep_at(112.0, -2.0, 0.0, {body_at(114.5, 0.2, 0.0)});
  EXPECT_GT(std::ranges::count_if(returns, [](const auto& back) { return back.car == 0; }), 100);
}

TEST(SweptTrack, TheLastPlaceOfTheLapIsFollowedByItsFirst) {
  const double length_m = traffic::oval().length_m();
  EXPECT_GT(sweep_at(length_m - 1.0, 0.0, 0.0, {}).size(), 1000U);
  EXPECT_GT(sweep_at(1.0, 0.0, 0.0, {}).size(), 1000U);
}

}  // namespace
}  // namespace pitwall::sensors
