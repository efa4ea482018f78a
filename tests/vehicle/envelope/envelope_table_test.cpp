// SPDX-License-Identifier: Apache-2.0
#include "vehicle/envelope/envelope_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "protocol/vocabulary/random.hpp"
#include "tests/vehicle/envelope/car.hpp"

namespace pitwall::envelope {
namespace {

constexpr double kShare = 0.8;

EnvelopeParams car() {
  EnvelopeParams p{.friction = testing::av21(),
                   .grip_share = kShare,
                   .speed_max_mps = 80.0,
                   .bank_most_rad = from_deg(20.0),
                   .steering = std::nullopt};
  p.friction.engine = testing::av21_engine();
  return p;
}

// The table is linear between its rows, of 1 m/s, 1 degree and 33 shares. Where one limit takes
// over from another the corner between them is cut by a quarter of the step times the change of
// slope: 0.1 m/s2 with what is left of the ellipse at a share of 0.9, and with the bank's second
// derivative at 0.99. The force of the engine falls at a shift by some 3 m/s2 within a row of
// speed: there the two are not compared.
constexpr double kBetweenRows_mps2 = 0.1;

TEST(EnvelopeTable, IsTheEnvelopeBetweenItsRows) {
  const EnvelopeTable table{car()};
  Random random{7};
  int compared = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double v = random.between(5.0, 80.0), bank = random.between(-0.34, 0.34);
    const double k = random.between(-0.03, 0.03);
    const RoadLoad at{v, k, bank};
    const double used =
        std::abs(lateral_demand_mps2(at)) / (kShare * grip_mps2(car().friction, at));
    if (used > 0.99) continue;
    const auto near_shift = [&] {
      for (const double up_mps : car().friction.engine.up_above_mps)
        if (std::abs(v - up_mps) < 1.0) return true;
      return false;
    };
    const Longitudinal l = table.longitudinal(table.place(k, bank), v);
    const double brake = brake_available_mps2(car().friction, at, kShare) + table.coasting_mps2(v);
    EXPECT_NEAR(l.brake_mps2, brake, kBetweenRows_mps2) << v << ' ' << k << ' ' << bank;
    if (near_shift()) continue;
    EXPECT_NEAR(l.accel_mps2, drive_available_mps2(car().friction, at, kShare), kBetweenRows_mps2)
        << v << ' ' << k << ' ' << bank;
    ++compared;
  }
  EXPECT_GT(compared, 3000);
}

// In closed form: of a turn to the left,  v^2 k cos - g sin <= share friction (g cos + v^2 (k sin +
// downforce)),  is linear in v^2. It slides down where it stands if tan(bank) > share friction.
double exact_corner_mps(double share, const FrictionParams& f, double k, double bank) {
  if (k < 0.0) k = -k, bank = -bank;
  const double used = share * f.friction;
  const double turn = k * std::cos(bank) - used * (k * std::sin(bank) + f.downforce_per_m);
  const double rest = kGravity_mps2 * (std::sin(bank) + used * std::cos(bank));
  if (rest < 0.0) return 0.0;
  return turn > 0.0 ? std::sqrt(rest / turn) : HUGE_VAL;
}

TEST(EnvelopeTable, CornersAreThoseOfTheTyres) {
  const EnvelopeTable table{car()};
  for (const double k : {0.0, 0.001, 0.004, -0.004, 0.01, -0.02, 0.05})
    for (const double bank_deg : {-20.0, -7.0, 0.0, 9.0, 20.0}) {
      const double bank = from_deg(bank_deg);
      const double exact = std::min(exact_corner_mps(kShare, car().friction, k, bank), 80.0);
      EXPECT_NEAR(table.corner_speed_mps(table.place(k, bank)), exact, 0.02) << k << ' ' << bank;
    }
}

// Without a wing: v^2 = R g (sin + mu cos) / (cos - mu sin), which is mu R g on a level road.
TEST(EnvelopeTable, CornersWithoutAWingAreThoseOfTheTextbook) {
  EnvelopeParams flat = car();
  flat.friction.downforce_per_m = 0.0, flat.friction.friction = 0.9, flat.grip_share = 1.0;
  const EnvelopeTable table{flat};
  for (const double radius_m : {50.0, 220.0})
    for (const double bank : {0.0, from_deg(20.0)}) {
      const double v =
          std::sqrt(radius_m * kGravity_mps2 * (std::sin(bank) + 0.9 * std::cos(bank)) /
                    (std::cos(bank) - 0.9 * std::sin(bank)));
      EXPECT_NEAR(table.corner_speed_mps(table.place(1.0 / radius_m, bank)), v, 1e-3) << radius_m;
      EXPECT_NEAR(table.corner_speed_mps(table.place(-1.0 / radius_m, -bank)), v, 1e-3);
    }
}

// The largest demand on a level road without a wing is that of the textbook, for either hand.
TEST(EnvelopeTable, LateralMaximumIsTheTextbooks) {
  EnvelopeParams flat = car();
  flat.friction.downforce_per_m = 0.0;
  const EnvelopeTable table{flat};
  for (const double k : {0.02, -0.02})
    EXPECT_NEAR(table.lateral_max_mps2(table.place(k, 0.0), 30.0), kShare * 1.3 * kGravity_mps2,
                1e-9);
}

TEST(EnvelopeTable, SteeringLimitsTightCorners) {
  EnvelopeParams limited = car();
  SteeringLimit steering{.limits = {}, .car = {}, .share = 0.95};
  const double angle = 0.03;
  steering.limits.fill({0.0, angle});
  for (std::size_t i = 0; i < steering.limits.size(); ++i)
    steering.limits[i].speed_mps = 10.0 * static_cast<double>(i);
  limited.steering = steering;
  const EnvelopeTable table{limited};
  for (const double k : {0.009, -0.0095}) {
    const double v = table.corner_speed_mps(table.place(k, 0.0));
    ASSERT_LT(v, EnvelopeTable{car()}.corner_speed_mps(table.place(k, 0.0)) - 1.0);
    const double needed = steering.car.wheelbase_m * std::abs(k) +
                          steering.car.understeer_rad_per_mps2 * v * v * std::abs(k);
    // The largest demand angle v^2 / L is off by a quarter of angle / L between rows of 1 m/s.
    EXPECT_NEAR(needed, 0.95 * angle, 0.25 * angle / (v * v)) << k;
  }
}

TEST(EnvelopeTable, ColdTyresCarryLess) {
  EnvelopeParams cold = car();
  cold.friction = on_tyres(cold.friction, 30.0);
  const EnvelopeTable warm_table{car()}, cold_table{cold};
  const RoadPlace at = warm_table.place(0.004, 0.1);
  EXPECT_NEAR(cold_table.lateral_max_mps2(at, 0.0) / warm_table.lateral_max_mps2(at, 0.0), 0.6,
              0.05);
  EXPECT_LT(cold_table.longitudinal(at, 30.0).brake_mps2,
            warm_table.longitudinal(at, 30.0).brake_mps2);
}

}  // namespace
}  // namespace pitwall::envelope
