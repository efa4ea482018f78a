// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/field.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "hil/bench/lockstep/lockstep.hpp"
#include "hil/traffic/ghost_builder.hpp"
#include "tests/hil/bench/flying_lap.hpp"

namespace pitwall::bench {
namespace {

const world::TrackMap& track() { return lap().setup.track; }

FieldGhost ghost_at(double s_m, double start_mps, double speed_mps, std::uint8_t number = 9) {
  traffic::GhostPlan plan;
  plan.start_s_m = s_m;
  plan.start_mps = start_mps;
  plan.speed.mps = speed_mps;
  auto ghost = traffic::build_ghost(plan, track(), nullptr);
  if (!ghost) ADD_FAILURE() << to_string(ghost.error());
  return {"ghost " + std::to_string(number), number, *std::move(ghost)};
}

// Our car on the reference line, as a rig would show it.
FieldCar car_at(double s_m, double speed_mps) {
  const world::TrackPoint at = track().at(s_m);
  return {.pose = {.x_m = at.x_m,
                   .y_m = at.y_m,
                   .yaw_rad = at.yaw_rad,
                   .vx_mps = speed_mps,
                   .vy_mps = 0.0,
                   .yaw_rate_rad_per_s = 0.0,
                   .s_m = track().wrap_station(s_m),
                   .n_m = 0.0,
                   .length_m = 4.9,
                   .width_m = 1.9}};
}

struct Race {
  std::vector<FieldGhost> ghosts;
  std::array<Runner, 1> runners{Runner{lap().scenario, lap().setup, "own"}};
  Field field{runners, ghosts};

  // Drives our car from a station at a speed; the field moves the ghosts.
  void run(double from_s_m, double speed_mps, Duration span, double accel_mps2 = 0.0) {
    for (Instant now = Instant{} + kRigStep; now - Instant{} <= span; now += kRigStep) {
      const double t = (now - Instant{}).seconds();
      field.step(std::array{car_at(from_s_m + speed_mps * t + 0.5 * accel_mps2 * t * t,
                                   speed_mps + accel_mps2 * t)},
                 now);
    }
  }
};

TEST(Field, WhoDrivesIntoASlowerCarCausesTheContact) {
  Race race{{ghost_at(1'030.0, 20.0, 20.0)}};
  race.run(1'000.0, 30.0, seconds(5));
  const auto contact = race.field.contact_of(0);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->with, "ghost 9");
  EXPECT_EQ(contact->with_number, 9);
  EXPECT_EQ(contact->kind, traffic::ContactKind::kFromBehind);
  EXPECT_EQ(contact->rule, traffic::ContactRule::kCarBehind);
  EXPECT_NEAR(traffic::speed_mps(contact->own), 30.0, 0.1);
  EXPECT_NEAR(traffic::speed_mps(contact->other), 20.0, 0.1);
  EXPECT_TRUE(contact->is_caused);
  EXPECT_FALSE(contact->is_caused_by_other);
  // 30 m less a length, at 10 m/s.
  EXPECT_NEAR(contact->at.seconds(), (30.0 - 4.91) / 10.0, 0.02);
  EXPECT_NEAR(contact->closing_mps, 10.0, 0.1);
  EXPECT_EQ(race.field.contacts().size(), 1u) << "a pair has its first contact only";
  ASSERT_TRUE(race.field.contact_of(1));
  EXPECT_TRUE(race.field.contact_of(1)->is_caused_by_other);
  EXPECT_FALSE(race.field.contact_of(1)->is_caused);
  EXPECT_EQ(race.field.contact_of(1)->with, "own");
  EXPECT_EQ(race.field.contact_of(1)->own.s_m, contact->other.s_m);
  EXPECT_EQ(race.field.contact_of(1)->other.s_m, contact->own.s_m);
  EXPECT_LE(race.field.least_gap_m(0), 0.0);
}

TEST(Field, AGhostThatDrivesIntoUsCausesTheContact) {
  Race race{{ghost_at(970.0, 30.0, 30.0)}};
  race.run(1'000.0, 20.0, seconds(5));
  const auto contact = race.field.contact_of(0);
  ASSERT_TRUE(contact);
  EXPECT_FALSE(contact->is_caused);
  EXPECT_TRUE(contact->is_caused_by_other);
}

TEST(Field, CarsThatKeepApartHaveAGapAndNoContact) {
  Race race{{ghost_at(1'015.0, 20.0, 20.0), ghost_at(1'400.0, 20.0, 20.0, 10)}};
  race.run(1'000.0, 20.0, seconds(5));
  EXPECT_FALSE(race.field.contact_of(0));
  EXPECT_NEAR(race.field.least_gap_m(0), 15.0 - 4.91, 0.05);
  EXPECT_TRUE(std::isnan(race.field.least_gap_m(2))) << "it was never near";
}

TEST(Field, GhostsPassThroughEachOther) {
  Race race{{ghost_at(500.0, 20.0, 20.0), ghost_at(490.0, 30.0, 30.0, 10)}};
  race.run(1'500.0, 20.0, seconds(5));
  EXPECT_TRUE(race.field.contacts().empty());
}

// Along the lap, also over the start line.
TEST(Field, TheRivalIsTheNearestOnTheTrack) {
  Race race{{ghost_at(30.0, 20.0, 20.0, 7), ghost_at(track().length_m() - 200.0, 20.0, 20.0, 8)}};
  race.run(track().length_m() - 40.0, 20.0, milliseconds(10));
  const auto rival = race.field.rival_of(0);
  ASSERT_TRUE(rival);
  EXPECT_EQ(rival->number, 7);
  EXPECT_NEAR(rival->distance_m, 30.2, 0.3);
  EXPECT_NEAR(rival->speed_mps, 20.0, 0.1);
  EXPECT_EQ(rival->rank, 3) << "less far since the start line than the two others";
  EXPECT_FALSE((Race{{}}.field.rival_of(0))) << "a car that is alone has none";
}

TEST(Field, TheSensorsOfACarSeeAllOthers) {
  Race race{{ghost_at(30.0, 20.0, 20.0)}};
  race.run(1'000.0, 20.0, milliseconds(10));
  const auto others = race.field.others_of(0);
  ASSERT_EQ(others.size(), 1u);
  const plant::CarPose& pose = race.field.car(1).pose;
  EXPECT_EQ(others[0].x_m, pose.x_m);
  EXPECT_EQ(others[0].yaw_rad, pose.yaw_rad);
  EXPECT_NEAR(others[0].vx_mps, 20.0, 0.01);
  EXPECT_EQ(race.field.others_of(1).size(), 1u);
}

// ---- A whole run

// A standing car on our line: nothing avoids it yet, and the run says so.
TEST(Field, ARunIntoAStandingCarIsAContactThatOurCarCaused) {
  Loaded loaded = lap();
  loaded.scenario.expect.clear();
  loaded.scenario.duration = seconds(60);
  loaded.ghosts.push_back(ghost_at(loaded.scenario.start.s_m + 120.0, 0.0, 0.0));
  const auto result = run_lockstep(loaded, {.log = nowhere()});
  ASSERT_TRUE(result) << to_string(result.error());
  EXPECT_TRUE(result->failed_by_contact());
  ASSERT_TRUE(result->car_contact);
  EXPECT_EQ(result->car_contact->kind, traffic::ContactKind::kStandingCar);
  EXPECT_TRUE(result->car_contact->is_caused);
  EXPECT_NEAR(result->simulated_s, result->car_contact->at.seconds(), 0.011);
  EXPECT_NE(to_text(*result).find("CONTACT: contact with ghost 9, with a standing car"),
            std::string::npos)
      << to_text(*result);
}

// Every ghost within 50 m of a car that sees all around is tracked, for nearly all of the time,
// where it is: 1 m is three sigmas of the worst sensor there.
TEST(Field, TheCarTracksTheGhostsAroundIt) {
  auto loaded = load(kRoot + "/hil/scenarios/five_ghosts.yaml", kRoot);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  std::vector<traffic::GhostState> ghosts;
  const world::TrackMap& map = loaded->setup.track;
  for (const FieldGhost& ghost : loaded->ghosts)
    ghosts.push_back(traffic::begin(ghost.ghost, map, Instant{}));
  std::size_t near = 0, tracked = 0;
  LockstepOptions options;
  Instant moved{};
  options.watch = [&](const pipeline::Outputs& out, const Rig& rig, Instant now) {
    for (; moved < now;) {
      moved += kRigStep;
      for (std::size_t i = 0; i < ghosts.size(); ++i)
        ghosts[i] = traffic::step(loaded->ghosts[i].ghost, map, ghosts[i], {rig.road().s_m}, moved);
    }
    for (const traffic::GhostState& ghost : ghosts) {
      const auto apart = [&](double x_m, double y_m) {
        return std::hypot(ghost.pose.x_m - x_m, ghost.pose.y_m - y_m);
      };
      if (now < Instant{} + seconds(20) || apart(rig.truth().x_m, rig.truth().y_m) > 50.0) continue;
      ++near;
      for (const world::Opponent& car : out.opponents.cars)
        if (apart(car.x_m, car.y_m) < 1.0) {
          ++tracked;
          break;
        }
    }
  };
  const auto result = run_lockstep(*loaded, options);
  ASSERT_TRUE(result) << to_string(result.error());
  EXPECT_TRUE(result->passed()) << to_text(*result);
  ASSERT_GT(near, 500u) << "five seconds beside others";
  EXPECT_GE(static_cast<double>(tracked), 0.95 * static_cast<double>(near)) << near;
}

}  // namespace
}  // namespace pitwall::bench
