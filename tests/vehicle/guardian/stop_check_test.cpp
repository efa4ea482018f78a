// SPDX-License-Identifier: Apache-2.0
#include "vehicle/guardian/stop_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <tuple>

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

// From the origin along x, at 40 m/s and then at standstill.
world::Trajectory straight_steps(double step_m, std::size_t points) {
  world::Trajectory stop;
  for (std::size_t i = 0; i < points; ++i) {
    const double at_m = step_m * static_cast<double>(i);
    EXPECT_TRUE(stop.points.push({.s_m = at_m,
                                  .x_m = at_m,
                                  .y_m = 0.0,
                                  .yaw_rad = 0.0,
                                  .curvature_per_m = 0.0,
                                  .bank_rad = 0.0,
                                  .speed_mps = i + 1 < points ? kRingSpeed_mps : 0.0,
                                  .accel_mps2 = 0.0}));
  }
  return stop;
}

bool has_flaw(StopVerdict flaw, const world::Trajectory& stop, const world::EgoState& ego) {
  return verdict(stop, ego) == flaw;
}

TEST(StopCheck, AStopHasTwoPoints) {
  for (const std::size_t points : {0U, 1U, 2U, 3U}) {
    const world::Trajectory stop = straight_steps(2.0, points);
    EXPECT_EQ(has_flaw(StopVerdict::kEmpty, stop, {}), points < 2) << points;
  }
}

TEST(StopCheck, EveryPointIsLookedAt) {
  for (const std::size_t i : {0U, 1U, 2U, 98U, 99U}) {
    const world::Trajectory whole = stop_at(0.0, 0.0);
    world::Trajectory stop = whole;
    stop.points[i].curvature_per_m = kUnset;
    EXPECT_EQ(verdict(stop, ego_at(whole)), StopVerdict::kNotFinite) << i;
    stop = whole;
    stop.points[i].accel_mps2 = 30.0;
    EXPECT_EQ(verdict(stop, ego_at(whole)), StopVerdict::kTooHard) << i;
    stop = whole;
    stop.points[i].s_m = i == 0 ? stop.points[1].s_m : stop.points[i - 1].s_m;
    EXPECT_EQ(verdict(stop, ego_at(whole)), StopVerdict::kNotMonotone) << i;
  }
}

TEST(StopCheck, ANumberThatIsNoneOrTooLargeToAddIsNotFinite) {
  using P = world::TrajectoryPoint;
  double P::*const fields[]{
      &P::s_m,      &P::x_m,       &P::y_m,       &P::yaw_rad, &P::curvature_per_m,
      &P::bank_rad, &P::speed_mps, &P::accel_mps2};
  for (std::size_t i = 0; i < std::size(fields); ++i) {
    world::Trajectory stop = straight_steps(2.0, 3);
    stop.points[0].*fields[i] = kUnset;
    EXPECT_EQ(verdict(stop, {}), StopVerdict::kNotFinite) << i;
    if (i == 0) continue;
    stop = straight_steps(2.0, 3);
    stop.points[0].*fields[i - 1] = stop.points[0].*fields[i] = 1e308;
    EXPECT_EQ(verdict(stop, {}), StopVerdict::kNotFinite) << i;
  }
}

TEST(StopCheck, StationsRiseAsThePlacesDo) {
  struct Case {
    double along_m, chord_m;
    bool rises;
  };
  for (const Case& c : {Case{0.0, 0.0, false}, Case{-0.125, 0.125, false}, Case{0.25, 0.25, true},
                        Case{12.0, 12.0, true}, Case{12.01, 12.0, false}, Case{4.0, 3.5, true},
                        Case{4.0, 4.5, true}, Case{4.0, 3.49, false}, Case{4.0, 4.51, false}}) {
    world::Trajectory stop = straight_steps(2.0, 2);
    stop.points[1].s_m = c.along_m;
    stop.points[1].x_m = c.chord_m;
    EXPECT_EQ(has_flaw(StopVerdict::kNotMonotone, stop, {}), !c.rises) << c.along_m << c.chord_m;
  }
}

TEST(StopCheck, TheLimitOfAStopIsStillGood) {
  for (const double beyond : {0.0, 1e-6}) {
    for (const double side : {-1.0, 1.0}) {
      world::Trajectory stop = straight_steps(2.0, 3);
      stop.points[1].accel_mps2 = side * (12.0 + beyond);
      EXPECT_EQ(has_flaw(StopVerdict::kTooHard, stop, {}), beyond > 0.0);
    }
    world::Trajectory stop = straight_steps(2.0, 3);
    stop.points[2].speed_mps = 0.1 + beyond;
    EXPECT_EQ(has_flaw(StopVerdict::kNoStop, stop,
                       {.x_m = 0.0, .y_m = 0.0, .yaw_rad = 0.0, .vx_mps = kRingSpeed_mps}),
              beyond > 0.0);
  }
}

TEST(StopCheck, TheLimitOfBeginningAtTheCarIsStillHereOnEitherSide) {
  const world::EgoState here{.x_m = 0.0, .y_m = 0.0, .yaw_rad = 0.0, .vx_mps = kRingSpeed_mps};
  for (const double beyond : {0.0, 1e-6}) {
    for (const double side : {-1.0, 1.0}) {
      world::EgoState egos[]{here, here, here, here};
      egos[0].x_m = side * (10.0 + beyond);
      egos[1].y_m = side * (3.0 + beyond);
      egos[2].yaw_rad = side * (0.3 + beyond);
      egos[3].vx_mps += side * (5.0 + beyond);
      for (const world::EgoState& ego : egos)
        EXPECT_EQ(has_flaw(StopVerdict::kNotHere, straight_steps(2.0, 3), ego), beyond > 0.0)
            << &ego - egos << " " << side;
    }
  }
}

TEST(StopCheck, AheadAndBesideAreSeenFromTheFirstPointWhateverItsHeading) {
  for (const double yaw_rad : {-2.5, -0.8, 0.8, 2.0}) {
    world::Trajectory stop = straight_steps(2.0, 3);
    stop.points[0].yaw_rad = yaw_rad;
    for (const double side : {-1.0, 1.0}) {
      for (const auto& [ahead_m, beside_m, is_here] :
           {std::tuple{9.9, 0.0, true}, std::tuple{10.1, 0.0, false}, std::tuple{0.0, 2.9, true},
            std::tuple{0.0, 3.1, false}}) {
        const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
        const world::EgoState ego{.x_m = side * (c * ahead_m - s * beside_m),
                                  .y_m = side * (s * ahead_m + c * beside_m),
                                  .yaw_rad = yaw_rad,
                                  .vx_mps = kRingSpeed_mps};
        EXPECT_EQ(has_flaw(StopVerdict::kNotHere, stop, ego), !is_here) << yaw_rad << ahead_m;
      }
    }
  }
}

// Six metres of track to the left, five to the right; one point stands aside by 1.5 m.
TEST(StopCheck, EveryFourthPointIsHeldAgainstTheWallsTheLastOneToo) {
  StopCheckParams params;
  params.wall_least_m = 4.0;
  const world::Trajectory whole = stop_at(0.0, 0.0);
  for (std::size_t i = 0; i < 97; ++i) {
    world::Trajectory stop;
    for (std::size_t k = 0; k < 97; ++k) EXPECT_TRUE(stop.points.push(whole.points[k]));
    stop.points[96].speed_mps = 0.0;
    stop.points[i].x_m += 1.5 * std::sin(stop.points[i].yaw_rad);
    stop.points[i].y_m -= 1.5 * std::cos(stop.points[i].yaw_rad);
    EXPECT_EQ(check_stop(params, stop, ego_at(whole), ring()),
              i % 4 == 0 ? StopVerdict::kOffTrack : StopVerdict::kGood)
        << i;
  }
}

TEST(StopCheck, AWallMayBeAsNearAsTheLeastDistance) {
  for (const double n_m : {-2.0, 3.0}) {
    const world::Trajectory whole = stop_at(0.0, n_m);
    world::Trajectory stop;
    EXPECT_TRUE(stop.points.push(whole.points[0]));
    EXPECT_TRUE(stop.points.push(whole.points[1]));
    stop.points[1].speed_mps = 0.0;
    const world::Curvilinear place =
        ring().project(stop.points[0].x_m, stop.points[0].y_m, std::nullopt);
    const world::TrackPoint at = ring().at(place.s_m);
    StopCheckParams params;
    params.wall_least_m = n_m > 0.0 ? at.width_left_m - place.n_m : at.width_right_m + place.n_m;
    EXPECT_EQ(check_stop(params, stop, ego_at(stop), ring()), StopVerdict::kGood) << n_m;
    params.wall_least_m += 1e-9;
    EXPECT_EQ(check_stop(params, stop, ego_at(stop), ring()), StopVerdict::kOffTrack) << n_m;
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
