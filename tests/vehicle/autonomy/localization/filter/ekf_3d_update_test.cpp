// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/filter/ekf_3d_update.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/eigenvalues.hpp"
#include "tests/vehicle/autonomy/localization/oval.hpp"
#include "vehicle/autonomy/localization/filter/ekf_3d_errors.hpp"

namespace pitwall::localization {
namespace {

using testing::Oval;
using testing::OvalDrive;

SpatialBelief sure(double sigma) {
  SpatialBelief b;
  b.velocity_mps = {30.0, 0.0, 0.0};
  Eigen::Map<ErrorMatrix>(b.covariance.data()).diagonal().setConstant(sigma * sigma);
  b.last_imu = b.now = {{0.0, 0.0, 0.0}, {0.0, 0.0, kGravity_mps2}};
  b.imu_received = true;
  return b;
}

double sigma_of(const SpatialBelief& b, int i) {
  return std::sqrt(Eigen::Map<const ErrorMatrix>(b.covariance.data())(i, i));
}

Measurement position_at(double x, double y, Instant at) {
  return {.kind = Kind::kPosition,
          .at = at,
          .a = x,
          .b = y,
          .c = 0.0,
          .sigma_a = 0.01,
          .sigma_b = 0.01,
          .sigma_c = 0.01};
}

// A minute of everything, with sigmas from millimetres to metres between one and the next.
TEST(Ekf3dUpdate, CovarianceStaysSymmetricAndPositive) {
  OvalDrive drive(Oval{}, 5);
  auto all = drive.run(60.0);
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return a.measurement.at < b.measurement.at;
  });
  Random random{1};
  FilterParams p = testing::recommended_filter();
  FilterState state;
  start(state, p, drive.seed());
  SpatialBelief b = state.spatial.tip;
  int n = 0;
  for (auto& arrival : all) {
    Measurement m = arrival.measurement;
    if (m.kind == Kind::kPosition)
      m.sigma_a = m.sigma_b = m.sigma_c = std::pow(10.0, -4.0 + 4.0 * random.uniform());
    (void)SpatialModel::fold(b, p.spatial, m, nullptr);
    const ErrorMatrix c = Eigen::Map<const ErrorMatrix>(b.covariance.data());
    ASSERT_EQ((c - c.transpose()).cwiseAbs().maxCoeff(), 0.0);
    if (++n % 50 != 0) continue;
    // Scaled to ones on the diagonal: the numbers are of very different units.
    const ErrorVector scale = c.diagonal().cwiseSqrt().cwiseInverse();
    const ErrorMatrix unit = scale.asDiagonal() * c * scale.asDiagonal();
    ASSERT_GT(pitwall::testing::smallest_eigenvalue(pitwall::testing::numbers_of(unit)), 0.0) << n;
  }
  EXPECT_GT(n, 20'000);
}

TEST(Ekf3dUpdate, GateRefusesAndLeavesTheBeliefAlone) {
  for (const double off : {0.05, 0.20, kUnset}) {
    SpatialBelief b = sure(0.01);
    const SpatialBelief before = b;
    const Innovation i =
        SpatialModel::fold(b, testing::kSpatialParams, position_at(off, 0.0, b.at), nullptr);
    EXPECT_EQ(i.size, 3);
    EXPECT_EQ(i.accepted, off == 0.05) << off;
    EXPECT_EQ(b.position_m == before.position_m, !i.accepted);
    EXPECT_EQ(sigma_of(b, 0) == sigma_of(before, 0), !i.accepted);
  }
}

// One position does not open a sure belief, a second of them does: they are taken for right.
TEST(Ekf3dUpdate, RefusedForLongTheyAreBelieved) {
  SpatialBelief b = sure(0.01);
  b.velocity_mps = {};
  double refused_for_s = 0.0;
  for (std::int64_t i = 1; i < 60; ++i) {
    const Instant at{i * 50'000'000};
    b.last_imu_at = at;  // it goes on saying that the car stands
    const Innovation one =
        SpatialModel::fold(b, testing::kSpatialParams, position_at(2.0, -1.0, at), nullptr);
    if (one.accepted) break;
    refused_for_s = (at - Instant{}).seconds();
    EXPECT_LT(std::hypot(b.position_m[0], b.position_m[1]), 0.1);
  }
  EXPECT_NEAR(refused_for_s, testing::kSpatialParams.reacquire_s, 0.11);
  EXPECT_NEAR(b.position_m[0], 2.0, 0.3);
  EXPECT_NEAR(b.position_m[1], -1.0, 0.3);
}

// As long as one receiver fits, the other may be refused for ever.
TEST(Ekf3dUpdate, OneThatFitsKeepsTheOtherOut) {
  SpatialBelief b = sure(0.01);
  b.velocity_mps = {};
  for (std::int64_t i = 1; i < 100; ++i) {
    const Instant at{i * 50'000'000};
    b.last_imu_at = at;
    Measurement bad = position_at(2.0, 0.0, at), good = position_at(0.0, 0.0, at);
    good.unit = 1;
    EXPECT_FALSE(SpatialModel::fold(b, testing::kSpatialParams, bad, nullptr).accepted);
    EXPECT_TRUE(SpatialModel::fold(b, testing::kSpatialParams, good, nullptr).accepted);
  }
  EXPECT_LT(std::abs(b.position_m[0]), 0.05);
}

// A model that is asked a hundred times a second knows no more than one asked twenty times.
TEST(Ekf3dUpdate, AModelIsWorthItsTimeNotItsNumber) {
  const auto sigma_after = [](std::int64_t every_ms) {
    SpatialBelief b = sure(0.3);
    for (std::int64_t ms = every_ms; ms <= 2000; ms += every_ms) {
      b.last_imu_at = Instant{ms * 1'000'000};
      (void)SpatialModel::fold(b, testing::kSpatialParams,
                               {.kind = Kind::kWheelSpeed, .at = b.last_imu_at, .a = 30.0},
                               nullptr);
    }
    advance(b, testing::kSpatialParams, Instant{} + seconds(2), nullptr);
    return sigma_of(b, kDv);
  };
  SpatialBelief without = sure(0.3);
  for (std::int64_t ms = 50; ms <= 2000; ms += 50) {
    without.last_imu_at = Instant{ms * 1'000'000};
    advance(without, testing::kSpatialParams, without.last_imu_at, nullptr);
  }
  EXPECT_NEAR(sigma_after(10), sigma_after(50), 0.01 * sigma_after(50));
  EXPECT_LT(sigma_after(10), 0.8 * sigma_of(without, kDv));
}

TEST(Ekf3dUpdate, AReceiverThatChangesItsSigmaHasAnotherError) {
  SpatialBelief b = sure(0.01);
  b.wander[0] = {0.5, 0.5, 0.5};
  b.unit_sigma_m = {0.01, 0.01};
  SpatialBelief worse = b;
  Measurement m = position_at(0.0, 0.0, b.at);
  (void)SpatialModel::fold(b, testing::kSpatialParams, m, nullptr);
  EXPECT_LT(sigma_of(b, kDw), 0.011);  // as sure as it was
  m.sigma_a = m.sigma_b = 0.15;
  (void)SpatialModel::fold(worse, testing::kSpatialParams, m, nullptr);
  EXPECT_GT(sigma_of(worse, kDw), 0.3);  // what was known is forgotten, this one says a little
  EXPECT_EQ(sigma_of(worse, kDw + 3), sigma_of(b, kDw + 3));  // not so the other
}

TEST(Ekf3dUpdate, WideningTakesConfidenceAway) {
  SpatialBelief b = sure(0.01);
  Measurement m{.kind = Kind::kWiden, .at = b.at, .sigma_a = 3.0, .sigma_b = 4.0};
  (void)SpatialModel::fold(b, testing::kSpatialParams, m, nullptr);
  EXPECT_NEAR(sigma_of(b, 0), 3.0, 1e-4);
  EXPECT_NEAR(sigma_of(b, 1), 4.0, 1e-4);
  EXPECT_NEAR(sigma_of(b, 2), 0.01, 1e-12);
}

}  // namespace
}  // namespace pitwall::localization
