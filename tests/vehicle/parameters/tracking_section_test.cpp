// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/vehicle/parameters/mutation.hpp"

namespace pitwall::parameters {
namespace {

using testing::av21;
using testing::refusal;

tracking::Params tracking_of(const std::string& section) {
  const auto car = read_car(av21() + section, "car.yaml");
  EXPECT_TRUE(car) << to_string(car.error());
  return car ? car->params.tracking : tracking::Params{};
}

TEST(TrackingSection, WithoutItTheValuesAreThoseOfTheTracker) {
  const tracking::Params p = tracking_of(""), own;
  EXPECT_EQ(p.method, own.method);
  for (const auto& r : tracking::kRanges) EXPECT_EQ(p.*r.value, own.*r.value) << r.name;
  for (const auto& r : tracking::kRoadRanges)
    EXPECT_EQ(p.road.*r.value, own.road.*r.value) << r.name;
}

// Every key alone, at the end of its range, reaches its member and no other.
TEST(TrackingSection, EveryKeyReachesItsMember) {
  const auto text = [](double v) {
    std::array<char, 32> digits{};
    std::snprintf(digits.data(), digits.size(), "%.17g", v);
    return std::string(digits.data());
  };
  for (const auto& r : tracking::kRanges) {
    const auto p = tracking_of("tracking: {" + std::string(r.name) + ": " + text(r.most) + "}\n");
    for (const auto& q : tracking::kRanges)
      EXPECT_EQ(p.*q.value, q.value == r.value ? r.most : tracking::Params{}.*q.value) << r.name;
  }
  for (const auto& r : tracking::kRoadRanges) {
    const auto p =
        tracking_of("tracking: {road: {" + std::string(r.name) + ": " + text(r.most) + "}}\n");
    for (const auto& q : tracking::kRoadRanges)
      EXPECT_EQ(p.road.*q.value, q.value == r.value ? r.most : tracking::RoadParams{}.*q.value)
          << r.name;
  }
  for (const auto& r : tracking::kPaperRanges) {
    const auto p =
        tracking_of("tracking: {paper: {" + std::string(r.name) + ": " + text(r.most) + "}}\n");
    for (const auto& q : tracking::kPaperRanges)
      EXPECT_EQ(p.paper.*q.value, q.value == r.value ? r.most : tracking::PaperParams{}.*q.value)
          << r.name;
  }
  EXPECT_EQ(tracking_of("tracking: {method: paper}\n").method, tracking::Method::kPaper);
}

TEST(TrackingSection, WhatItDoesNotKnowIsRefusedByName) {
  EXPECT_NE(refusal(av21() + "tracking: {method: best}\n").find("paper, road"), std::string::npos);
  EXPECT_NE(refusal(av21() + "tracking: {window: 1}\n").find("window"), std::string::npos);
  EXPECT_NE(refusal(av21() + "tracking: {window_s: 2}\n").find("window_s"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::parameters
