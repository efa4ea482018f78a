// SPDX-License-Identifier: Apache-2.0
#include "vehicle/world/track_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace pitwall::world {
namespace {

constexpr double kPi = std::numbers::pi;

// Two straights and two half circles, joined by ramps of curvature; left-hand.
TrackDescription stadium(double straight_m = 600.0, double radius_m = 200.0) {
  constexpr double kRamp_m = 80.0;
  const double arc_m = kPi * radius_m - kRamp_m;  // ramps turn half as much as the arc
  const double half_m = straight_m + 2.0 * kRamp_m + arc_m;
  TrackDescription d;
  d.name = "stadium";
  d.source = "stadium.yaml";
  d.length_m = 2.0 * half_m;
  d.datum_latitude_deg = 36.0, d.datum_longitude_deg = -115.0, d.datum_height_m = 600.0;
  d.start_x_m = -100.0, d.start_y_m = 50.0, d.start_yaw_rad = 0.7;
  for (const double from_m : {0.0, half_m})
    for (const auto& [s_m, k] : {std::pair{0.0, 0.0}, std::pair{straight_m, 0.0},
                                 std::pair{straight_m + kRamp_m, 1.0 / radius_m},
                                 std::pair{straight_m + kRamp_m + arc_m, 1.0 / radius_m}})
      d.knots.push_back({from_m + s_m, k, 20.0 * k, 6.0 + 100.0 * k, 8.0});
  return d;
}

TrackMap built(const TrackDescription& d) {
  auto map = TrackMap::build(d);
  if (!map) throw std::runtime_error(to_string(map.error()));
  return *std::move(map);
}

TEST(TrackMap, ClosesToAMillimetre) {
  const TrackMap map = built(stadium());
  const double before_m = std::nextafter(map.length_m(), 0.0);
  const TrackPoint end = map.at(before_m), start = map.at(0.0);
  EXPECT_LT(std::hypot(end.x_m - start.x_m, end.y_m - start.y_m), 1e-3);
  EXPECT_NEAR(wrap_pi(end.yaw_rad - start.yaw_rad), 0.0, 1e-9);
  EXPECT_NEAR(end.curvature_per_m, start.curvature_per_m, 1e-9);
}

TEST(TrackMap, StartsWhereItIsTold) {
  const TrackMap map = built(stadium());
  EXPECT_DOUBLE_EQ(map.at(0.0).x_m, -100.0);
  EXPECT_DOUBLE_EQ(map.at(0.0).y_m, 50.0);
  EXPECT_DOUBLE_EQ(map.at(0.0).yaw_rad, 0.7);
}

// The correction that closes the line is small beside the table that it corrects.
TEST(TrackMap, FollowsItsTable) {
  const TrackDescription d = stadium();
  const TrackMap map = built(d);
  for (const TrackKnot& k : d.knots) {
    const TrackPoint p = map.at(k.s_m);
    EXPECT_NEAR(p.curvature_per_m, k.curvature_per_m, 0.02 / 200.0) << k.s_m;
    EXPECT_NEAR(p.bank_rad, k.bank_rad, 1e-3) << k.s_m;
    EXPECT_NEAR(p.width_left_m, k.width_left_m, 0.01) << k.s_m;
    EXPECT_NEAR(p.width_right_m, k.width_right_m, 1e-9) << k.s_m;
  }
}

// Chords of a fine division are as long as the stations say: s is arc length.
TEST(TrackMap, StationIsArcLength) {
  const TrackMap map = built(stadium());
  constexpr double kStep_m = 0.37;
  for (double s_m = 0.0; s_m < map.length_m(); s_m += kStep_m) {
    const TrackPoint a = map.at(s_m), b = map.at(s_m + kStep_m);
    ASSERT_NEAR(std::hypot(b.x_m - a.x_m, b.y_m - a.y_m), kStep_m, 1e-6) << s_m;
  }
}

// Heading is the direction of travel and curvature its derivative.
TEST(TrackMap, HeadingAndCurvatureAreDerivatives) {
  const TrackMap map = built(stadium());
  constexpr double kStep_m = 0.01;
  for (double s_m = 0.3; s_m < map.length_m(); s_m += 7.3) {
    const TrackPoint a = map.at(s_m - kStep_m), p = map.at(s_m), b = map.at(s_m + kStep_m);
    ASSERT_NEAR(wrap_pi(std::atan2(b.y_m - a.y_m, b.x_m - a.x_m) - p.yaw_rad), 0.0, 1e-6) << s_m;
    ASSERT_NEAR(wrap_pi(b.yaw_rad - a.yaw_rad) / (2.0 * kStep_m), p.curvature_per_m, 1e-6) << s_m;
  }
}

TEST(TrackMap, ProjectIsTheInverseOfOffset) {
  const TrackMap map = built(stadium());
  for (double s_m = 0.0; s_m < map.length_m(); s_m += 3.17)
    for (const double n_m : {-30.0, -8.0, -0.001, 0.0, 2.5, 6.0, 60.0}) {
      const TrackPoint p = map.offset(s_m, n_m);
      for (const auto hint : {std::optional<double>{}, std::optional<double>{s_m + 40.0},
                              std::optional<double>{s_m - 40.0 - map.length_m()}}) {
        const Curvilinear c = map.project(p.x_m, p.y_m, hint);
        const double ds_m = std::remainder(c.s_m - s_m, map.length_m());
        ASSERT_NEAR(ds_m, 0.0, 1e-6) << s_m << " " << n_m;
        ASSERT_NEAR(c.n_m, n_m, 1e-6) << s_m << " " << n_m;
        ASSERT_GE(c.s_m, 0.0);
        ASSERT_LT(c.s_m, map.length_m());
      }
    }
}

TEST(TrackMap, LeftIsPositive) {
  const TrackMap map = built(stadium());
  const TrackPoint p = map.at(10.0);  // straight at yaw 0.7
  EXPECT_GT(map.project(p.x_m - std::sin(0.7), p.y_m + std::cos(0.7)).n_m, 0.9);
  EXPECT_GT(map.at(800.0).curvature_per_m, 0.0);
}

TEST(TrackMap, WrapsStations) {
  const TrackMap map = built(stadium());
  const double length_m = map.length_m();
  for (const double s_m : {0.0, 1.0, length_m - 1e-9, 17.25})
    for (const int laps : {-1000, -1, 0, 1, 7}) {
      const double wrapped_m = map.wrap_station(s_m + laps * length_m);
      EXPECT_GE(wrapped_m, 0.0);
      EXPECT_LT(wrapped_m, length_m);
      EXPECT_NEAR(std::remainder(wrapped_m - s_m, length_m), 0.0, 1e-8);
    }
  for (const double tiny_m : {-1e-300, -1e-17, -0.0}) {
    EXPECT_GE(map.wrap_station(tiny_m), 0.0);
    EXPECT_LT(map.wrap_station(tiny_m), length_m);
  }
  EXPECT_NEAR(map.station_ahead(length_m - 10.0, 5.0), 15.0, 1e-9);
  EXPECT_NEAR(map.station_ahead(5.0, length_m - 10.0), length_m - 15.0, 1e-9);
  EXPECT_DOUBLE_EQ(map.station_ahead(5.0, 5.0), 0.0);
}

TEST(TrackMap, AnswersNonsenseWithNaN) {
  const TrackMap map = built(stadium());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf, -inf}) {
    EXPECT_TRUE(std::isnan(map.at(bad).x_m));
    EXPECT_TRUE(std::isnan(map.offset(bad, 1.0).x_m));
    EXPECT_TRUE(std::isnan(map.project(bad, 0.0).s_m));
    EXPECT_TRUE(std::isnan(map.project(0.0, bad).n_m));
    EXPECT_TRUE(std::isfinite(map.project(0.0, 0.0, bad).s_m));
  }
}

// The road falls to the inside by its banking, and along an offset line it climbs as that changes.
TEST(TrackMap, TheRoadIsRuledByItsBanking) {
  const TrackMap map = built(stadium());
  constexpr double kStep_m = 0.5;
  double steepest = 0.0;
  for (double s = 0.0; s < map.length_m(); s += 7.0) {
    EXPECT_DOUBLE_EQ(map.road(s, 0.0).height_m, 0.0);
    for (const double n : {-6.0, 3.0}) {
      const RoadPoint road = map.road(s, n);
      EXPECT_NEAR(road.height_m, -n * std::tan(map.at(s).bank_rad), 1e-12);
      EXPECT_DOUBLE_EQ(road.bank_rad, map.at(s).bank_rad);
      const TrackPoint behind = map.offset(s - kStep_m, n), ahead = map.offset(s + kStep_m, n);
      const double way_m = std::hypot(ahead.x_m - behind.x_m, ahead.y_m - behind.y_m);
      const double rise_m = map.road(s + kStep_m, n).height_m - map.road(s - kStep_m, n).height_m;
      EXPECT_NEAR(road.climb_rad, std::atan2(rise_m, way_m), 5e-4) << s << " " << n;
      steepest = std::max(steepest, std::abs(road.climb_rad));
    }
  }
  EXPECT_GT(steepest, 0.006);
}

TEST(TrackMap, ClosesASmallResidual) {
  TrackDescription d = stadium();
  for (TrackKnot& k : d.knots) k.curvature_per_m *= 1.005;
  d.knots[1].s_m += 1.0;
  const TrackMap map = built(d);
  const TrackPoint end = map.at(std::nextafter(map.length_m(), 0.0));
  EXPECT_LT(std::hypot(end.x_m - d.start_x_m, end.y_m - d.start_y_m), 1e-3);
}

TEST(TrackMap, RightHandTracksCloseToo) {
  TrackDescription d = stadium();
  for (TrackKnot& k : d.knots) k.curvature_per_m = -k.curvature_per_m;
  EXPECT_TRUE(TrackMap::build(d));
}

struct Refusal {
  const char* name;
  std::function<void(TrackDescription&)> spoil;
  const char* place;
};

TEST(TrackMap, RefusesWithThePlace) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Refusal> refusals{
      {"open by curvature", [](auto& d) { d.knots[2].curvature_per_m *= 1.2; }, ":knots"},
      {"open by length", [](auto& d) { d.length_m += 90.0; }, ":knots"},
      {"no turns",
       [](auto& d) {
         for (auto& k : d.knots) k.curvature_per_m = 0.0;
       },
       ":knots"},
      {"negative width", [](auto& d) { d.knots[3].width_left_m = -1.0; }, ":knot 4 "},
      {"zero width", [](auto& d) { d.knots[3].width_right_m = 0.0; }, ":knot 4 "},
      {"missing width", [](auto& d) { d.knots[0].width_right_m = kUnset; }, ":knot 1 "},
      {"NaN curvature", [=](auto& d) { d.knots[5].curvature_per_m = nan; }, ":knot 6 "},
      {"NaN station", [=](auto& d) { d.knots[5].s_m = nan; }, ":knot 6 "},
      {"infinite banking", [](auto& d) { d.knots[5].bank_rad = 1.0 / 0.0; }, ":knot 6 "},
      {"steep", [](auto& d) { d.knots[5].bank_rad = 0.8; }, ":knot 6 "},
      {"stations fall", [](auto& d) { std::swap(d.knots[1], d.knots[2]); }, ":knot 3 "},
      {"stations repeat", [](auto& d) { d.knots[2].s_m = d.knots[1].s_m; }, ":knot 3 "},
      {"beyond the lap", [](auto& d) { d.knots.back().s_m = d.length_m; }, ":knot 8 "},
      {"few knots", [](auto& d) { d.knots.resize(3); }, ":knots"},
      {"inner wall", [](auto& d) { d.knots[3].width_left_m = 210.0; }, ":knot 4 "},
      {"walls meet",
       [](auto& d) {
         for (auto& k : d.knots) k.width_left_m = 199.0, k.width_right_m = 3.0;
         d.knots[0].width_left_m = 500.0;
       },
       ":knots"},
      {"no length", [](auto& d) { d.length_m = kUnset; }, ":length_m"},
      {"endless", [](auto& d) { d.length_m = 1e12; }, ":length_m"},
      {"no datum", [](auto& d) { d.datum_latitude_deg = kUnset; }, ":datum"},
      {"off the globe", [](auto& d) { d.datum_longitude_deg = 181.0; }, ":datum"},
      {"no start", [=](auto& d) { d.start_yaw_rad = nan; }, ":start"},
      {"bad pit",
       [](auto& d) {
         d.pit = PitLane{1.0, 2.0, 3.0, -4.0, 5.0};
       },
       ":pit"},
      {"unset pit", [](auto& d) { d.pit = PitLane{}; }, ":pit"},
      {"pit elsewhere",
       [](auto& d) {
         d.pit = PitLane{1.0, 1e6, 3.0, 4.0, 5.0};
       },
       ":pit"},
  };
  for (const Refusal& r : refusals) {
    TrackDescription d = stadium();
    r.spoil(d);
    const auto map = TrackMap::build(d);
    ASSERT_FALSE(map) << r.name;
    EXPECT_EQ(map.error().place.rfind(std::string("stadium.yaml") + r.place, 0), 0U)
        << r.name << ": " << to_string(map.error());
    EXPECT_FALSE(map.error().what.empty());
  }
}

TEST(TrackMap, KeepsThePitLane) {
  TrackDescription d = stadium();
  d.pit = PitLane{10.0, 200.0, 20.0, 8.0, 20.0};
  ASSERT_TRUE(built(d).pit());
  EXPECT_DOUBLE_EQ(built(d).pit()->offset_m, 20.0);
}

}  // namespace
}  // namespace pitwall::world
