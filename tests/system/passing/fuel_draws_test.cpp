// A hundred competitions on a tank that is filled once, each with another consumption: the car's
// own estimate and choice against the bench's engine, on a car that is a mass and a gearbox.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "hil/plant/engine.hpp"
#include "protocol/rules/fuel.hpp"
#include "protocol/rules/passing_rules.hpp"
#include "protocol/vocabulary/random.hpp"
#include "vehicle/autonomy/planning/pass.hpp"

namespace pitwall {
namespace {

using planning::AttemptChoice;
using rules::FuelState;

constexpr double kLap_m = 2'400.0, kCaution_mps = 22.0, kPassExtra_mps = 8.0, kTick_s = 0.1;
constexpr int kDraws = 100;

// What holds a speed on a lap, corners and their drag included.
plant::Engine engine_of_bench() { return {}; }
struct Point {
  double rpm = 0.0, throttle = 0.0, flow_lps = 0.0;
};
Point hold(double speed_mps) {
  const plant::Engine engine = engine_of_bench();
  const plant::Params p;
  const double pressure_pa = 0.5 * p.aero.air_density_kgpm3 * speed_mps * speed_mps;
  const double load_n = p.chassis.mass_kg * kGravity_mps2 * 1.5 +
                        pressure_pa * (p.aero.front_lift_area_m2 + p.aero.rear_lift_area_m2);
  const double force_n = pressure_pa * p.aero.drag_area_m2 + 0.03 * load_n;
  double ratio = p.drivetrain.final_drive * p.drivetrain.gear.front();
  for (const double gear : p.drivetrain.gear) {
    const double rpm = to_rpm(speed_mps / p.rear.radius_m * p.drivetrain.final_drive * gear);
    if (rpm < 6'500.0) {
      ratio = p.drivetrain.final_drive * gear;
      break;
    }
  }
  Point at{.rpm = to_rpm(speed_mps / p.rear.radius_m * ratio)};
  const double torque_nm = force_n * p.rear.radius_m / ratio / p.drivetrain.efficiency;
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 40; ++i) {
    at.throttle = 0.5 * (low + high);
    (plant::engine_torque_nm(engine, at.rpm, at.throttle) < torque_nm ? low : high) = at.throttle;
  }
  at.flow_lps = plant::fuel_flow_kgps(engine, p.fuel, at.rpm, torque_nm) / rules::kFuelDensity_kgpl;
  return at;
}

struct Tally {
  int finished = 0, declined = 0, needless = 0, homes = 0;
  double least_l = 1e9;  // that any car came home with
};

class Competition {
 public:
  Competition(double filled_l, double consumption, Random random, Tally& tally)
      : tank_l_(filled_l), consumption_(consumption), random_(random), tally_(tally) {
    estimator_.enter(filled_l);
  }

  void run() {
    for (const double mph : rules::kRoundSpeeds_mph) {
      const double round_mps = from_mph(mph);
      for (const bool attacks : {true, false}) {
        drive(round_mps, random_.between(0.2, 1.0));  // forming
        if (!(attacks ? attack(round_mps) : defend(round_mps))) return go_home();
      }
    }
    go_home();
  }

 private:
  // False: nothing but the way home is left to it.
  bool attack(double round_mps) {
    AttemptChoice choice = AttemptChoice::kOpen;
    const double close_up = random_.between(0.3, rules::PassingRules{}.close_up_laps / 2.0);
    for (double laps = 0.0; laps < close_up; laps += step(round_mps)) {
      choice = planning::choose_attempt(choice, state(), true, false);
      if (choice == AttemptChoice::kDeclined) return decline(round_mps);
    }
    choice = planning::choose_attempt(choice, state(), true, true);
    if (choice == AttemptChoice::kDeclined) return decline(round_mps);
    const double pass = random_.between(0.4, rules::PassingRules{}.laps);
    for (double laps = 0.0; laps < pass; laps += step(round_mps + kPassExtra_mps)) {
      choice = planning::choose_attempt(choice, state(), true, true);
      if (choice == AttemptChoice::kDeclined) return decline(round_mps);
    }
    ++tally_.finished;
    return state() != FuelState::kHomeNow;
  }

  // Whether the fuel would truly have done: two laps of a pass and the way home.
  bool decline(double round_mps) {
    const double attempt_l = burn_lps(round_mps + kPassExtra_mps) * rules::PassingRules{}.laps *
                             kLap_m / (round_mps + kPassExtra_mps);
    const double home_l = burn_lps(kCaution_mps) * kLap_m / kCaution_mps;
    ++tally_.declined;
    if (tank_l_ - attempt_l - home_l > plan_.reserve_l) ++tally_.needless;
    return false;
  }

  bool defend(double round_mps) { return drive(round_mps, random_.between(1.0, 4.0)); }

  bool drive(double speed_mps, double laps) {
    for (double driven = 0.0; driven < laps; driven += step(speed_mps))
      if (state() == FuelState::kHomeNow) return false;
    return true;
  }

  void go_home() {
    ++tally_.homes;
    for (double laps = 0.0; laps < plan_.home_laps; laps += step(kCaution_mps)) continue;
    tally_.least_l = std::min(tally_.least_l, tank_l_);
  }

  double burn_lps(double speed_mps) const { return consumption_ * hold(speed_mps).flow_lps; }
  FuelState state() const { return estimator_.left(plan_).state; }

  double step(double speed_mps) {
    if (speed_mps != speed_mps_) at_ = hold(speed_mps);
    speed_mps_ = speed_mps;
    tank_l_ -= consumption_ * at_.flow_lps * kTick_s;
    way_m_ += speed_mps * kTick_s;
    now_ += from_seconds(kTick_s);
    estimator_.receive_engine({.speed_rpm = at_.rpm, .throttle = at_.throttle, .running = true},
                              now_, std::floor(way_m_ / kLap_m));
    return speed_mps * kTick_s / kLap_m;
  }

  const rules::FuelPlan plan_{.guess_l_per_lap = 1.0};
  rules::FuelEstimator estimator_;
  double tank_l_, consumption_, way_m_ = 0.0, speed_mps_ = 0.0;
  Point at_;
  Instant now_{};
  Random random_;
  Tally& tally_;
};

TEST(FuelDraws, NoDrawRunsDryAndTheLastAttemptIsDeclinedOrFinished) {
  Tally tally;
  Random random{26};
  for (int draw = 0; draw < kDraws; ++draw) {
    // The ends of the range are among them.
    const double consumption = draw == 0 ? 1.13 : draw == 1 ? 0.87 : random.between(0.87, 1.13);
    Competition{random.between(5.0, 40.0), consumption, Random{random.next()}, tally}.run();
  }
  const int attempts = tally.finished + tally.declined;
  std::printf(
      "%d draws: %d attempts finished, %d declined (%.0f %%), %d of them with fuel that would "
      "have done; the emptiest car came home with %.2f l\n",
      kDraws, tally.finished, tally.declined, 100.0 * tally.declined / attempts, tally.needless,
      tally.least_l);
  EXPECT_EQ(tally.homes, kDraws);
  EXPECT_GT(tally.least_l, 0.0);
  EXPECT_GE(tally.least_l, rules::FuelPlan{}.reserve_l) << "the pump does not reach it";
  EXPECT_GT(tally.finished, kDraws) << "who declines everything never runs dry either";
  EXPECT_GT(tally.declined, kDraws / 4);
}

// The guess is an operator's: a lap at the speed of a pass in the fastest bracket.
TEST(FuelDraws, TheGuessIsThatOfAFastLap) {
  for (const double mph : rules::kRoundSpeeds_mph) {
    const double speed_mps = from_mph(mph) + kPassExtra_mps;
    const Point at = hold(speed_mps);
    const double lap_l = at.flow_lps * kLap_m / speed_mps;
    const double ours_l = rules::fuel_flow_lps({at.rpm, at.throttle, true}) * kLap_m / speed_mps;
    std::printf("%3.0f mph: %.0f rpm, throttle %.2f, %.2f l a lap, reckoned %.2f l\n", mph, at.rpm,
                at.throttle, lap_l, ours_l);
    EXPECT_NEAR(ours_l / lap_l, 1.0, 0.13);
  }
}

}  // namespace
}  // namespace pitwall
