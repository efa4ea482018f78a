// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/line_speeds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/vehicle/autonomy/planning/stadium.hpp"
#include "vehicle/envelope/lap_profile.hpp"
#include "vehicle/world/tyre_grip.hpp"

namespace pitwall::planning {
namespace {

constexpr std::size_t kWarm = world::kTyreRows - 1;

LineParams line_params() { return testing::recommended().line; }

Line tight_line() { return build_line(testing::stadium(60.0), line_params()).value(); }

// The turn of 60 m radius is far too tight for the top speed. Friction as in friction.hpp, not from
// the table; by so much the table may differ between its rows (tests/vehicle/envelope).
TEST(LineSpeeds, CanBeDriven) {
  const LineParams p = line_params();
  const Line line = tight_line();
  constexpr double kBetweenRows_mps2 = 0.1, kEdge = 1.003;
  for (std::size_t row = 0; row < world::kTyreRows; ++row) {
    const envelope::FrictionParams car = on_tyres(p.friction, p.friction.tyres.temperature_c[row]);
    double slowest = 1e9, fastest = 0.0;
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const LinePoint &a = line.points[i], &b = line.points[(i + 1) % line.points.size()];
      const double v = a.speed_mps[row], next = b.speed_mps[row];
      const steering::RoadLoad at{v, a.curvature_per_m, a.bank_rad},
          then{next, b.curvature_per_m, b.bank_rad};
      EXPECT_LE(v, p.speed_max_mps);
      EXPECT_LE(std::abs(lateral_demand_mps2(at)), kEdge * p.grip_share * grip_mps2(car, at)) << i;
      const double accel = (next * next - v * v) / (2.0 * line.spacing_m);
      const double drive = std::max(drive_available_mps2(car, at, p.grip_share), 0.0);
      EXPECT_LE(accel, drive + kBetweenRows_mps2) << i;
      const double brake =
          brake_available_mps2(car, then, p.grip_share) + car.drag_per_m * next * next;
      // At the edge of the ellipse its slope has no limit: there the rows say more than it does.
      if (std::abs(lateral_demand_mps2(then)) < 0.99 * p.grip_share * grip_mps2(car, then)) {
        EXPECT_GE(accel, -brake - kBetweenRows_mps2) << i;
      }
      slowest = std::min(slowest, v), fastest = std::max(fastest, v);
    }
    EXPECT_LT(slowest, 40.0);
    EXPECT_GT(fastest, 50.0);
  }
}

// A forward-backward pass of the test's own on the same grid and the table alone, without shifts:
// three laps each way, from above.
TEST(LineSpeeds, TheLapIsThatOfAnIndependentPass) {
  const LineParams p = line_params();  // without an engine: no shifts
  const world::TrackMap track = testing::stadium(60.0);
  const Line line = tight_line();
  const envelope::EnvelopeTable table{envelope_of(p, track, std::nullopt)};
  const std::size_t n = line.points.size();
  std::vector<double> v(n, p.speed_max_mps);
  const auto place = [&](std::size_t i) {
    return table.place(line.points[i].curvature_per_m, line.points[i].bank_rad);
  };
  for (std::size_t i = 0; i < n; ++i) {  // by bisection of the demand
    double slow = 0.0, fast = v[i];
    const auto carries = [&](double speed) {
      return std::abs(table.lateral_mps2(place(i), speed)) <=
             table.lateral_max_mps2(place(i), speed);
    };
    for (int k = 0; k < 60 && !carries(v[i]); ++k)
      (carries(0.5 * (slow + fast)) ? slow : fast) = 0.5 * (slow + fast);
    if (!carries(v[i])) v[i] = slow;
  }
  const double twice_m = 2.0 * line.spacing_m;
  for (std::size_t k = 3 * n; k-- > 0;) {
    const std::size_t i = k % n, after = (k + 1) % n;
    const double brake = table.longitudinal(place(after), v[after]).brake_mps2;
    v[i] = std::min(v[i], std::sqrt(v[after] * v[after] + twice_m * brake));
  }
  for (std::size_t k = 0; k < 3 * n; ++k) {
    const std::size_t i = k % n, after = (k + 1) % n;
    const double drive = table.longitudinal(place(i), v[i]).accel_mps2;
    v[after] = std::min(v[after], std::sqrt(v[i] * v[i] + twice_m * drive));
  }
  double lap_s = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_NEAR(line.points[i].speed_mps[kWarm], v[i], 1e-6) << i;
    lap_s += twice_m / (v[i] + v[(i + 1) % n]);
  }
  EXPECT_NEAR(line.lap_s[kWarm], lap_s, 1e-6);
}

TEST(LineSpeeds, WarmerTyresAreFaster) {
  const Line line = tight_line();
  for (std::size_t row = 1; row < world::kTyreRows; ++row) {
    EXPECT_LT(line.lap_s[row], line.lap_s[row - 1] - 0.5);
    for (const LinePoint& p : line.points) EXPECT_GE(p.speed_mps[row], p.speed_mps[row - 1] - 1e-9);
  }
}

// Between two rows the speed is linear. The tyres carry a little less than that on a banked road,
// where the speed of a corner is convex in their friction.
TEST(LineSpeeds, BetweenTheRowsTheTyresCarryThem) {
  constexpr double kConvex = 1.02;
  const LineParams p = line_params();
  const Line line = build_line(testing::stadium(), p).value();
  for (double tyre_c = 30.0; tyre_c < 80.0; tyre_c += 2.5) {
    const envelope::FrictionParams car = on_tyres(p.friction, tyre_c);
    const world::TyrePlace tyres = world::place_of(p.friction.tyres, tyre_c);
    for (const LinePoint& a : line.points) {
      const steering::RoadLoad at{limit_mps(a, tyres), a.curvature_per_m, a.bank_rad};
      EXPECT_LE(std::abs(lateral_demand_mps2(at)), kConvex * p.grip_share * grip_mps2(car, at));
    }
  }
}

world::RacelineBank bank_of(const Line& line, double slower, double tyre_share) {
  world::Raceline raceline{.name = "own", .length_m = line.length_m, .points = {}};
  for (const LinePoint& p : line.points) {
    raceline.points.push_back({p.x_m, p.y_m, p.yaw_rad, p.curvature_per_m, p.bank_rad});
    raceline.lap.push_back({.speed_mps = slower * p.speed_mps[kWarm]});
  }
  return {
      .track = "stadium", .track_fingerprint = "", .lines = {raceline}, .tyre_share = tyre_share};
}

TEST(LineSpeeds, ABanksSpeedsHoldOnItsTyresAndOnColderOnes) {
  const world::TrackMap track = testing::stadium(60.0);
  const Line own = tight_line();
  LineParams params = line_params();
  params.bank = "bank.json", params.name = "own";
  const auto built = [&](double slower, double tyre_share) {
    const world::RacelineBank bank = bank_of(own, slower, tyre_share);
    return build_line(track, params, &bank).value();
  };
  EXPECT_NEAR(built(1.0, 1.0).lap_s[kWarm], own.lap_s[kWarm], 1e-6);
  EXPECT_NEAR(built(1.2, 1.0).lap_s[kWarm], own.lap_s[kWarm], 1e-6) << "no faster than the car";
  // Speeds of 0.9 at accelerations of 0.81: within the envelope as they are.
  const Line slower = built(0.9, 1.0);
  for (std::size_t i = 0; i < own.points.size(); ++i)
    EXPECT_NEAR(slower.points[i].speed_mps[kWarm], 0.9 * own.points[i].speed_mps[kWarm], 1e-6);
  EXPECT_LE(slower.points[0].speed_mps[0], slower.points[0].speed_mps[kWarm]);
  const Line of_cold_tyres = built(0.5, params.friction.tyres.cold());
  EXPECT_NEAR(of_cold_tyres.lap_s[kWarm], own.lap_s[kWarm], 1e-6);
  EXPECT_NEAR(of_cold_tyres.points[7].speed_mps[0], 0.5 * own.points[7].speed_mps[kWarm], 1e-6);
}

// A straight of 20 degrees, of which the tangent is 0.36; on cold tyres 0.8 times 0.36 is carried.
TEST(LineSpeeds, ACarThatTheTyresDoNotCarryDoesNotStart) {
  LineParams slippery = line_params();
  slippery.friction.friction = 0.6, slippery.friction.downforce_per_m = 0.0;
  Line line = tight_line();
  const double steep = from_deg(20.0);
  for (std::size_t i = 50; i < 60; ++i)
    line.points[i].curvature_per_m = 0.0, line.points[i].bank_rad = steep;
  add_speeds(envelope_of(slippery, testing::stadium(60.0), std::nullopt), std::nullopt, line);
  EXPECT_TRUE(std::isnan(line.lap_s[0]));
  EXPECT_EQ(line.points[0].speed_mps[0], 0.0);
  EXPECT_GT(line.lap_s[kWarm], 10.0);
  EXPECT_GT(line.points[0].speed_mps[kWarm], 10.0);
}

}  // namespace
}  // namespace pitwall::planning
