// SPDX-License-Identifier: Apache-2.0
#include "vehicle/guardian/stop_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <string>

namespace pitwall::guardian {
namespace {

constexpr double kRingRadius_m = 200.0, kRingSpeed_mps = 40.0;

// A circle of 200 m, walls 6 m to the left and 5 m to the right.
const world::TrackMap& ring() {
  static const world::TrackMap map = [] {
    world::TrackDescription d;
    d.name = "ring";
    d.length_m = 2.0 * std::numbers::pi * kRingRadius_m;
    d.datum_latitude_deg = 36.0;
    d.datum_longitude_deg = -115.0;
    d.datum_height_m = 600.0;
    for (int i = 0; i < 8; ++i)
      d.knots.push_back({.s_m = d.length_m * i / 8.0,
                         .curvature_per_m = 1.0 / kRingRadius_m,
                         .bank_rad = 0.1,
                         .width_left_m = 6.0,
                         .width_right_m = 5.0});
    auto built = world::TrackMap::build(d);
    if (!built) ADD_FAILURE() << to_string(built.error());
    return *std::move(built);
  }();
  return map;
}

world::Trajectory stop_at(double s_m, double n_m) {
  world::Trajectory stop;
  for (std::size_t i = 0; i < 100; ++i) {
    const double along_m = 2.5 * static_cast<double>(i);
    const double stretch = 1.0 - n_m / kRingRadius_m;
    const world::TrackPoint p = ring().offset(s_m + along_m / stretch, n_m);
    const double v2 = kRingSpeed_mps * kRingSpeed_mps - 2.0 * 4.0 * along_m;
    EXPECT_TRUE(stop.points.push({.s_m = along_m,
                                  .x_m = p.x_m,
                                  .y_m = p.y_m,
                                  .yaw_rad = p.yaw_rad,
                                  .curvature_per_m = 1.0 / (kRingRadius_m - n_m),
                                  .bank_rad = 0.1,
                                  .speed_mps = std::sqrt(std::max(0.0, v2)),
                                  .accel_mps2 = v2 > 0.0 ? -4.0 : 0.0}));
  }
  return stop;
}

world::EgoState ego_at(const world::Trajectory& stop) {
  return {.validity = world::Validity::kGood,
          .x_m = stop.points[0].x_m,
          .y_m = stop.points[0].y_m,
          .yaw_rad = stop.points[0].yaw_rad,
          .vx_mps = kRingSpeed_mps};
}

StopVerdict verdict(const world::Trajectory& stop, const world::EgoState& ego) {
  return check_stop({}, stop, ego, ring());
}

TEST(StopCheck, AStopOnTheTrackIsGoodWhereverItBegins) {
  for (double s_m = 0.0; s_m < ring().length_m(); s_m += 100.0)
    for (const double n_m : {-3.0, 0.0, 4.0}) {
      const world::Trajectory stop = stop_at(s_m, n_m);
      EXPECT_EQ(verdict(stop, ego_at(stop)), StopVerdict::kGood) << s_m << " " << n_m;
    }
}

struct Flaw {
  const char* what;
  StopVerdict verdict;
  std::function<void(world::Trajectory&, world::EgoState&)> change;
};

TEST(StopCheck, EveryFlawIsNamed) {
  using T = world::Trajectory;
  using E = world::EgoState;
  const Flaw flaws[]{
      {"empty", StopVerdict::kEmpty, [](T& t, E&) { t.points.clear(); }},
      {"not a number", StopVerdict::kNotFinite, [](T& t, E&) { t.points[50].x_m = kUnset; }},
      {"backwards in speed", StopVerdict::kNotFinite, [](T& t, E&) { t.points[9].speed_mps = -1; }},
      {"station twice", StopVerdict::kNotMonotone,
       [](T& t, E&) { t.points[20].s_m = t.points[19].s_m; }},
      {"a jump aside", StopVerdict::kNotMonotone, [](T& t, E&) { t.points[20].y_m += 8.0; }},
      {"too hard", StopVerdict::kTooHard, [](T& t, E&) { t.points[20].accel_mps2 = -30.0; }},
      {"elsewhere along", StopVerdict::kNotHere,
       [](T&, E& e) {
         e.x_m += 12.0 * std::cos(e.yaw_rad);
         e.y_m += 12.0 * std::sin(e.yaw_rad);
       }},
      {"elsewhere aside", StopVerdict::kNotHere,
       [](T&, E& e) {
         e.x_m -= 4.0 * std::sin(e.yaw_rad);
         e.y_m += 4.0 * std::cos(e.yaw_rad);
       }},
      {"turned", StopVerdict::kNotHere, [](T&, E& e) { e.yaw_rad += 0.5; }},
      {"too fast", StopVerdict::kNotHere, [](T&, E& e) { e.vx_mps += 6.0; }},
      {"nowhere", StopVerdict::kNotHere, [](T&, E& e) { e = {}; }},
      {"goes on", StopVerdict::kNoStop, [](T& t, E&) { t.points[99].speed_mps = 3.0; }},
  };
  for (const Flaw& flaw : flaws) {
    world::Trajectory stop = stop_at(0.0, 0.0);
    world::EgoState ego = ego_at(stop);
    flaw.change(stop, ego);
    EXPECT_EQ(verdict(stop, ego), flaw.verdict) << flaw.what;
  }
}

TEST(StopCheck, AWallTooNearIsOffTheTrackOnEitherSide) {
  for (const double n_m : {-4.5, 5.5}) {
    const world::Trajectory stop = stop_at(0.0, n_m);
    EXPECT_EQ(verdict(stop, ego_at(stop)), StopVerdict::kOffTrack) << n_m;
  }
}

TEST(StopCheck, EveryVerdictHasAWordOfItsOwn) {
  std::set<std::string> texts;
  for (std::size_t i = 0; i < kStopVerdicts; ++i)
    texts.insert(text_of(static_cast<StopVerdict>(i)));
  EXPECT_EQ(texts.size(), kStopVerdicts);
}

}  // namespace
}  // namespace pitwall::guardian
