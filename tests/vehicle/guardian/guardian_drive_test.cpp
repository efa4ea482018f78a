// What the guardian takes over with, and what it drives by: the numbers, against their laws.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "tests/vehicle/guardian/straight.hpp"
#include "vehicle/safety/fault_detection.hpp"

namespace pitwall::guardian {
namespace {

constexpr Duration kBeforeItActs = milliseconds(29), kWhileItDrives = milliseconds(50);
constexpr Duration kOld = milliseconds(100);  // what the bus said of the car's motion

using CarPtr = std::unique_ptr<Straight>;
CarPtr silent(Duration span) { return std::make_unique<Straight>(silent_for(span)); }

void forget_gyroscopes(Straight& car) {
  car.imus_live = false;
  car.state.reckoning.gyros = {};
}

void expect_same(const world::ActuatorCommand& a, const world::ActuatorCommand& b) {
  EXPECT_EQ(a.at, b.at);
  EXPECT_EQ(a.road_wheel_rad, b.road_wheel_rad);
  EXPECT_EQ(a.throttle_fraction, b.throttle_fraction);
  EXPECT_EQ(a.brake_kpa, b.brake_kpa);
  EXPECT_EQ(a.gear, b.gear);
}

// Of an earlier time at the wheel nothing is left.
TEST(GuardianTakeOver, SaysTheSameWhateverWasBefore) {
  for (const bool with_gyroscopes : {true, false}) {
    const CarPtr first = silent(kBeforeItActs), again = silent(kBeforeItActs);
    if (!with_gyroscopes) forget_gyroscopes(*first), forget_gyroscopes(*again);
    State& s = again->state;
    s.following.begun = s.open_loop.active = true;
    s.following.segment = 50;
    s.following.steering = {.begun = true, .unknown_rad = 0.01, .trim_rad = 0.02, .bump_rad = 0.02};
    s.following.learned = {0.02, 0.01, 0.001};
    s.open_loop.travelled_m = s.open_loop.brake_kpa = 100.0;
    for (auto& window : s.gate.windows) {
      window.count = safety::kMaxPerWindow;
      window.at.fill(again->now);
    }
    s.gate.memory.last_brake_kpa = 5000.0;
    first->tick();
    again->tick();
    ASSERT_EQ(again->mode(), Mode::kDriving);
    EXPECT_EQ(first->out.gate_refusals, 0U);
    EXPECT_EQ(again->out.gate_refusals, 0U);
    ASSERT_EQ(first->sent.size(), again->sent.size());
    for (std::size_t i = 0; i < first->sent.size(); ++i) {
      EXPECT_EQ(first->sent[i].id, again->sent[i].id);
      EXPECT_EQ(first->sent[i].data, again->sent[i].data) << first->sent[i].id;
    }
    expect_same(first->state.status.command, again->state.status.command);
  }
}

// The five that the car said, then the same and the accelerations: the first ones count nowhere.
TEST(GuardianTakeOver, ItsGateHasSeenWhatTheCarWasToldLast) {
  const CarPtr car = silent(kBeforeItActs);
  car->tick();
  ASSERT_EQ(car->sent.size(), 6U);
  const auto& windows = car->state.gate.windows;
  const auto seen = [&](std::uint64_t times) {
    return std::count_if(windows.begin(), windows.end(),
                         [&](const safety::PassWindow& w) { return w.count == times; });
  };
  EXPECT_EQ(seen(2), 5);
  EXPECT_EQ(seen(1), 1);
  EXPECT_EQ(seen(0), 2);
  const auto& verdicts = car->state.gate.verdicts;
  for (std::size_t i = 0; i < verdicts.size(); ++i)
    EXPECT_EQ(verdicts[i], i == static_cast<std::size_t>(safety::Verdict::kPass) ? 6U : 0U) << i;
}

TEST(GuardianTakeOver, ACarThatStandsHasStoodFromThereOn) {
  const CarPtr car = silent(kBeforeItActs);
  car->speed_mps = 0.0;
  car->state.signals.wheel_speed_mps.value = {};
  car->state.standing = true;
  car->state.standing_since = car->now - seconds(10);
  car->tick();
  EXPECT_EQ(car->mode(), Mode::kDriving);
  EXPECT_TRUE(car->state.standing);
  EXPECT_EQ(car->state.standing_since, car->now);
}

TEST(GuardianTakeOver, ACarIsOnItsPathUpToTheLimitItself) {
  const CarPtr free = silent(kBeforeItActs);
  free->state.reckoning.pose.y_m = 3.3;
  free->tick();
  const double beside_m = std::abs(free->state.following.lateral_m);
  EXPECT_NEAR(beside_m, 3.3, 1e-9);
  for (const double limit_m : {beside_m, std::nextafter(beside_m, 0.0)}) {
    const CarPtr car = silent(kBeforeItActs);
    car->state.reckoning.pose.y_m = 3.3;
    car->params.off_path_max_m = limit_m;
    car->tick();
    EXPECT_EQ(car->cause(), limit_m == beside_m ? Cause::kCarSilent : Cause::kOffPath);
  }
}

// Thirty milliseconds after the car's last word, at 65 m/s: 0.2 m beside where it was.
TEST(GuardianTakeOver, TheCarIsJudgedWhereItIsNow) {
  for (const double turned_rad : {-0.1, 0.1}) {
    const CarPtr car = silent(kBeforeItActs);
    car->state.reckoning.pose.y_m = car->params.off_path_max_m - std::copysign(0.1, turned_rad);
    car->state.reckoning.pose.yaw_rad = turned_rad;
    car->tick();
    EXPECT_EQ(car->cause(), turned_rad < 0.0 ? Cause::kCarSilent : Cause::kOffPath) << turned_rad;
  }
}

// On a banking the car slips down: over the thirty milliseconds too that nobody drove it.
TEST(GuardianTakeOver, TheBankingOfThePathCountsFromTheCarsLastWordOn) {
  const CarPtr car = silent(kBeforeItActs);
  const Pose before = car->state.reckoning.pose;
  constexpr double kBank_rad = 0.3;
  for (auto& point : car->state.record.stop.points) point.bank_rad = kBank_rad;
  car->tick();
  ASSERT_EQ(car->mode(), Mode::kDriving);
  const double v_mps = car->state.reckoning.pose.speed_mps;
  const double slip_mps = v_mps * car->params.reckoning.bicycle.rear_slip_rad_per_mps2 *
                          kGravity_mps2 * std::sin(kBank_rad);
  const double down_m = slip_mps * std::cos(kBank_rad) * (car->now - before.at).seconds();
  EXPECT_GT(down_m, 0.005);
  EXPECT_NEAR(car->state.reckoning.pose.y_m - before.y_m, down_m, 1e-9);
}

TEST(GuardianSpeed, WithoutWheelsTheBrakeTakesItsShareOfIt) {
  for (const double before_mps : {65.0, 1e-9}) {
    const CarPtr car = silent(kWhileItDrives);
    car->bus_lives = false;
    car->state.signals.wheel_speed_mps.received = false;
    car->state.reckoning.pose.speed_mps = before_mps;
    const double brake_kpa = car->state.following.command.brake_kpa;
    ASSERT_GT(brake_kpa, 50.0);
    const double decel_mps2 = brake_kpa / car->params.following.stop.brake_kpa_per_mps2;
    const Duration since = car->now + milliseconds(1) - car->state.reckoning.pose.at;
    car->tick();
    EXPECT_NEAR(car->state.reckoning.pose.speed_mps,
                std::max(0.0, before_mps - decel_mps2 * since.seconds()), 1e-12);
  }
}

TEST(GuardianSpeed, WheelsAreBelievedForATenthOfASecond) {
  for (const int beyond_ns : {0, 1}) {
    const CarPtr car = silent(kWhileItDrives);
    car->bus_lives = false;
    car->state.signals.wheel_speed_mps = {
        {{30.0, 30.0, 30.0, 30.0}},
        car->now + milliseconds(1) - kOld - nanoseconds(beyond_ns),
        true};
    car->tick();
    if (beyond_ns == 0)
      EXPECT_EQ(car->state.reckoning.pose.speed_mps, 30.0);
    else
      EXPECT_GT(car->state.reckoning.pose.speed_mps, 60.0);
  }
}

// Steady state of the bicycle on a plane: r = v delta / (L + K v^2).
TEST(GuardianSpeed, WithoutGyroscopesTheSteeringTurnsTheCarForATenthOfASecond) {
  for (const int beyond_ns : {0, 1}) {
    const CarPtr car = silent(kWhileItDrives);
    forget_gyroscopes(*car);
    constexpr double kMotor_rad = 0.4, kBefore_rad_per_s = 0.123;
    car->state.signals.steering_motor_rad = {
        kMotor_rad, car->now + milliseconds(1) - kOld - nanoseconds(beyond_ns), true};
    car->state.reckoning.pose.yaw_rate_rad_per_s = kBefore_rad_per_s;
    car->tick();
    const ReckoningParams& p = car->params.reckoning;
    const double v_mps = car->state.reckoning.pose.speed_mps;
    const double rate = v_mps * (kMotor_rad / p.steering_ratio) /
                        (p.bicycle.wheelbase_m + p.bicycle.understeer_rad_per_mps2 * v_mps * v_mps);
    EXPECT_NEAR(car->state.reckoning.pose.yaw_rate_rad_per_s,
                beyond_ns == 0 ? rate : kBefore_rad_per_s, 1e-12);
  }
}

TEST(GuardianSpeed, AtTheSpeedOfStandstillTheCarDoesNotStand) {
  for (const bool is_below : {true, false}) {
    const CarPtr car = silent(kWhileItDrives);
    car->bus_lives = false;
    car->state.signals.wheel_speed_mps = {{{2.0, 2.0, 2.0, 2.0}}, car->now, true};
    car->params.following.stop.standstill_mps = is_below ? std::nextafter(2.0, 3.0) : 2.0;
    car->tick();
    EXPECT_EQ(car->state.standing, is_below);
  }
}

// Runs until it has sent; what safe_stop.hpp says of the same car, in its own words.
void expect_open_loop(Straight& car, safety::SafeStopState& twin, int times) {
  for (int i = 0; i < times; ++i) {
    const world::ActuatorCommand before = car.state.following.command;
    do car.tick();
    while (car.sent.empty());
    ASSERT_EQ(car.state.status.guidance, Guidance::kOpenLoop);
    const safety::SafeStopInputs in{
        .stop = car.state.record.stop,
        .last_good = before,
        .speed_mps = safety::wheel_speed_mps(car.state.signals, car.now, kOld),
        .learned = car.state.record.learned};
    expect_same(car.state.status.command,
                safety::stop_along(car.params.following, twin, in, car.now));
    expect_same(car.state.following.command, car.state.status.command);
  }
}

TEST(GuardianOpenLoop, IsTheSafeStopsAndBeginsAnewEachTimeThatFeedbackEnds) {
  const CarPtr car = silent(kWhileItDrives);
  EXPECT_EQ(car->state.status.guidance, Guidance::kInertial);
  for (int time = 0; time < 2; ++time) {
    forget_gyroscopes(*car);
    safety::SafeStopState twin;
    expect_open_loop(*car, twin, 20);
    car->imus_live = true;
    car->run(milliseconds(100));
    EXPECT_EQ(car->state.status.guidance, Guidance::kInertial);
    EXPECT_EQ(car->out.gate_refusals, 0U);
  }
}

TEST(GuardianOpenLoop, WhereFeedbackComesBackTheWheelsTurnNoFasterThanEver) {
  const CarPtr car = silent(kWhileItDrives);
  forget_gyroscopes(*car);
  car->run(milliseconds(100));
  ASSERT_EQ(car->state.status.guidance, Guidance::kOpenLoop);
  const double before_rad = car->state.following.command.road_wheel_rad;
  car->imus_live = true;
  car->state.reckoning.pose.y_m = 4.5;  // it wants to turn far to the right
  do car->tick();
  while (car->sent.empty());
  ASSERT_EQ(car->state.status.guidance, Guidance::kInertial);
  const double turned_rad = car->state.following.command.road_wheel_rad - before_rad;
  EXPECT_NEAR(turned_rad, -car->params.following.slew_rad_per_s * kSendPeriod.seconds(), 1e-9);
  EXPECT_EQ(car->out.gate_refusals, 0U);
}

}  // namespace
}  // namespace pitwall::guardian
