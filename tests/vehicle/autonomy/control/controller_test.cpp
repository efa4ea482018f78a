// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/controller.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <type_traits>

#include "tests/vehicle/autonomy/control/single_track.hpp"
#include "vehicle/autonomy/control/control.hpp"

namespace pitwall::control {
namespace {

using testing::oval;
using testing::recommended;

static_assert(std::is_trivially_copyable_v<State>);

struct Scene {
  world::Trajectory trajectory = oval().window(700.0, 40.0);
  world::EgoState ego;

  Scene() {
    testing::Car car;
    car.vx_mps = 38.0;
    car.x_m = trajectory.points[4].x_m, car.y_m = trajectory.points[4].y_m + 0.4;
    car.yaw_rad = trajectory.points[4].yaw_rad;
    ego = car.ego(Instant{});
  }
};

TEST(Controller, EachHasItsNameAndALawForBoth) {
  std::set<std::string_view> names;
  for (const Controller& c : kControllers) {
    EXPECT_TRUE(names.insert(c.name).second) << c.name;
    EXPECT_EQ(controller_named(c.name).step, c.step);
    Params p = recommended();
    p.controller = c;
    const LateralGains gains = prepare(p).value();
    const Scene scene;
    State state;
    Action action;
    for (int i = 0; i < 20; ++i) {  // the first angle of some is the last one
      action = c.step(p, gains, state, {.ego = scene.ego, .trajectory = scene.trajectory},
                      milliseconds(10));
      state.road_wheel_rad = action.lateral.angle_rad;
    }
    EXPECT_EQ(action.lateral.verdict, LateralVerdict::kGood) << c.name;
    EXPECT_NE(action.lateral.angle_rad, 0.0) << c.name;
    EXPECT_NEAR(action.longitudinal.target_speed_mps, 40.0, 1e-9) << c.name;
    EXPECT_GT(action.longitudinal.next.throttle_fraction, 0.0) << c.name;
  }
  EXPECT_EQ(controller_named("pid").step, nullptr);
}

TEST(Controller, ThePapersIsItsTwoLawsAndNothingElse) {
  const Params p = recommended();
  const LateralGains gains = prepare(p).value();
  const Scene scene;
  State state{.road_wheel_rad = 0.01,
              .longitudinal = {0.3, 0.0},
              .gear = {},
              .steering = {},
              .speed = {},
              .lqr_ff = {}};
  const LateralDiagnostics lateral =
      steer(p.lateral, gains, {state.road_wheel_rad}, scene.ego, scene.trajectory);
  const LongitudinalOutput longitudinal =
      step(p.longitudinal, state.longitudinal, 40.0, scene.ego.vx_mps, milliseconds(10));
  const Action action = paper_lqr(
      p, gains, state, {.ego = scene.ego, .trajectory = scene.trajectory}, milliseconds(10));
  EXPECT_EQ(action.lateral.angle_rad, lateral.angle_rad);
  EXPECT_NEAR(action.longitudinal.raw_command, longitudinal.raw_command, 1e-12);
  EXPECT_EQ(action.longitudinal.next.throttle_fraction, longitudinal.next.throttle_fraction);
}

TEST(Controller, OursGoesByTheGearboxAndByWhatWasApplied) {
  Params p = recommended();
  p.controller = controller_named("feed_forward");
  p.speed.car.engine = envelope::testing::av21_engine();
  const LateralGains gains = prepare(p).value();
  const Scene scene;
  const world::ActuatorCommand applied{.throttle_fraction = 0.35, .brake_kpa = 0.0};
  const auto throttle = [&](const GearReport& report) {
    Inputs in{.ego = scene.ego, .trajectory = scene.trajectory};
    in.gearbox = report;
    in.applied = &applied;
    State state;
    state.gear.gear = 3;
    return step(p, gains, state, in, Instant{}, milliseconds(10)).command.throttle_fraction;
  };
  const double engaged = throttle({.known = true, .gear = 3, .shifting = false});
  EXPECT_NEAR(engaged, 0.35 + p.longitudinal.throttle_rise_per_s * 0.01, 1e-12);
  EXPECT_EQ(throttle({.known = true, .gear = 3, .shifting = true}), 0.35);
  EXPECT_LT(throttle({.known = true, .gear = 0, .shifting = false}), 0.35) << "neutral";
  EXPECT_EQ(throttle({.known = false, .gear = 0, .shifting = true}), engaged) << "stale";
}

TEST(Controller, ALapTeachesAKnownCarThatDrivesItsLine) {
  const Params p = recommended();
  const LateralGains gains = prepare(p).value();
  Scene scene;
  steering::Learned known;
  known.covariance = {};
  const Inputs good{
      .ego = scene.ego, .trajectory = scene.trajectory, .learned = known, .line = {100.0, 2400.0}};
  const auto after = [&](const Inputs& in) {
    State state;
    state.road_wheel_rad = 0.02;
    lqr_ff(p, gains, state, in, milliseconds(10));
    return state.lap;
  };
  const LapState taught = after(good);
  EXPECT_EQ(taught.ticks, 1U);
  EXPECT_EQ(taught.bin,
            static_cast<std::size_t>((100.0 + scene.trajectory.points[4].s_m) / 2400.0 * kLapBins));
  EXPECT_NEAR(taught.sums.error_m, 0.4 * std::cos(scene.ego.yaw_rad), 0.01);
  const auto teaches_with = [&](const auto& change) {
    Inputs in = good;
    change(in);
    return after(in).ticks > 0;
  };
  EXPECT_TRUE(teaches_with([](Inputs&) {}));
  EXPECT_FALSE(teaches_with([](Inputs& in) { in.line = {}; }));
  EXPECT_FALSE(teaches_with([](Inputs& in) { in.drives = false; }));
  EXPECT_FALSE(teaches_with([](Inputs& in) { in.learned = {}; }));
  scene.ego.validity = world::Validity::kDeadReckoning;
  EXPECT_FALSE(teaches_with([](Inputs&) {}));
}

// A controller that can fail: without a yaw rate it hands over to the paper's.
Action failing(const Params& p, const LateralGains& gains, State& state, const Inputs& in,
               Duration dt) {
  if (std::abs(in.ego.yaw_rate_rad_per_s) < 1.0) return paper_lqr(p, gains, state, in, dt);
  return {};
}

TEST(Controller, AnotherOneIsItsFallback) {
  Params p = recommended();
  const LateralGains gains = prepare(p).value();
  const Scene scene;
  const Inputs in{.ego = scene.ego, .trajectory = scene.trajectory};
  const Output paper = step(p, gains, {}, in, Instant{}, milliseconds(10));
  p.controller = {"failing", failing};
  const Output out = step(p, gains, {}, in, Instant{}, milliseconds(10));
  EXPECT_EQ(out.command.road_wheel_rad, paper.command.road_wheel_rad);
  EXPECT_EQ(out.command.throttle_fraction, paper.command.throttle_fraction);
}

}  // namespace
}  // namespace pitwall::control
