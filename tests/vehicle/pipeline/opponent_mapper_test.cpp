// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/opponent_mapper.hpp"

#include <gtest/gtest.h>

#include "tests/vehicle/pipeline/mapped_car.hpp"

namespace pitwall::pipeline {
namespace {

using telemetry::field;
using telemetry::Group;
using testing::ago_ms;
using testing::expect;
using testing::full;
using testing::mapped;

TEST(OpponentMapper, EachFieldSaysWhatTheCarDoes) {
  expect({{field("opponent_1.identity"), 10},
          {field("opponent_1.station"), 1520.5},
          {field("opponent_1.offset"), 0.25},
          {field("opponent_1.speed"), 51},
          {field("opponent_1.age"), 0.1},
          {field("opponent_1.position_sigma"), 0.5},
          {field("opponent_2.identity"), 20},
          {field("opponent_3.speed"), 53},
          {field("opponent_4.station"), 1580.5},
          {field("opponent_4.age"), 0.4},
          {field("opponent_4.position_sigma"), 2}});
}

// A car behind, across the start line, is near; a fifth one is not sent.
TEST(OpponentMapper, TheNearestComeFirst) {
  Outputs out = full();
  const double length_m = testing::setup().track.length_m();
  out.place.s_m = 3.0;
  out.opponents.cars.clear();
  for (const double s_m : {100.0, 60.0, 200.0, length_m - 5.0, 300.0}) {
    world::Opponent car{.id = static_cast<std::uint32_t>(out.opponents.cars.size() + 1)};
    car.s_m = s_m, car.n_m = 0.0, car.speed_mps = 1.0, car.measured_at = ago_ms(0);
    (void)out.opponents.cars.push(car);
  }
  const auto snapshot = mapped(out);
  EXPECT_EQ(snapshot.values[field("opponent_1.identity")], 4);
  EXPECT_EQ(snapshot.values[field("opponent_2.identity")], 2);
  EXPECT_EQ(snapshot.values[field("opponent_3.identity")], 1);
  EXPECT_EQ(snapshot.values[field("opponent_4.identity")], 3);
}

TEST(OpponentMapper, WithoutACarAGroupHasNoTime) {
  Outputs out = full();
  out.opponents.cars.clear();
  EXPECT_FALSE(mapped(out).ever(Group::kOpponent1));
  (void)out.opponents.cars.push({.id = 1});  // without a place on the track
  EXPECT_FALSE(mapped(out).ever(Group::kOpponent1));
}

TEST(OpponentMapper, NumbersGoRound) {
  Outputs out = full();
  for (const auto& [id, number] : {std::pair{1U, 1.0}, {254U, 254.0}, {255U, 1.0}, {509U, 1.0}}) {
    out.opponents.cars[3].id = id;
    EXPECT_EQ(mapped(out).values[field("opponent_1.identity")], number) << id;
  }
}

// The larger semi-axis of an ellipse that is turned: 3 m along its long axis, 1 m across.
TEST(OpponentMapper, SigmaIsTheLongAxis) {
  Outputs out = full();
  const double c = std::cos(0.7), s = std::sin(0.7);
  auto& p = out.opponents.cars[3].covariance;
  p[0] = 9 * c * c + s * s, p[5] = 9 * s * s + c * c, p[1] = p[4] = 8 * c * s;
  EXPECT_NEAR(mapped(out).values[field("opponent_1.position_sigma")], 3.0, 1e-12);
}

}  // namespace
}  // namespace pitwall::pipeline
