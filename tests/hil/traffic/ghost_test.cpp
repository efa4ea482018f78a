// SPDX-License-Identifier: Apache-2.0
#include "hil/traffic/ghost.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>
#include <random>
#include <type_traits>
#include <vector>

#include "hil/traffic/ghost_builder.hpp"
#include "hil/traffic/rectangle.hpp"
#include "tests/hil/traffic/oval.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/draw.hpp"

namespace pitwall::traffic {
namespace {

static_assert(std::is_trivially_copyable_v<GhostState>);
static_assert(std::is_trivially_copyable_v<GhostParams>);

constexpr Duration kTick = milliseconds(10);

Ghost built(const GhostPlan& plan) {
  auto ghost = build_ghost(plan, oval(), &bank());
  if (!ghost) ADD_FAILURE() << to_string(ghost.error());
  return *std::move(ghost);
}

GhostPlan at_speed(double mps) {
  GhostPlan plan;
  plan.start_mps = mps;
  plan.speed.mps = mps;
  return plan;
}

using Ego = std::function<double(double t_s)>;
const Ego kNoEgo = [](double) { return kUnset; };

std::vector<GhostState> driven(const Ghost& ghost, double for_s, const Ego& ego = kNoEgo,
                               Duration tick = kTick) {
  std::vector<GhostState> states{begin(ghost, oval(), Instant{})};
  for (Instant now{}; now.seconds() < for_s;) {
    now += tick;
    states.push_back(step(ghost, oval(), states.back(), {ego(now.seconds())}, now));
  }
  return states;
}

double time_of(const GhostState& state) { return state.at.seconds(); }
double speed_of(const GhostState& s) { return std::hypot(s.pose.vx_mps, s.pose.vy_mps); }

// First state that meets the condition.
template <class Condition>
const GhostState& first(const std::vector<GhostState>& states, Condition&& condition) {
  for (const GhostState& state : states)
    if (condition(state)) return state;
  ADD_FAILURE() << "the condition is never met";
  return states.back();
}

Vector2 velocity(const plant::CarPose& p) {
  const double c = std::cos(p.yaw_rad), s = std::sin(p.yaw_rad);
  return {c * p.vx_mps - s * p.vy_mps, s * p.vx_mps + c * p.vy_mps};
}

SpeedPlan draw_speed(std::mt19937_64& random) {
  using testing::draw_uniform;
  SpeedPlan speed;
  switch (static_cast<int>(draw_uniform(random, 0.0, 3.0))) {
    case 0:
      speed.mps = draw_uniform(random, 0.0, 70.0);
      break;
    case 1:
      speed.lap_share = draw_uniform(random, 0.3, 1.2);
      break;
    default:
      for (double s_m = draw_uniform(random, 0.0, 200.0); s_m < oval().length_m();
           s_m += draw_uniform(random, 20.0, 600.0))
        speed.by_station.push_back({s_m, draw_uniform(random, 5.0, 70.0)});
  }
  return speed;
}

LinePlan draw_line(std::mt19937_64& random) {
  return {.name = "swing", .offset_m = testing::draw_uniform(random, -4.0, 4.0)};
}

GhostPlan draw_plan(std::uint64_t seed) {
  using testing::draw_uniform;
  std::mt19937_64 random(seed);
  GhostPlan plan;
  plan.start_s_m = draw_uniform(random, 0.0, oval().length_m());
  plan.start_mps = draw_uniform(random, 0.0, 70.0);
  if (draw_uniform(random) < 0.5) plan.start_n_m = draw_uniform(random, -6.0, 6.0);
  plan.line = draw_line(random);
  plan.speed = draw_speed(random);
  plan.drift = {.sigma_m = draw_uniform(random, 0.0, 0.5), .correlation_s = 4.0, .most_m = 0.5};
  plan.seed = seed;
  double at_s = 0.0;
  const bool spins = draw_uniform(random) < 0.3;
  for (int i = 0; i < 6; ++i) {
    ScriptPlan entry;
    at_s += draw_uniform(random, 0.0, 10.0);
    entry.trigger = static_cast<Trigger>(static_cast<int>(draw_uniform(random, 0.0, 4.0)));
    entry.value = at_s;
    if (entry.trigger == Trigger::kStation) entry.value = draw_uniform(random, 0.0, 2'000.0);
    if (entry.trigger == Trigger::kGapAbove || entry.trigger == Trigger::kGapBelow)
      entry.value = draw_uniform(random, -200.0, 200.0);
    entry.action = static_cast<Action>(static_cast<int>(draw_uniform(random, 0.0, 4.0)));
    if (i == 5 && spins) entry.action = Action::kSpin;
    entry.speed = draw_speed(random);
    entry.line = draw_line(random);
    entry.over_s = draw_uniform(random, 0.5, 6.0);
    entry.decel_mps2 = draw_uniform(random, 1.0, 8.0);
    entry.to_mps = draw_uniform(random, 0.0, 40.0);
    entry.turn_rad = draw_uniform(random, -9.0, 9.0);
    plan.script.push_back(entry);
  }
  return plan;
}

// What a path of these plans can need at most: along it the brakes, 8; across it
//   70^2 / 192 for the turn at an offset of 8 m, times (70 + 0.5) / 70 for the swing: 26
//   70^2 * 2 * swing_per_m^2 for two swinging lines: 2.4, and 2 * 1.875 / 0.5 s * 0.045 * 70 / 2
//   for the change between their slopes: 12
//   4 for the change of line, 2 for the drift, and half the braking, 4, below the walking pace
constexpr double kMost_mps2 = 51.0;
// Rates of the yaw: 8 / 10 where change and drift are fastest at a walking pace, 0.4 in the turn,
// and as much again for the change of slopes while the speed changes.
constexpr double kMost_radps = 2.0;

TEST(Ghost, MovesSmoothlyWithinItsLimitsWhateverTheScript) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Ghost ghost = built(draw_plan(seed));
    const auto states = driven(ghost, 40.0, [](double t_s) { return 30.0 + 50.0 * t_s; });
    for (std::size_t i = 1; i < states.size(); ++i) {
      const plant::CarPose &a = states[i - 1].pose, &b = states[i].pose;
      const double dt_s = kTick.seconds(),
                   change_mps = speed_of(states[i]) - speed_of(states[i - 1]);
      ASSERT_LE(change_mps, 4.0 * dt_s + 1e-9) << seed << " at " << time_of(states[i]);
      ASSERT_GE(change_mps, -8.0 * dt_s - 1e-9) << seed << " at " << time_of(states[i]);
      const Vector2 jump = velocity(b) - velocity(a);
      ASSERT_LE(std::hypot(jump.x, jump.y), kMost_mps2 * dt_s)
          << seed << " at " << time_of(states[i]);
      const Vector2 mean = 0.5 * (velocity(a) + velocity(b));
      const Vector2 driven_mps = 1.0 / dt_s * Vector2{b.x_m - a.x_m, b.y_m - a.y_m};
      ASSERT_LE(std::hypot(driven_mps.x - mean.x, driven_mps.y - mean.y), kMost_mps2 * dt_s)
          << seed << " at " << time_of(states[i]);
      double turn_radps = kMost_radps;
      if (states[i].pace == Action::kSpin && states[i].spin_from_mps >= 1.0)
        turn_radps += std::abs(states[i].turn_rad) * 1.875 * 8.0 / states[i].spin_from_mps;
      ASSERT_LE(std::abs(b.yaw_rate_rad_per_s), turn_radps) << seed << " at " << time_of(states[i]);
      ASSERT_LT(std::abs(b.n_m) + 0.5 * b.width_m, kWall_m) << seed << " at " << time_of(states[i]);
      if (speed_of(states[i]) == 0.0 && speed_of(states[i - 1]) == 0.0) {
        ASSERT_EQ(a.x_m, b.x_m) << seed;
        ASSERT_EQ(a.yaw_rad, b.yaw_rad) << seed;
      }
    }
  }
}

TEST(Ghost, PoseAgreesWithTheTrackAndItsLine) {
  GhostPlan plan = at_speed(60.0);
  plan.line = {.name = "swing", .offset_m = 1.0};
  for (const GhostState& state : driven(built(plan), 60.0)) {
    const auto place = oval().project(state.pose.x_m, state.pose.y_m, state.pose.s_m);
    EXPECT_NEAR(place.s_m, state.pose.s_m, 1e-6);
    EXPECT_NEAR(place.n_m, state.pose.n_m, 1e-9);
    EXPECT_NEAR(place.n_m, swing_n_m(place.s_m) + 1.0, 1e-6);
  }
}

TEST(Ghost, TheSameSeedGivesTheSameBits) {
  GhostPlan plan = draw_plan(3);
  plan.drift.sigma_m = 0.3;
  const Ghost ghost = built(plan);
  const plant::CarPose once = driven(ghost, 30.0).back().pose,
                       again = driven(ghost, 30.0).back().pose;
  EXPECT_EQ(std::memcmp(&once, &again, sizeof once), 0);
  plan.seed = 99;
  EXPECT_NE(driven(built(plan), 30.0).back().pose.n_m, once.n_m);
}

TEST(Ghost, AStepAllocatesNothing) {
  const Ghost ghost = built(draw_plan(4));
  GhostState state = begin(ghost, oval(), Instant{});
  const std::size_t count = testing::allocations_of([&] {
    for (int i = 1; i <= 4'000; ++i)
      state = step(ghost, oval(), state, {30.0 * i * 0.01}, Instant{} + i * kTick);
  });
  EXPECT_EQ(count, 0u);
}

TEST(Ghost, ChangesItsLineByAMinimumJerk) {
  GhostPlan plan = at_speed(20.0);
  plan.script.push_back({.value = 2.0,
                         .action = Action::kLine,
                         .line = {.name = "", .offset_m = 3.0},
                         .over_s = 6.0});
  const auto states = driven(built(plan), 12.0);
  // On the first straight, where 12 s are 240 m. The path is longer than its projection by less
  // than half the square of the slope, 0.05.
  for (const auto& [at_s, share] :
       {std::pair{2.0, 0.0}, {3.5, 0.103515625}, {5.0, 0.5}, {6.5, 0.896484375}, {8.0, 1.0}})
    EXPECT_NEAR(states[static_cast<std::size_t>(at_s * 100.0)].pose.n_m, 3.0 * share, 0.02) << at_s;
}

// 4 m in 1 s would need 23 m/s^2: it takes sqrt(5.77 * 4 / 4) = 2.40 s.
TEST(Ghost, TakesLongerForAChangeThatWouldBeTooFast) {
  GhostPlan plan = at_speed(50.0);
  plan.script.push_back({.value = 1.0,
                         .action = Action::kLine,
                         .line = {.name = "", .offset_m = 4.0},
                         .over_s = 1.0});
  const auto states = driven(built(plan), 6.0);
  double most_mps2 = 0.0;
  for (std::size_t i = 2; i < states.size(); ++i)
    most_mps2 = std::max(most_mps2, std::abs(states[i].pose.n_m - 2.0 * states[i - 1].pose.n_m +
                                             states[i - 2].pose.n_m) /
                                        1e-4);
  EXPECT_LE(most_mps2, 4.0 * 1.01);
  EXPECT_GE(most_mps2, 4.0 * 0.97);
  const double over_s =
      time_of(first(states, [](const GhostState& s) { return s.pose.n_m >= 4.0 - 1e-9; })) - 1.0;
  EXPECT_NEAR(over_s, 2.403, 0.03);
}

TEST(Ghost, JoinsItsLineFromItsStart) {
  GhostPlan plan = at_speed(30.0);
  plan.start_n_m = -5.0;
  plan.line.offset_m = 2.0;
  const auto states = driven(built(plan), 8.0);
  EXPECT_EQ(states.front().pose.n_m, -5.0);
  EXPECT_EQ(states.back().pose.n_m, 2.0);
}

TEST(Ghost, ItsSpeedWandersByTheDriftAndACarThatStandsKeepsStanding) {
  GhostPlan plan = at_speed(40.0);
  plan.speed_drift = {.sigma_mps = 0.5, .correlation_s = 5.0, .most_mps = 1.0};
  plan.script = {
      {.trigger = Trigger::kTime, .value = 60.0, .action = Action::kSpeed, .speed = {.mps = 0.0}}};
  double least_mps = 40.0, most_mps = 40.0;
  const std::vector<GhostState> states = driven(built(plan), 90.0);
  for (const GhostState& state : states) {
    if (time_of(state) >= 60.0) break;
    least_mps = std::min(least_mps, speed_of(state));
    most_mps = std::max(most_mps, speed_of(state));
  }
  EXPECT_LT(least_mps, 39.7);
  EXPECT_GE(least_mps, 39.0);
  EXPECT_GT(most_mps, 40.3);
  EXPECT_LE(most_mps, 41.0);
  EXPECT_EQ(speed_of(states.back()), 0.0);
}

TEST(Ghost, FollowsTheLapOfItsLine) {
  GhostPlan plan;
  plan.line.name = "swing";
  plan.speed.lap_share = 0.9;
  plan.start_mps = 0.9 * swing_mps(0.0);
  for (const GhostState& state : driven(built(plan), 60.0))
    EXPECT_NEAR(speed_of(state), 0.9 * swing_mps(state.pose.s_m), 0.1);
}

TEST(Ghost, BrakesOverTheWayThatPhysicsSays) {
  GhostPlan plan = at_speed(40.0);
  plan.script.push_back(
      {.value = 1.0, .action = Action::kBrake, .decel_mps2 = 5.0, .to_mps = 10.0});
  plan.script.push_back({.value = 10.0, .action = Action::kStand});
  plan.script.push_back({.value = 15.0, .action = Action::kSpeed, .speed = {.mps = 12.0}});
  const auto states = driven(built(plan), 20.0);
  const GhostState& slow = first(states, [](const GhostState& s) { return speed_of(s) <= 10.0; });
  EXPECT_NEAR(time_of(slow), 1.0 + 30.0 / 5.0, 0.02);
  EXPECT_NEAR(slow.travelled_m, 40.0 + (1'600.0 - 100.0) / (2.0 * 5.0), 0.6);
  const GhostState& stands = first(states, [](const GhostState& s) { return speed_of(s) == 0.0; });
  EXPECT_NEAR(time_of(stands), 10.0 + 10.0 / 8.0, 0.02);
  EXPECT_EQ(states[1'499].travelled_m, stands.travelled_m);
  EXPECT_NEAR(speed_of(states.back()), 12.0, 1e-9);
}

TEST(Ghost, SpinsToAStop) {
  GhostPlan plan = at_speed(40.0);
  plan.script.push_back(
      {.value = 1.0, .action = Action::kSpin, .decel_mps2 = 8.0, .turn_rad = 7.0});
  const auto states = driven(built(plan), 10.0);  // on the first straight, whose yaw is 0
  double turned_rad = 0.0;
  for (std::size_t i = 1; i < states.size(); ++i)
    turned_rad += wrap_pi(states[i].pose.yaw_rad - states[i - 1].pose.yaw_rad);
  EXPECT_NEAR(turned_rad, 7.0, 1e-6);
  EXPECT_EQ(speed_of(states.back()), 0.0);
  EXPECT_NEAR(states.back().travelled_m, 40.0 + 1'600.0 / 16.0, 0.6);
  // It slides along the road all the time, whichever way it points.
  for (const GhostState& state : states) {
    const Vector2 v = velocity(state.pose);
    const double road_rad = oval().at(state.pose.s_m).yaw_rad;
    EXPECT_NEAR(v.y * std::cos(road_rad) - v.x * std::sin(road_rad), 0.0, 1e-9);
  }
}

TEST(Ghost, EntriesFireByStationAndGapInTheirOrder) {
  GhostPlan plan = at_speed(20.0);
  plan.start_s_m = 100.0;
  const auto slower = [&](Trigger trigger, double value, double mps) {
    plan.script.push_back(
        {.trigger = trigger, .value = value, .action = Action::kSpeed, .speed = {.mps = mps}});
  };
  slower(Trigger::kGapAbove, -40.0, 19.0);  // our car comes up from behind
  slower(Trigger::kTime, 1.0, 18.0);        // long over: at once
  slower(Trigger::kStation, 50.0, 17.0);    // in the next lap only
  slower(Trigger::kGapBelow, 10.0, 16.0);
  const double length_m = oval().length_m();
  const auto states = driven(built(plan), 160.0, [&](double t_s) {
    return t_s < 100.0 ? oval().wrap_station(30.0 * t_s) : 500.0;
  });
  std::vector<const GhostState*> fired;
  for (std::size_t i = 1; i < states.size(); ++i)
    if (states[i].next != states[i - 1].next) fired.push_back(&states[i]);
  ASSERT_EQ(fired.size(), 3u);
  EXPECT_EQ(fired[0]->next, 2u);
  EXPECT_NEAR(time_of(*fired[0]), 6.0, 0.02);  // 30 t = 100 + 20 t - 40
  EXPECT_NEAR(fired[1]->travelled_m, length_m + 50.0, 0.4);
  EXPECT_NEAR(fired[2]->travelled_m, length_m + 490.0, 0.4);
  EXPECT_EQ(fired[2]->next, 4u);
}

TEST(Ghost, AChangeOfLineWaitsForTheOneBefore) {
  GhostPlan plan = at_speed(40.0);
  for (const double n_m : {3.0, -3.0})
    plan.script.push_back({.value = 1.0,
                           .action = Action::kLine,
                           .line = {.name = "", .offset_m = n_m},
                           .over_s = 3.0});
  const auto states = driven(built(plan), 9.0);
  const double most_m = std::max_element(states.begin(), states.end(), [](auto& a, auto& b) {
                          return a.pose.n_m < b.pose.n_m;
                        })->pose.n_m;
  EXPECT_NEAR(most_m, 3.0, 1e-3);
  EXPECT_LT(states[110].pose.n_m, 0.05);         // 0.1 s after the beginning
  EXPECT_NEAR(states[400].pose.n_m, 3.0, 0.01);  // 3 s after it
  EXPECT_EQ(states.back().pose.n_m, -3.0);
}

}  // namespace
}  // namespace pitwall::traffic
