// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/pit_line.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/allocation_guard.hpp"
#include "tests/vehicle/autonomy/planning/stadium.hpp"

namespace pitwall::planning {
namespace {

using testing::green;
using testing::recommended;
using world::TrackFlag;
using world::VehicleFlag;

// Across the start of the lap.
constexpr world::PitLane kPit{.entry_s_m = 1950.0,
                              .exit_s_m = 380.0,
                              .offset_m = 22.0,
                              .width_m = 12.0,
                              .speed_limit_mps = 20.0};

// A car on the stadium that is exactly where it is planned.
struct PitRig {
  explicit PitRig(double own_offset_m = 2.0, world::PitLane lane = kPit)
      : track(testing::stadium(200.0, lane)) {
    params.line.offset_m = own_offset_m;
    own = prepare(params, track).value();
    pit = pit_line(track, params.line, own, std::nullopt).value();
    n_m = own_offset_m;
  }

  const Line& line_in_use() const { return state.line == 0 ? own : pit->line; }

  Output tick(const world::RaceControl& rc) {
    const world::TrackPoint at = track.offset(s_m, n_m);
    world::EgoState ego = testing::ego_on(own, 0.0, 0.0, speed_mps);
    ego.x_m = at.x_m, ego.y_m = at.y_m, ego.yaw_rad = at.yaw_rad;
    const Output out = step(params, own, track, state,
                            {.ego = ego,
                             .race_control = rc,
                             .followed = Followed::kDrive,
                             .tyre_c = 85.0,
                             .pit = &*pit},
                            now);
    state = out.next;
    now += milliseconds(50);
    speed_mps = state.speed_mps;
    const LinePosition p = line_in_use().project(ego.x_m, ego.y_m, state.line_s_m);
    const double next_m = p.s_m + speed_mps * 0.05;
    const Beside next =
        beside(line_in_use().at(next_m), offset_at(line_in_use(), state.merge, next_m));
    const world::Curvilinear place = track.project(next.x_m, next.y_m, s_m);
    stepped_m = std::hypot(next.x_m - ego.x_m, next.y_m - ego.y_m);
    s_m = track.wrap_station(place.s_m), n_m = place.n_m;
    return out;
  }

  bool is_in_lane() const {
    return state.line == 1 && track.station_ahead(kPit.entry_s_m, s_m) <=
                                  track.station_ahead(kPit.entry_s_m, kPit.exit_s_m);
  }

  Params params = recommended();
  world::TrackMap track;
  Line own;
  std::optional<PitLine> pit;
  State state;
  Instant now{};
  double s_m = 700.0, n_m = 2.0, speed_mps = 40.0, stepped_m = 0.0;
};

world::RaceControl black() {
  world::RaceControl rc = green(50.0);
  rc.vehicle = VehicleFlag::kBlackPitIn;
  return rc;
}

TEST(PitLine, LeavesTheTrackAndIsBackOnItWhereTheLaneEnds) {
  const PitRig rig;
  const Line& line = rig.pit->line;
  EXPECT_NEAR(line.at(0.0).n_m, 2.0, 1e-9);
  EXPECT_NEAR(line.at(0.0).track_s_m, kPit.entry_s_m, 1e-6);
  EXPECT_NEAR(line.at(rig.pit->exit_s_m).track_s_m, kPit.exit_s_m, 0.1);
  EXPECT_NEAR(line.at(rig.pit->exit_s_m).n_m, 2.0, 0.01);
  EXPECT_NEAR(line.at(rig.pit->box_s_m).n_m, kPit.offset_m, 1e-9);
  double turned_rad = 0.0;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    const LinePoint &a = line.points[i - 1], &b = line.points[i];
    const double chord_m = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    EXPECT_NEAR(chord_m, line.spacing_m, 0.01) << i;
    const double mean = 0.5 * (a.curvature_per_m + b.curvature_per_m);
    EXPECT_NEAR(wrap_pi(b.yaw_rad - a.yaw_rad), mean * line.spacing_m, 2e-4) << i;
    turned_rad += wrap_pi(b.yaw_rad - a.yaw_rad);
    if (b.s_m > rig.pit->exit_s_m) continue;
    EXPECT_LE(b.speed_mps.back(), kPit.speed_limit_mps) << i;
    EXPECT_GT(b.room_left_m, 5.9) << i;
  }
  EXPECT_NEAR(turned_rad, 2.0 * std::numbers::pi, 0.05);
}

TEST(PitLine, ATrackWithoutAPitLaneHasNone) {
  const Params params = recommended();
  const world::TrackMap track = testing::stadium();
  const Line own = prepare(params, track).value();
  EXPECT_FALSE(pit_line(track, params.line, own, std::nullopt).value().has_value());
}

// The steering cannot follow a lane as far aside as this within a quarter of its length.
TEST(PitLine, AWayInThatNoSpeedCarriesIsRefused) {
  const Params params = recommended();
  envelope::SteeringLimit steering{.limits = {}, .car = {}, .share = 1.0};
  for (std::size_t i = 0; i < steering.limits.size(); ++i)
    steering.limits[i] = {.speed_mps = 10.0 * static_cast<double>(i), .angle_rad = 0.1};
  for (const double exit_s_m : {380.0, 2010.0}) {
    world::PitLane lane = kPit;
    lane.exit_s_m = exit_s_m;
    const world::TrackMap track = testing::stadium(200.0, lane);
    const Line own = prepare(params, track, nullptr, steering).value();
    const auto made = pit_line(track, params.line, own, steering);
    EXPECT_EQ(made.has_value(), exit_s_m == 380.0);
    if (made) continue;
    EXPECT_EQ(made.error().place, "stadium: pit") << to_string(made.error());
  }
}

TEST(PitLine, ACarThatIsTooFastForItGoesRoundOnceMore) {
  const PitRig rig;
  OnTheWay way{.s_m = rig.pit->line.length_m - 160.0,
               .speed_mps = 20.0,
               .merge_m = 80.0,
               .decel_mps2 = rig.params.comfort.decel_max_mps2};
  EXPECT_TRUE(turns_in(*rig.pit, way));
  way.speed_mps = 40.0;
  EXPECT_FALSE(turns_in(*rig.pit, way));
  way.speed_mps = 20.0, way.s_m = rig.pit->line.length_m - 70.0;
  EXPECT_FALSE(turns_in(*rig.pit, way)) << "too near to change the line";
  way.s_m = rig.pit->line.length_m - 300.0;
  EXPECT_FALSE(turns_in(*rig.pit, way)) << "not yet";
}

// For a line at an offset, on either side: one continuous path, slowly, to the box.
TEST(PitLine, ABlackFlagEndsAtTheBoxAndGreenLeadsOutAgain) {
  for (const double own_offset_m : {2.0, -3.0}) {
    PitRig rig{own_offset_m};
    double fastest_in_lane_mps = 0.0, most_decel_mps2 = 0.0, last_mps = rig.speed_mps;
    Output out;
    for (int i = 0; i < 4000 && !(rig.speed_mps < 0.01 && i > 100); ++i) {
      out = rig.tick(black());
      EXPECT_LT(rig.stepped_m, rig.speed_mps * 0.05 + 0.02) << i << ": a jump of the path";
      if (rig.is_in_lane()) fastest_in_lane_mps = std::max(fastest_in_lane_mps, rig.speed_mps);
      most_decel_mps2 = std::max(most_decel_mps2, (last_mps - rig.speed_mps) / 0.05);
      last_mps = rig.speed_mps;
    }
    EXPECT_LT(rig.speed_mps, 0.01);
    EXPECT_EQ(out.reason, Reason::kBox);
    EXPECT_LE(fastest_in_lane_mps, kPit.speed_limit_mps);
    EXPECT_GT(fastest_in_lane_mps, 15.0);
    EXPECT_LE(most_decel_mps2, rig.params.comfort.decel_max_mps2 + 0.01);
    EXPECT_NEAR(rig.n_m, kPit.offset_m, 0.1);
    EXPECT_NEAR(rig.state.line_s_m, rig.pit->box_s_m, 1.0);
    bool was_limited = false;
    for (int i = 0; i < 1200; ++i) {
      out = rig.tick(green(50.0));
      was_limited = was_limited || out.reason == Reason::kPitLane;
      ASSERT_TRUE(!rig.is_in_lane() || rig.speed_mps <= kPit.speed_limit_mps) << i;
    }
    EXPECT_TRUE(was_limited);
    EXPECT_EQ(rig.state.line, 0u);
    EXPECT_NEAR(rig.n_m, own_offset_m, 0.05);
    EXPECT_GT(rig.speed_mps, 45.0);
  }
}

TEST(PitLine, ACarThatStartsInItDrivesOutAndRedStopsItThere) {
  PitRig rig;
  rig.s_m = 10.0, rig.n_m = kPit.offset_m, rig.speed_mps = 0.0;
  for (int i = 0; i < 200; ++i) rig.tick(green(50.0));
  EXPECT_EQ(rig.state.line, 1u);
  EXPECT_GT(rig.speed_mps, 10.0);
  world::RaceControl red = green(50.0);
  red.track = TrackFlag::kRed;
  for (int i = 0; i < 200; ++i) rig.tick(red);
  EXPECT_LT(rig.speed_mps, 0.01);
}

TEST(PitLine, PlanningOnItDoesNotAllocate) {
  PitRig rig;
  rig.s_m = 1700.0, rig.speed_mps = 20.0;
  for (int i = 0; i < 400; ++i) {
    const auto tick = [&] { rig.tick(black()); };
    ASSERT_EQ(pitwall::testing::allocations_of(tick), 0u) << i;
  }
}

}  // namespace
}  // namespace pitwall::planning
