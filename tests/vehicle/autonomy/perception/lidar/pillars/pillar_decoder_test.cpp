// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/pillars/pillar_decoder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/hil/traffic/oval.hpp"
#include "tests/support/draw.hpp"
#include "vehicle/autonomy/perception/lidar/pillars/pillar_trunk.hpp"

namespace pitwall::perception {
namespace {

constexpr std::size_t kRows = 384, kColumns = 48;
constexpr double kLeast = 0.5;

// What a network would say of such a car, in the cell of its middle and less in those around it.
class Planes {
 public:
  Planes() : values_(kPillarOutputs * kRows * kColumns, 0.0F) {
    std::fill_n(values_.begin(), kRows * kColumns, -9.0F);
  }
  float& at(PillarOutput output, std::size_t row, std::size_t column) {
    return values_[static_cast<std::size_t>(output) * kRows * kColumns + row * kColumns + column];
  }
  void put(const RoadBox& box) {
    const double row = (box.ahead_m + 102.4) / 0.8, column = (box.n_m + 12.0) / 0.5;
    for (int dr = -1; dr <= 1; ++dr)
      for (int dc = -1; dc <= 1; ++dc) {
        const double r = std::floor(row) + dr, c = std::floor(column) + dc;
        if (r < 0.0 || c < 0.0 || r >= kRows || c >= kColumns) continue;
        put(box, row - r - 0.5, column - c - 0.5, std::abs(dr) + std::abs(dc),
            static_cast<std::size_t>(r), static_cast<std::size_t>(c));
      }
  }
  const std::vector<float>& values() const { return values_; }

 private:
  void put(const RoadBox& box, double ahead, double left, int away, std::size_t r, std::size_t c) {
    using enum PillarOutput;
    const double logit = std::log(box.confidence / (1.0 - box.confidence)) - away;
    at(kCar, r, c) = static_cast<float>(logit);
    at(kAhead, r, c) = static_cast<float>(ahead);
    at(kLeft, r, c) = static_cast<float>(left);
    at(kLength, r, c) = static_cast<float>(std::log(box.length_m / 4.92));
    at(kWidth, r, c) = static_cast<float>(std::log(box.width_m / 1.89));
    at(kSin, r, c) = static_cast<float>(std::sin(2.0 * box.yaw_rad));
    at(kCos, r, c) = static_cast<float>(std::cos(2.0 * box.yaw_rad));
  }

  std::vector<float> values_;
};

RoadBox box_at(double ahead_m, double n_m, double confidence) {
  return {.ahead_m = ahead_m,
          .n_m = n_m,
          .yaw_rad = 0.0,
          .length_m = 5.0,
          .width_m = 1.9,
          .confidence = confidence};
}

TEST(PillarDecoder, WhatIsWrittenIsRead) {
  std::mt19937_64 random{3};
  for (int round = 0; round < 50; ++round) {
    Planes planes;
    std::vector<RoadBox> boxes;
    for (int k = 0; k < 5; ++k) {
      boxes.push_back({.ahead_m = testing::draw_uniform(random, 0.0, 30.0) - 100.0 + 60.0 * k,
                       .n_m = testing::draw_uniform(random, -11.9, 11.9),
                       .yaw_rad = testing::draw_uniform(random, -1.5, 1.5),
                       .length_m = testing::draw_uniform(random, 4.4, 5.5),
                       .width_m = testing::draw_uniform(random, 1.7, 2.1),
                       .confidence = 0.95 - 0.05 * k});
      planes.put(boxes.back());
    }
    const std::vector<RoadBox> found = decode(planes.values(), kLeast);
    ASSERT_EQ(found.size(), boxes.size()) << round;
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_NEAR(found[k].ahead_m, boxes[k].ahead_m, 1e-4) << "the surest first";
      EXPECT_NEAR(found[k].n_m, boxes[k].n_m, 1e-4);
      EXPECT_NEAR(found[k].yaw_rad, boxes[k].yaw_rad, 1e-5);
      EXPECT_NEAR(found[k].length_m, boxes[k].length_m, 1e-4);
      EXPECT_NEAR(found[k].width_m, boxes[k].width_m, 1e-4);
      EXPECT_NEAR(found[k].confidence, boxes[k].confidence, 1e-5);
    }
  }
}

TEST(PillarDecoder, OfTwoInOnePlaceTheSurerIsKept) {
  Planes planes;
  planes.put(box_at(20.0, 0.0, 0.7));
  planes.put(box_at(22.4, 0.2, 0.9));
  planes.put(box_at(20.0, 3.0, 0.8));
  const std::vector<RoadBox> found = decode(planes.values(), kLeast);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].ahead_m, 22.4, 1e-4);
  EXPECT_NEAR(found[1].n_m, 3.0, 1e-4) << "beside it is another car";
}

TEST(PillarDecoder, OneThatIsNotSureEnoughIsNone) {
  Planes planes;
  planes.put(box_at(20.0, 0.0, 0.49));
  EXPECT_TRUE(decode(planes.values(), kLeast).empty());
  EXPECT_EQ(decode(planes.values(), 0.4).size(), 1U);
}

TEST(PillarDecoder, OfEqualNeighboursOneIsThePeakAtTheEdgeToo) {
  for (const auto& [row, column] : {std::pair{0U, 0U}, std::pair{382U, 46U}}) {
    Planes planes;
    for (const std::size_t dr : {0U, 1U})
      for (const std::size_t dc : {0U, 1U})
        planes.at(PillarOutput::kCar, row + dr, column + dc) = 2.0F;
    EXPECT_EQ(decode(planes.values(), kLeast).size(), 1U);
  }
}

TEST(PillarDecoder, NonsenseIsNoCar) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  Planes planes;
  planes.put(box_at(20.0, 0.0, 0.9));
  planes.at(PillarOutput::kCar, 10, 10) = kNan;
  planes.at(PillarOutput::kCar, 50, 10) = 5.0F;
  planes.at(PillarOutput::kLength, 50, 10) = kNan;
  planes.at(PillarOutput::kCar, 90, 10) = 5.0F;
  planes.at(PillarOutput::kWidth, 90, 10) = std::numeric_limits<float>::infinity();
  EXPECT_EQ(decode(planes.values(), kLeast).size(), 1U);
}

TEST(PillarDecoder, InBodyABoxIsWhereItsPlaceOnTheRoadIs) {
  const TrackGrid grid{traffic::oval()};
  for (const double s_m : {150.0, 700.0}) {
    const world::TrackPoint ours = traffic::oval().offset(s_m, -2.0);
    const auto ground = TrackGround::fit(grid, {ours.x_m, ours.y_m, ours.yaw_rad + 0.02, 0.3}, {});
    ASSERT_TRUE(ground);
    RoadBox box = box_at(60.0, 2.0, 0.8);
    box.yaw_rad = 0.1;
    const CarBox car = in_body(box, *ground);
    const world::TrackPoint road = traffic::oval().offset(s_m + 60.0, 2.0);
    EXPECT_NEAR(car.yaw_rad, road.yaw_rad + 0.1 - ours.yaw_rad - 0.02, 1e-3) << s_m;
    const auto at = ground->at({static_cast<float>(car.x_m), static_cast<float>(car.y_m),
                                static_cast<float>(car.ground_m)});
    ASSERT_TRUE(at);
    EXPECT_NEAR(ground->ahead_m(at->place), 60.0, 0.03);
    EXPECT_NEAR(at->place.n_m, 2.0, 0.03);
    EXPECT_EQ(car.length_m, 5.0);
    EXPECT_EQ(car.confidence, 0.8);
  }
}

}  // namespace
}  // namespace pitwall::perception
