// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/pillars/pillar_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <random>

#include "tests/hil/traffic/oval.hpp"
#include "tests/support/draw.hpp"

namespace pitwall::perception {
namespace {

constexpr double kOurs_s_m = 150.0, kOurs_n_m = 2.0;

class PillarsOfARoad : public ::testing::Test {
 protected:
  PillarsOfARoad() {
    const world::TrackPoint at = traffic::oval().offset(kOurs_s_m, kOurs_n_m);
    ground_ = TrackGround::fit(grid_, {at.x_m, at.y_m, at.yaw_rad, 0.3}, {});
  }
  // A point over the road, in Body.
  LidarPoint at(double ahead_m, double n_m, double over_m, double after_s = 0.0) const {
    const TrackGround::RoadInBody road = ground_->in_body(ahead_m, n_m);
    const double bank_rad = traffic::oval().at(kOurs_s_m).bank_rad;
    return {static_cast<float>(road.x_m),
            static_cast<float>(road.y_m - over_m * std::sin(bank_rad)),
            static_cast<float>(road.z_m + over_m * std::cos(bank_rad)), 0.2F,
            static_cast<float>(after_s)};
  }
  static float of(const Pillar& pillar, PillarFeature feature) {
    return pillar.features[static_cast<std::size_t>(feature)];
  }
  static std::size_t row_of(const Pillar& pillar) { return pillar.cell / PillarGrid::kColumns; }
  static std::size_t column_of(const Pillar& pillar) { return pillar.cell % PillarGrid::kColumns; }

  TrackGrid grid_{traffic::oval()};
  std::optional<TrackGround> ground_;
};

TEST_F(PillarsOfARoad, ACellTellsOfItsPoints) {
  // In the cell whose near right corner is 20.0 m ahead, at 1.0 m.
  const PointCloud cloud{at(20.1, 1.125, 0.02), at(20.1, 1.125, 0.8), at(20.1, 1.125, 1.1)};
  const std::vector<Pillar> pillars = pillars_of(cloud, *ground_, 0.0);
  ASSERT_EQ(pillars.size(), 1U);
  const Pillar& pillar = pillars[0];
  EXPECT_EQ(row_of(pillar), 306U);    // (20.1 + 102.4) / 0.4
  EXPECT_EQ(column_of(pillar), 52U);  // (1.125 + 12) / 0.25
  using enum PillarFeature;
  EXPECT_NEAR(of(pillar, kLow), 0.25 * std::log2(2.0), 1e-6);
  EXPECT_NEAR(of(pillar, kHigh), 0.25 * std::log2(3.0), 1e-6);
  EXPECT_NEAR(of(pillar, kTop_m), 1.1, 0.02);
  EXPECT_NEAR(of(pillar, kBottom_m), 0.02, 0.02);
  EXPECT_NEAR(of(pillar, kMean_m), 0.64, 0.02);
  EXPECT_NEAR(of(pillar, kAhead), -0.5, 0.1);
  EXPECT_NEAR(of(pillar, kLeft), 0.0, 0.2);
  EXPECT_NEAR(of(pillar, kRange_100m), 0.201, 0.002);
  EXPECT_NEAR(of(pillar, kWall_m), 3.0, 1e-6) << "no more than kWallMost_m";
  EXPECT_NEAR(of(pillar, kSurface), 0.0, 1e-6) << "no two are 0.23 m apart";
}

TEST_F(PillarsOfARoad, EveryPointOfTheRoadIsInTheCellThatHoldsIt) {
  std::mt19937_64 random{7};
  PointCloud cloud;
  std::map<std::uint32_t, std::size_t> expected;
  for (int i = 0; i < 3'000; ++i) {
    const double ahead_m = testing::draw_uniform(random, -140.0, 240.0);
    const double n_m = testing::draw_uniform(random, -7.9, 7.9);
    const LidarPoint point = at(ahead_m, n_m, 0.01);
    const auto place = ground_->at(point);
    if (!place) continue;
    cloud.push_back(point);
    const double row = std::floor((ground_->ahead_m(place->place) + 102.4) / 0.4);
    const double column = std::floor((place->place.n_m + 12.0) / 0.25);
    if (row >= 0.0 && row < 768.0) ++expected[static_cast<std::uint32_t>(96.0 * row + column)];
  }
  const std::vector<Pillar> pillars = pillars_of(cloud, *ground_, 0.0);
  ASSERT_EQ(pillars.size(), expected.size());
  for (const Pillar& pillar : pillars)
    EXPECT_NEAR(std::exp2(4.0F * of(pillar, PillarFeature::kLow)) - 1.0F,
                static_cast<double>(expected[pillar.cell]), 1e-3);
}

TEST_F(PillarsOfARoad, WhatStandsOverTheRoadIsWhereItWasAtTheReferenceTime) {
  // 0.02 s after it, a car that goes 60 m/s is 1.2 m further on; the road stays where it is.
  const std::vector<Pillar> moved =
      pillars_of(PointCloud{at(41.3, 0.1, 0.6, 0.02)}, *ground_, 60.0);
  ASSERT_EQ(moved.size(), 1U);
  EXPECT_EQ(row_of(moved[0]), 356U);  // (40.1 + 102.4) / 0.4
  const std::vector<Pillar> road = pillars_of(PointCloud{at(41.3, 0.1, 0.0, 0.02)}, *ground_, 60.0);
  ASSERT_EQ(road.size(), 1U);
  EXPECT_EQ(row_of(road[0]), 359U);
}

TEST_F(PillarsOfARoad, WhatIsNoPointOfTheRoadIsInNoCell) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const PointCloud cloud{at(-102.9, 0.0, 0.1), at(205.2, 0.0, 0.1), at(10.0, 9.0, 0.1),
                         at(10.0, 0.0, 3.0),   at(10.0, 0.0, -0.9), {kNan, 0.0F, 0.0F}};
  EXPECT_TRUE(pillars_of(cloud, *ground_, 0.0).empty());
}

TEST_F(PillarsOfARoad, OfASurfaceAllPointsHaveOne) {
  PointCloud cloud;
  for (int k = 0; k < 40; ++k) cloud.push_back(at(30.0, -2.0 + 0.05 * k, 0.5));
  for (const Pillar& pillar : pillars_of(cloud, *ground_, 0.0))
    EXPECT_EQ(of(pillar, PillarFeature::kSurface), 1.0F);
}

TEST_F(PillarsOfARoad, PlanesHoldEachFigureInItsCell) {
  const std::vector<Pillar> pillars =
      pillars_of(PointCloud{at(20.1, 1.125, 0.5), at(-50.0, -3.0, 0.1)}, *ground_, 0.0);
  ASSERT_EQ(pillars.size(), 2U);
  const std::vector<float> planes = planes_of(pillars);
  ASSERT_EQ(planes.size(), 768U * 96U * 10U);
  std::size_t in_planes = 0, in_pillars = 0;
  for (const float value : planes) in_planes += value != 0.0F;
  for (const Pillar& pillar : pillars)
    for (std::size_t f = 0; f < kPillarFeatures; ++f) {
      in_pillars += pillar.features[f] != 0.0F;
      EXPECT_EQ(planes[f * 768 * 96 + pillar.cell], pillar.features[f]);
    }
  EXPECT_EQ(in_planes, in_pillars);
}

}  // namespace
}  // namespace pitwall::perception
