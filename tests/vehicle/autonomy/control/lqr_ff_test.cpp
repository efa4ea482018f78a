// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/lqr_ff.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numeric>

#include "protocol/vocabulary/random.hpp"
#include "tests/support/tick.hpp"
#include "tests/vehicle/autonomy/control/single_track.hpp"

namespace pitwall::control {
namespace {

using testing::CarModel;
using testing::drive;
using testing::Lap;
using testing::oval;
using testing::recommended;

struct Law {
  Params params = recommended();
  LqrGains gains = design(params.lqr_ff, params.bicycle).value();

  double operator()(LqrState& state, const LqrInputs& in,
                    const steering::Learned& learned = {}) const {
    return steer_lqr(params.steering, gains, learned, state, in, kTick);
  }
};

LqrState begun() { return {.path = {.begun = true}}; }

// A car that does what its path asks for: in a banked turn, where the path begins to straighten.
LqrInputs on_its_path(const steering::Params& p, const steering::Learned& learned) {
  constexpr double kSpeed_mps = 50.0, kTurn_per_m = 0.004, kBank_rad = 0.3;
  constexpr double kYaw_per_m = 0.0038;
  return {.path = {.deviation = {0.0, 0.0, kTurn_per_m, kBank_rad},
                   .ahead = {0.0035, 0.25, kYaw_per_m},
                   .speed_mps = kSpeed_mps,
                   .yaw_rate_rad_per_s = kSpeed_mps * kYaw_per_m * std::cos(kBank_rad),
                   .angle_max_rad = 0.2},
          .slip_mps = kSpeed_mps *
                      steering::slip_rad(p.bicycle, learned, {kSpeed_mps, kTurn_per_m, kBank_rad})};
}

const steering::Learned kLearned{
    .offset_rad = 0.002, .understeer_rad_per_mps2 = 0.001, .rear_slip_rad_per_mps2 = 0.0004};

TEST(LqrFf, OnItsPathTheCarHasTheAngleOfTheRoadAhead) {
  const Law law;
  LqrState state = begun();
  const LqrInputs in = on_its_path(law.params.steering, kLearned);
  for (int i = 0; i < 20; ++i)
    EXPECT_NEAR(law(state, in, kLearned),
                steering::angle_rad(law.params.steering.bicycle, kLearned, {50.0, 0.0035, 0.25}),
                1e-12);
  LqrInputs level = in;
  level.path.ahead.bank_rad = 0.0;
  EXPECT_GT(law(state, level, kLearned), law(state, in, kLearned) + 1e-3) << "the bank carries it";
}

// The law, written again with whatever was sent in a queue.
TEST(LqrFf, IsTheRegulatorOfTheErrorsAndOfWhatWasSent) {
  Random random{7};
  for (int run = 0; run < 30; ++run) {
    Law law;
    const steering::Params& p = law.params.steering;
    law.params.lqr_ff.delay_s = std::array{0.01, 0.06, 0.2}[static_cast<std::size_t>(run % 3)];
    law.gains = design(law.params.lqr_ff, law.params.bicycle).value();
    const double v = random.between(12.0, 70.0), bank = random.between(-0.4, 0.4);
    const double kappa = random.between(-0.004, 0.004), here = random.between(-0.004, 0.004);
    const LqrGain gain = gain_at(law.gains, v);
    LqrState state = begun();
    std::deque<double> sent(law.gains.delay_ticks, 0.0);
    double wheel = 0.0, trim = 0.0, model = 0.0, offset = 0.0;
    const double rear = law.gains.rear_slip_rad_per_mps2;
    const double scale =
        steering::angle_per_curvature_m(
            p, kLearned, v, v * v * kappa * std::cos(bank) - kGravity_mps2 * std::sin(bank)) /
        (p.bicycle.wheelbase_m + p.bicycle.understeer_rad_per_mps2 * v * v);
    EXPECT_GT(scale, 1.0);
    for (int tick = 0; tick < 30; ++tick) {
      const double e = random.between(-1.0, 1.0), course = random.between(-0.02, 0.02);
      const double rate = random.between(-0.4, 0.4), slip = random.between(-1.0, 1.0);
      const double most = random.one_in(3) ? 0.01 : 0.5;
      const double angle = law(state,
                               {.path = {.deviation = {e, course, kappa, bank},
                                         .ahead = {kappa, bank, here},
                                         .speed_mps = v,
                                         .yaw_rate_rad_per_s = rate,
                                         .angle_max_rad = most},
                                .slip_mps = slip},
                               kLearned);
      const double turn = rate / std::cos(bank) - v * here;
      const double seen =
          (slip / v - steering::slip_rad(p.bicycle, kLearned, {v, kappa, bank})) * std::cos(bank);
      model += (1.0 - std::exp(-0.01 / (rear * v))) *
               ((p.bicycle.cg_to_rear_m / v - rear * v) * turn - model);
      offset += (1.0 - std::exp(-0.01 / law.params.lqr_ff.slip_s)) * (seen - model - offset);
      const double u =
          -(gain.error[0] * e + gain.error[1] * v * course +
            gain.error[2] * (course - (seen - offset)) + gain.error[3] * turn + gain.wheel * wheel +
            std::inner_product(sent.begin(), sent.end(), gain.sent.begin(), 0.0));
      const double asked =
          steering::angle_rad(p.bicycle, kLearned, {v, kappa, bank}) + scale * u + trim;
      const double given = std::clamp(asked, -most, most);
      EXPECT_NEAR(angle, given, 1e-12);
      if (given == asked) trim -= law.gains.trim_per_s * scale * gain.error[0] * e * 0.01;
      EXPECT_NEAR(state.path.trim_rad, trim, 1e-12);
      wheel += law.gains.wheel_share * (sent.back() - wheel);
      sent.pop_back();
      sent.push_front(u + (given - asked) / scale);
    }
  }
}

// The steady slip angle of a car is not known exactly: an error of it does not last.
TEST(LqrFf, ASlipAngleThatStaysMovesTheCarNoFurther) {
  const Law law;
  LqrState state = begun();
  LqrInputs in = on_its_path(law.params.steering, {});
  const double right = law(state, in);
  in.slip_mps += 0.2;
  const double first = law(state, in);
  double last = 0.0;
  for (int i = 0; i < 1500; ++i) last = law(state, in);
  EXPECT_GT(std::abs(first - right), 1e-3);
  EXPECT_NEAR(last, right, 1e-6);
}

TEST(LqrFfDeath, WithoutADesignItDoesNotSteer) {
  Law law;
  law.gains = {};
  LqrState state = begun();
  EXPECT_DEATH((void)law(state, on_its_path(law.params.steering, {})), "CHECK");
}

TEST(LqrFf, WhileItDoesNotFollowNothingWasSent) {
  const Law law;
  LqrState state = begun();
  LqrInputs in = on_its_path(law.params.steering, {});
  in.path.deviation.lateral_m = 1.0;
  for (int i = 0; i < 10; ++i) (void)law(state, in);
  EXPECT_NE(state.sent_rad[0], 0.0);
  EXPECT_NE(state.wheel_rad, 0.0);
  in.path.speed_mps = 0.2, in.path.last_angle_rad = 0.017;
  EXPECT_EQ(law(state, in), 0.017);
  for (const double sent : state.sent_rad) EXPECT_EQ(sent, 0.0);
  EXPECT_EQ(state.wheel_rad, 0.0);
  EXPECT_FALSE(state.path.begun);
}

TEST(LqrFf, SlowItHasTheGainsOfTheLeastSpeed) {
  const Law law;
  const auto first = [&](double speed_mps) {
    LqrState state = begun();
    return law(state, {.path = {.deviation = {0.2, 0.0, 0.0, 0.0},
                                .ahead = {0.0, 0.0, 0.0},
                                .speed_mps = speed_mps,
                                .yaw_rate_rad_per_s = 0.0,
                                .angle_max_rad = 0.2},
                       .slip_mps = 0.0});
  };
  const double least_mps = law.params.steering.gain_speed_least_mps;
  EXPECT_EQ(first(1.0), first(least_mps));
  EXPECT_NEAR(first(least_mps), -0.2 * law.gains.at_speed[0].error[0], 1e-12);
}

// Along a trajectory.
TEST(LqrFf, StaysOnItsPathInTheBankCloserThanTheLawOfAStop) {
  constexpr double kFirstLap_s = 48.0;
  for (const double stiffness : {0.85, 1.0, 1.15}) {
    CarModel car;
    car.front_per_load *= stiffness;
    Params p = recommended();
    const LateralGains gains = prepare(p).value();
    p.controller = controller_named("feed_forward");
    const Lap stops = drive(p, gains, oval(), car, 60.0, 90.0, kFirstLap_s);
    p.controller = controller_named("lqr_ff");
    const Lap ours = drive(p, gains, oval(), car, 60.0, 90.0, kFirstLap_s);
    EXPECT_FALSE(ours.lost);
    EXPECT_LT(ours.cross_track_max_m, 0.4) << stiffness;
    EXPECT_LT(ours.cross_track_mean_m, stops.cross_track_mean_m) << stiffness;
    EXPECT_LT(ours.angle_rate_rms_rad_per_s, 0.03) << stiffness;
  }
}

TEST(LqrFf, BeginsWithTheLastAngleWhoeverSteeredBeforeAndHoldsItWithoutAPlace) {
  const Law law;
  const world::Trajectory t = oval().window(700.0, 60.0);
  testing::Car car;
  car.vx_mps = 60.0;
  car.x_m = t.points[0].x_m, car.y_m = t.points[0].y_m + 0.7, car.yaw_rad = t.points[0].yaw_rad;
  State state;
  state.road_wheel_rad = 0.021;
  const LateralGains gains = prepare(law.params).value();
  const auto steered = [&](const world::EgoState& ego) {
    return lqr_ff(law.params, gains, state, {.ego = ego, .trajectory = t}, kTick).lateral;
  };
  const LateralDiagnostics first = steered(car.ego(Instant{}));
  EXPECT_EQ(first.verdict, LateralVerdict::kGood);
  EXPECT_NEAR(first.angle_rad, 0.021, 1e-12);
  EXPECT_NEAR(first.cross_track_m, 0.7 * std::cos(t.points[0].yaw_rad), 0.05);
  world::EgoState lost = car.ego(Instant{});
  lost.validity = world::Validity::kLost;
  const LateralDiagnostics held = steered(lost);
  EXPECT_EQ(held.verdict, LateralVerdict::kNoEgo);
  EXPECT_EQ(held.angle_rad, 0.021);
}

}  // namespace
}  // namespace pitwall::control
