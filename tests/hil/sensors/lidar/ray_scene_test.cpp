// Against every triangle, one after the other: Moeller and Trumbore, "Fast, minimum storage
// ray/triangle intersection" (1997).
// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/lidar/ray_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "hil/sensors/lidar/car_mesh.hpp"
#include "tests/support/draw.hpp"

namespace pitwall::sensors {
namespace {

Vector3 minus(const Vector3& a, const Vector3& b) { return plus(a, times(-1.0, b)); }

struct Triangle {
  std::array<Vector3, 3> corner;
  double reflectance;
  std::optional<std::size_t> car;
};

struct Placement {
  Rotation axes;
  Vector3 at;
};

void add(const std::vector<Mesh>& meshes, const Placement& placement,
         std::optional<std::size_t> car, std::vector<Triangle>& triangles) {
  for (const Mesh& mesh : meshes)
    for (const auto& named : mesh.triangles) {
      Triangle triangle{{}, mesh.reflectance, car};
      for (std::size_t k = 0; k < 3; ++k) {
        const Corner& c = mesh.corners[named[k]];
        triangle.corner[k] = plus(placement.at, turned(placement.axes, {c[0], c[1], c[2]}));
      }
      triangles.push_back(triangle);
    }
}

std::optional<Meeting> first_of(const std::vector<Triangle>& triangles, const Vector3& from,
                                const Vector3& along) {
  std::optional<Meeting> nearest;
  for (const Triangle& t : triangles) {
    const Vector3 u = minus(t.corner[1], t.corner[0]), v = minus(t.corner[2], t.corner[0]);
    const Vector3 p = cross(along, v), to = minus(from, t.corner[0]), q = cross(to, u);
    const double determinant = dot(u, p);
    if (std::abs(determinant) < 1e-12) continue;
    const double a = dot(to, p) / determinant, b = dot(along, q) / determinant;
    const double range_m = dot(v, q) / determinant;
    if (a < 0.0 || b < 0.0 || a + b > 1.0 || range_m <= 0.0) continue;
    if (nearest && nearest->range_m <= range_m) continue;
    const Vector3 normal = cross(u, v);
    nearest =
        Meeting{.range_m = range_m,
                .cos_incidence = std::abs(dot(normal, along)) / std::sqrt(dot(normal, normal)),
                .reflectance = t.reflectance,
                .car = t.car};
  }
  return nearest;
}

std::vector<Mesh> ground() {
  Mesh mesh{.reflectance = 0.125F};
  mesh.add_quad({Corner{-50.0F, -50.0F, -2.0F},
                 {50.0F, -50.0F, -2.0F},
                 {50.0F, 50.0F, 0.0F},
                 {-50.0F, 50.0F, 0.0F}});
  return {mesh};
}

TEST(RayScene, MeetsTheNearestOfAllTriangles) {
  const std::vector<Mesh> car = car_meshes(av21_shape());
  RayScene scene{ground()};
  std::vector<Triangle> triangles;
  add(ground(), {rotation({}), {}}, std::nullopt, triangles);
  const std::vector<Placement> placements{
      {rotation({.roll_rad = 0.1, .yaw_rad = 0.4}), {14, 3, 0}},
      {rotation({.pitch_rad = -0.1, .yaw_rad = 2.9}), {8, -4, 1}}};
  for (std::size_t i = 0; i < placements.size(); ++i) {
    EXPECT_EQ(scene.add_car(car), i);
    scene.place(i, placements[i].axes, placements[i].at);
    add(car, placements[i], i, triangles);
  }
  scene.commit();
  std::mt19937_64 random{3};
  std::size_t of_cars = 0;
  for (int i = 0; i < 4'000; ++i) {
    const Vector3 from{testing::draw_uniform(random, -2.0, 2.0), 0.5, 5.0};
    const double az_rad = testing::draw_uniform(random, -0.75, 0.5);
    const double up_rad = testing::draw_uniform(random, -0.6, -0.2);
    const Vector3 along{std::cos(up_rad) * std::cos(az_rad), std::cos(up_rad) * std::sin(az_rad),
                        std::sin(up_rad)};
    const auto met = scene.first(from, along, 200.0), expected = first_of(triangles, from, along);
    ASSERT_EQ(met.has_value(), expected.has_value()) << i;
    if (!met) continue;
    EXPECT_NEAR(met->range_m, expected->range_m, 1e-3) << i;
    // An edge may be met on either of its sides.
    if (std::abs(met->cos_incidence - expected->cos_incidence) > 1e-3) continue;
    EXPECT_EQ(met->car, expected->car) << i;
    EXPECT_NEAR(met->reflectance, expected->reflectance, 1e-6) << i;
    of_cars += met->car.has_value();
  }
  EXPECT_GT(of_cars, 200U);
}

TEST(RayScene, MeetsNothingBeyondItsReachNorWhatIsHidden) {
  RayScene scene{ground()};
  const std::size_t car = scene.add_car(car_meshes(av21_shape()));
  scene.place(car, rotation({}), {20.0, 0.0, 3.0});
  scene.commit();
  const Vector3 from{0.0, 0.0, 3.4}, ahead{1.0, 0.0, 0.0};
  ASSERT_TRUE(scene.first(from, ahead, 100.0));
  EXPECT_EQ(scene.first(from, ahead, 100.0)->car, car);
  EXPECT_FALSE(scene.first(from, ahead, 10.0));
  scene.hide(car);
  scene.commit();
  EXPECT_FALSE(scene.first(from, ahead, 100.0));
}

TEST(RayScene, APacketMeetsWhatItsRaysMeetAlone) {
  RayScene scene{ground()};
  scene.place(scene.add_car(car_meshes(av21_shape())), rotation({.yaw_rad = 0.4}), {14, 3, 0});
  scene.commit();
  std::mt19937_64 random{8};
  const Vector3 from{0.0, 0.5, 5.0};
  std::size_t met_cars = 0;
  for (int i = 0; i < 200; ++i) {
    Packet<Vector3> along;
    for (Vector3& ray : along) {
      const double az_rad = testing::draw_uniform(random, -0.1, 0.4);
      const double up_rad = testing::draw_uniform(random, -0.5, 0.1);
      ray = {std::cos(up_rad) * std::cos(az_rad), std::cos(up_rad) * std::sin(az_rad),
             std::sin(up_rad)};
    }
    const auto met = scene.first(from, along, 200.0);
    for (std::size_t k = 0; k < kPacket; ++k) {
      const auto alone = scene.first(from, along[k], 200.0);
      ASSERT_EQ(met[k].has_value(), alone.has_value());
      if (!alone) continue;
      EXPECT_NEAR(met[k]->range_m, alone->range_m, 1e-3);
      if (std::abs(met[k]->cos_incidence - alone->cos_incidence) > 1e-3) continue;  // an edge
      EXPECT_EQ(met[k]->car, alone->car);
      EXPECT_EQ(met[k]->mesh, alone->mesh);
      EXPECT_NEAR(dot(met[k]->normal, met[k]->normal), 1.0, 1e-9);
      EXPECT_LE(dot(met[k]->normal, along[k]), 0.0) << "on the ray's side";
      met_cars += alone->car.has_value();
    }
  }
  EXPECT_GT(met_cars, 50U);
}

TEST(RayScene, WhatStandsBetweenAPlaceAndTheSunHidesIt) {
  RayScene scene{ground()};
  scene.place(scene.add_car(car_meshes(av21_shape())), rotation({}), {10.0, 0.0, 0.0});
  scene.commit();
  const Vector3 up{0.0, 0.0, 1.0};
  const Packet<std::optional<Vector3>> places{Vector3{10.0, 0.0, -0.9}, Vector3{10.0, 5.0, -0.9}};
  const Packet<bool> hidden = scene.is_hidden(places, up);
  EXPECT_TRUE(hidden[0]) << "under the car";
  EXPECT_FALSE(hidden[1]);
  EXPECT_FALSE(hidden[2]) << "not asked";
}

}  // namespace
}  // namespace pitwall::sensors
